// winner_sums, NEON: the least of eight sums at once, then the first sixteen that hold it. Up to 64 levels stay in
// registers. Bound, per eight levels: 1 load, 1 minimum; 2.5 operations and half a branch until the winner is found.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "simd/arm/neon.h"
#include "simd/arm/winner_fraction.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kAtOnce = 8;  // at once

// Where the first of sixteen sums lies that equals the value; below 0: none does.
inline int32_t find(uint16x8_t low, uint16x8_t high, uint16x8_t value) {
  const uint8x16_t equal = low_bytes(vceqq_u16(low, value), vceqq_u16(high, value));
  const uint64_t nibbles = flag_nibbles(equal);
  return nibbles == 0 ? -1 : static_cast<int32_t>(__builtin_ctzll(nibbles)) / 4;
}

// The least sum and the first level that holds it.
struct Winner {
  uint16_t sum;
  int32_t level;
};

// Of kVectors vectors of sums, an even number, all of them in registers.
template <int32_t kVectors>
inline Winner find_winner(const uint16_t* sums, int32_t, uint16x8_t beyond) {
  uint16x8_t sum[kVectors];
  BSM_UNROLL
  for (int32_t i = 0; i < kVectors; ++i) sum[i] = vld1q_u16(sums + i * kAtOnce);
  sum[kVectors - 1] = vorrq_u16(sum[kVectors - 1], beyond);
  uint16x8_t least = sum[0];
  BSM_UNROLL
  for (int32_t i = 1; i < kVectors; ++i) least = vminq_u16(least, sum[i]);
  const uint16_t smallest = least16(least);
  const uint16x8_t value = vdupq_n_u16(smallest);
  BSM_UNROLL
  for (int32_t i = 0; i < kVectors; i += 2) {
    const int32_t found = find(sum[i], sum[i + 1], value);
    if (found >= 0) return Winner{smallest, i * kAtOnce + found};
  }
  return Winner{smallest, 0};
}

// Of any number of vectors.
template <>
inline Winner find_winner<0>(const uint16_t* sums, int32_t last, uint16x8_t beyond) {
  const uint16x8_t end = vorrq_u16(vld1q_u16(sums + last), beyond);
  uint16x8_t least = end;
  for (int32_t i = 0; i < last; i += kAtOnce) least = vminq_u16(least, vld1q_u16(sums + i));
  const uint16_t smallest = least16(least);
  const uint16x8_t value = vdupq_n_u16(smallest);
  for (int32_t i = 0; i < last; i += kAtOnce) {
    const uint16x8_t sum = vld1q_u16(sums + i);
    const int32_t found = find(sum, sum, value);
    if (found >= 0) return Winner{smallest, i + found};
  }
  return Winner{smallest, last + find(end, end, value)};
}

template <int32_t kVectors>
void pick_winners(const WinnerSumsArgs& args) {
  alignas(16) static constexpr uint16_t kLanes[kAtOnce] = {0, 1, 2, 3, 4, 5, 6, 7};
  const int32_t last = (args.num_disparities - 1) / kAtOnce * kAtOnce;
  const uint16x8_t beyond =
      vcgtq_u16(vld1q_u16(kLanes), vdupq_n_u16(static_cast<uint16_t>(args.num_disparities - last - 1)));
  const uint16_t* sums = args.sum;
  for (int32_t x = 0; x < args.width; ++x, sums += args.stride) {
    const Winner winner = find_winner<kVectors>(sums, last, beyond);
    args.level[x] = winner.sum == kNoCost ? kNoLevel : winning_level(args, sums, winner.level);
  }
}

}  // namespace

uint64_t winner_sums_neon_scratch(const KernelShape&) {
  return 0;
}

void winner_sums_neon(const WinnerSumsArgs& args) {
  switch ((args.num_disparities + kAtOnce - 1) / kAtOnce) {
    case 4:
      return pick_winners<4>(args);
    case 6:
      return pick_winners<6>(args);
    case 8:
      return pick_winners<8>(args);
    default:
      return pick_winners<0>(args);
  }
}

}  // namespace bsm
#endif
