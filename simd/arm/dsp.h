// SIMD in 32-bit core registers for the DSP kernels: four bytes or two halves at once. Every operation takes one cycle on M4
// and M33; M7 issues two. A selection takes the lanes in which the subtraction before it did not borrow.
#ifndef BSM_SIMD_ARM_DSP_H
#define BSM_SIMD_ARM_DSP_H

#include <arm_acle.h>
#include <stddef.h>
#include <stdint.h>

#include "platform/compiler.h"

namespace bsm {
namespace {

constexpr uint32_t kByteSigns = 0x80808080;
constexpr uint32_t kHalfSigns = 0x80008000;

// Loads of 32 bits may be misaligned on all processors that have these instructions.
inline uint32_t load32(const void* from) {
  uint32_t word;
  BSM_MEMCPY(&word, from, sizeof word);
  return word;
}

inline uint32_t twice(uint32_t half) {
  return half | half << 16;
}

inline uint32_t four_times(uint32_t byte) {
  return byte * 0x01010101;
}

// Bytes 0 and 2 of a word as halves, and the same added to halves.
inline uint32_t even_bytes(uint32_t bytes) {
  return static_cast<uint32_t>(__uxtb16(static_cast<int8x4_t>(bytes)));
}

inline uint32_t add_even_bytes(uint32_t halves, uint32_t bytes) {
  return static_cast<uint32_t>(__uxtab16(static_cast<int16x2_t>(halves), static_cast<int8x4_t>(bytes)));
}

inline uint32_t distance8(uint32_t a, uint32_t b) {
  return __uqsub8(a, b) | __uqsub8(b, a);
}

inline uint32_t most8(uint32_t a, uint32_t b) {
  __usub8(a, b);
  return __sel(a, b);
}

inline uint32_t least16(uint32_t a, uint32_t b) {
  __usub16(a, b);
  return __sel(b, a);
}

// The lower of two halves.
inline uint32_t least_half(uint32_t halves) {
  const uint32_t low = halves & 0xffff;
  const uint32_t high = halves >> 16;
  return low < high ? low : high;
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_DSP_H
