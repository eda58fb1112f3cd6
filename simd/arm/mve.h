// MVE for the kernels: vectors of 16 bytes in eight registers. What GCC does by way of core registers, a comparison whose
// outcome only predicates the next instruction, is written out for it.
#ifndef BSM_SIMD_ARM_MVE_H
#define BSM_SIMD_ARM_MVE_H

#include <arm_mve.h>
#include <stddef.h>
#include <stdint.h>

#include "platform/compiler.h"

namespace bsm {
namespace {

// sum + value in the lanes where a < b.
inline uint16x8_t add_where_less(uint16x8_t sum, uint16x8_t value, uint16x8_t a, uint16x8_t b) {
#if defined(__clang__)
  return vaddq_m_u16(sum, sum, value, vcmphiq_u16(b, a));
#else
  __asm__("vpt.u16 hi, %q3, %q2\n\tvaddt.i16 %q0, %q0, %q1" : "+w"(sum) : "w"(value), "w"(a), "w"(b) : "p0");
  return sum;
#endif
}

// The larger of most and a in the lanes where a < b.
inline uint16x8_t most_where_less(uint16x8_t most, uint16x8_t a, uint16x8_t b) {
#if defined(__clang__)
  return vmaxq_m_u16(most, most, a, vcmphiq_u16(b, a));
#else
  __asm__("vpt.u16 hi, %q2, %q1\n\tvmaxt.u16 %q0, %q0, %q1" : "+w"(most) : "w"(a), "w"(b) : "p0");
  return most;
#endif
}

// All bits set in the lanes where a < b.
inline uint16x8_t all_where_less(uint16x8_t a, uint16x8_t b) {
  return vreinterpretq_u16_s16(vshrq_n_s16(vreinterpretq_s16_u16(vhsubq_u16(a, b)), 15));
}

inline uint16_t least16(uint16x8_t a) {
  return vminvq_u16(0xffff, a);
}

inline uint16_t most16(uint16x8_t a) {
  return vmaxvq_u16(0, a);
}

// Distances from the first of eight places, `stride` apart.
inline uint16x8_t places(uint32_t stride) {
  return vmulq_n_u16(vidupq_n_u16(0, 1), static_cast<uint16_t>(stride));
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_MVE_H
