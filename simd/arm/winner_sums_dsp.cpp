// winner_sums, DSP: the least of two sums at once, then the first word that holds it.
// Bound, per two levels: 1 load, 2 operations; the same until the winner is found.
#include "platform/compiler.h"

#if BSM_ARCH_DSP
#include "simd/arm/dsp.h"
#include "simd/arm/winner_fraction.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

// The first level that holds the least sum: one of them does.
inline int32_t find(const uint16_t* sums, uint32_t smallest, int32_t count) {
  const uint32_t both = twice(smallest);
  int32_t level = 0;
  for (; level + 2 <= count; level += 2) {
    __usub16(both, load32(sums + level));
    const uint32_t equal = __sel(0x00020001, 0);
    if (equal != 0) return level + ((equal & 1) != 0 ? 0 : 1);
  }
  return level;
}

}  // namespace

uint64_t winner_sums_dsp_scratch(const KernelShape&) {
  return 0;
}

void winner_sums_dsp(const WinnerSumsArgs& args) {
  const int32_t count = args.num_disparities;
  const uint16_t* sums = args.sum;
  for (int32_t x = 0; x < args.width; ++x, sums += args.stride) {
    uint32_t least = twice(sums[count - 1]);
    for (int32_t level = 0; level + 2 <= count; level += 2) least = least16(least, load32(sums + level));
    const uint32_t smallest = least_half(least);
    args.level[x] = smallest == kNoCost ? kNoLevel : winning_level(args, sums, find(sums, smallest, count));
  }
}

}  // namespace bsm
#endif
