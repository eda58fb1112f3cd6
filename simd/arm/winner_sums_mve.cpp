// winner_sums, MVE: the least of eight sums at once, then the first eight that hold it.
// Bound, per eight levels: 1 load, 1 operation; 1 load and 2 operations until the winner is found.
#include "platform/compiler.h"

#if BSM_ARCH_MVE
#include "simd/arm/mve.h"
#include "simd/arm/winner_fraction.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kAtOnce = 8;

// The first level that holds the least sum: one of them does.
inline int32_t find(const uint16_t* sums, uint16_t smallest) {
  for (int32_t level = 0;; level += kAtOnce) {
    const uint32_t equal = vcmpeqq_n_u16(vldrhq_u16(sums + level), smallest);  // two bits a level
    if (equal != 0) return level + __builtin_ctz(equal) / 2;
  }
}

}  // namespace

uint64_t winner_sums_mve_scratch(const KernelShape&) {
  return 0;
}

void winner_sums_mve(const WinnerSumsArgs& args) {
  const int32_t last = (args.num_disparities - 1) / kAtOnce * kAtOnce;
  const mve_pred16_t exist = vctp16q(static_cast<uint32_t>(args.num_disparities - last));
  const uint16_t* sums = args.sum;
  for (int32_t x = 0; x < args.width; ++x, sums += args.stride) {
    uint16_t least = kNoCost;
    for (int32_t level = 0; level < last; level += kAtOnce) least = vminvq_u16(least, vldrhq_u16(sums + level));
    least = vminvq_p_u16(least, vldrhq_u16(sums + last), exist);
    args.level[x] = least == kNoCost ? kNoLevel : winning_level(args, sums, find(sums, least));
  }
}

}  // namespace bsm
#endif
