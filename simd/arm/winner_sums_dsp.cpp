// winner_sums, DSP: the least of two sums at once, then the first word that holds it.
// Bound, per two levels: 1 load, 2 operations; the same until the winner is found.
#include "platform/compiler.h"

#if BSM_ARCH_DSP
#include "simd/arm/dsp.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

// Equiangular fit through (d - 1, left), (d, center), (d + 1, right), center the least: sixteenths of a pixel, -8..7.
inline int32_t fraction(uint16_t left, uint16_t center, uint16_t right) {
  const int32_t a = left - center;
  const int32_t b = right - center;
  const int32_t larger = a < b ? b : a;
  if (larger == 0) return 0;
  // floor(8 (a - b) / larger + 1/2), with a numerator that is never negative: a - b >= -larger.
  const uint32_t rounded = static_cast<uint32_t>(16 * (a - b) + 17 * larger) / static_cast<uint32_t>(2 * larger);
  return rounded < 15 ? static_cast<int32_t>(rounded) - 8 : 7;
}

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
    args.level[x] = kNoLevel;
    if (smallest == kNoCost) continue;
    const int32_t winner = find(sums, smallest, count);
    int32_t sixteenths = winner << kLevelShift;
    const bool inside = 0 < winner && winner + 1 < count;
    if (args.subpixel != 0 && inside && sums[winner - 1] != kNoCost && sums[winner + 1] != kNoCost) {
      sixteenths += fraction(sums[winner - 1], static_cast<uint16_t>(smallest), sums[winner + 1]);
    }
    args.level[x] = static_cast<uint16_t>(sixteenths);
  }
}

}  // namespace bsm
#endif
