// Lanes that lie in a row, for MVE kernels at its ends: predicated loads touch no others.
#ifndef BSM_SIMD_ARM_INSIDE_H
#define BSM_SIMD_ARM_INSIDE_H

#include "simd/arm/mve.h"

namespace bsm {
namespace {

// Of the sixteen columns from `at` on, a bit for each that lies within 0..width-1.
inline uint32_t columns_inside(int32_t at, int32_t width) {
  const int32_t begin = at < 0 ? -at : 0;
  const int32_t end = width - at < 16 ? width - at : 16;
  return begin >= end ? 0 : (1u << end) - (1u << begin);
}

// The predicate of eight 16-bit lanes from `at` on.
inline mve_pred16_t lanes_inside(int32_t at, int32_t width) {
  const int32_t begin = at < 0 ? -at : 0;
  const int32_t end = width - at < 8 ? width - at : 8;
  return static_cast<mve_pred16_t>(begin >= end ? 0 : (1u << 2 * end) - (1u << 2 * begin));
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_INSIDE_H
