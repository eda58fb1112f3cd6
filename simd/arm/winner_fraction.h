// The level of a winner with its fraction, shared by the kernels of winner_sums.
#ifndef BSM_SIMD_ARM_WINNER_FRACTION_H
#define BSM_SIMD_ARM_WINNER_FRACTION_H

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

// The level in 1/16 pixel of a pixel whose least sum is that of the level `winner`.
inline uint16_t winning_level(const WinnerSumsArgs& args, const uint16_t* sums, int32_t winner) {
  int32_t sixteenths = winner << kLevelShift;
  const bool inside = 0 < winner && winner + 1 < args.num_disparities;
  if (args.subpixel != 0 && inside && sums[winner - 1] != kNoCost && sums[winner + 1] != kNoCost) {
    sixteenths += fraction(sums[winner - 1], sums[winner], sums[winner + 1]);
  }
  return static_cast<uint16_t>(sixteenths);
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_WINNER_FRACTION_H
