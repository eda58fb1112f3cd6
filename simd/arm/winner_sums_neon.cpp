// winner_sums, NEON: the least of eight sums at once, then the first eight that hold it.
// Bound, per eight levels: 1 load, 1 minimum; 1 load and 2 operations until the winner is found.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "simd/arm/neon.h"
#include "simd/arm/winner_fraction.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kAtOnce = 8;  // at once

// A byte of all ones for each sum that equals the value, the first sum lowest.
inline uint64_t equal_bytes(uint16x8_t sums, uint16x8_t value) {
  return vget_lane_u64(vreinterpret_u64_u8(vmovn_u16(vceqq_u16(sums, value))), 0);
}

// The first level that holds the least sum: one of them does.
inline int32_t find(const uint16_t* sums, uint16x8_t least) {
  for (int32_t i = 0;; i += kAtOnce) {
    const uint64_t equal = equal_bytes(vld1q_u16(sums + i), least);
    if (equal != 0) return i + static_cast<int32_t>(__builtin_ctzll(equal)) / 8;
  }
}

}  // namespace

uint64_t winner_sums_neon_scratch(const KernelShape&) {
  return 0;
}

void winner_sums_neon(const WinnerSumsArgs& args) {
  alignas(16) static constexpr uint16_t kLanes[kAtOnce] = {0, 1, 2, 3, 4, 5, 6, 7};
  const int32_t last = (args.num_disparities - 1) / kAtOnce * kAtOnce;
  const uint16x8_t beyond =
      vcgtq_u16(vld1q_u16(kLanes), vdupq_n_u16(static_cast<uint16_t>(args.num_disparities - last - 1)));
  for (int32_t x = 0; x < args.width; ++x) {
    const uint16_t* sums = args.sum + ptrdiff_t{x} * args.stride;
    uint16x8_t least = vorrq_u16(vld1q_u16(sums + last), beyond);
    int32_t i = 0;
    for (; i + 2 * kAtOnce <= last; i += 2 * kAtOnce) {
      least = vminq_u16(least, vminq_u16(vld1q_u16(sums + i), vld1q_u16(sums + i + kAtOnce)));
    }
    if (i < last) least = vminq_u16(least, vld1q_u16(sums + i));
    const uint16_t smallest = least16(least);
    args.level[x] = kNoLevel;
    if (smallest == kNoCost) continue;
    args.level[x] = winning_level(args, sums, find(sums, vdupq_n_u16(smallest)));
  }
}

}  // namespace bsm
#endif
