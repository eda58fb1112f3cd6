// SVE for the kernels: predicates of columns, and where the kernels are compiled at all.
#ifndef BSM_SIMD_ARM_SVE_H
#define BSM_SIMD_ARM_SVE_H

#include <arm_sve.h>
#include <stddef.h>
#include <stdint.h>

#include "platform/compiler.h"

namespace bsm {
namespace {

// Lanes of the columns first, first + 1, .. that lie within 0..width-1.
inline svbool_t inside8(int32_t first, int32_t width) {
  return svbic_z(svptrue_b8(), svwhilelt_b8(first, width), svwhilelt_b8(first, 0));
}

inline svbool_t inside16(int32_t first, int32_t width) {
  return svbic_z(svptrue_b16(), svwhilelt_b16(first, width), svwhilelt_b16(first, 0));
}

inline int32_t lanes8() {
  return static_cast<int32_t>(svcntb());
}

inline int32_t lanes16() {
  return static_cast<int32_t>(svcnth());
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_SVE_H
