// winner_sums, scalar: the level of the least sum, with its sub-pixel fraction.
#include "simd/kernels.h"

namespace bsm {
namespace {

// Equiangular fit through (d - 1, left), (d, center), (d + 1, right), center the least: sixteenths of a pixel, -8..7.
int32_t fraction(uint16_t left, uint16_t center, uint16_t right) {
  const int32_t a = left - center;
  const int32_t b = right - center;
  const int32_t larger = a < b ? b : a;
  if (larger == 0) return 0;
  // floor(8 (a - b) / larger + 1/2), with a numerator that is never negative: a - b >= -larger.
  const int32_t rounded = (16 * (a - b) + 17 * larger) / (2 * larger) - 8;
  return rounded < 7 ? rounded : 7;
}

}  // namespace

uint64_t winner_sums_scalar_scratch(const KernelShape&) {
  return 0;
}

void winner_sums_scalar(const WinnerSumsArgs& args) {
  for (int32_t x = 0; x < args.width; ++x) {
    const uint16_t* sums = args.sum + ptrdiff_t{x} * args.stride;
    int32_t winner = 0;
    for (int32_t level = 1; level < args.num_disparities; ++level) winner = sums[level] < sums[winner] ? level : winner;
    args.level[x] = kNoLevel;
    if (sums[winner] == kNoCost) continue;
    int32_t sixteenths = winner << kLevelShift;
    const bool inside = 0 < winner && winner + 1 < args.num_disparities;
    if (args.subpixel != 0 && inside && sums[winner - 1] != kNoCost && sums[winner + 1] != kNoCost) {
      sixteenths += fraction(sums[winner - 1], sums[winner], sums[winner + 1]);
    }
    args.level[x] = static_cast<uint16_t>(sixteenths);
  }
}

}  // namespace bsm
