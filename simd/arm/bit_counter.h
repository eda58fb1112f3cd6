// Counts of bits: bit j of byte x of many vectors, for all j and x at once, by carry-save adders.
#ifndef BSM_SIMD_ARM_BIT_COUNTER_H
#define BSM_SIMD_ARM_BIT_COUNTER_H

#include "bsm/bsm.h"
#include "simd/arm/neon.h"

namespace bsm {
namespace {

// Bits of the counts that stay in registers, of which ARMv7 has half as many.
#if defined(__aarch64__)
constexpr int32_t kLowLevels = 6;
#else
constexpr int32_t kLowLevels = 5;
#endif

struct HighLevels {
  uint8_t level[13 - kLowLevels][16];  // the other bits of the counts
};

struct Counter {
  uint8x16_t level[kLowLevels];
};

// Adds the bits a and b to a level; returns the carry.
template <int32_t kLevel>
BSM_INLINE uint8x16_t add_bits(Counter& counter, uint8x16_t a, uint8x16_t b) {
  const uint8x16_t old = counter.level[kLevel];
  const uint8x16_t odd = veorq_u8(a, b);
  counter.level[kLevel] = veorq_u8(old, odd);
  return vbslq_u8(odd, old, a);
}

// Counts the next 2 << kLevel vectors, vector(first) and so on; returns the carry.
template <int32_t kLevel, class Vectors>
BSM_INLINE uint8x16_t add_vectors(Counter& counter, const Vectors& vector, int32_t first) {
  if constexpr (kLevel == 0) {
    const uint8x16_t a = vector(first);
    const uint8x16_t b = vector(first + 1);
    return add_bits<0>(counter, a, b);
  } else {
    const uint8x16_t a = add_vectors<kLevel - 1>(counter, vector, first);
    BSM_KEEP_ORDER();
    const uint8x16_t b = add_vectors<kLevel - 1>(counter, vector, first + (1 << kLevel));
    return add_bits<kLevel>(counter, a, b);
  }
}

// The bits that are set in at least count / 4 of `count` vectors, a multiple of 64.
template <class Vectors>
BSM_INLINE uint8x16_t enough(const Vectors& vector, int32_t count, HighLevels& high) {
  Counter counter;
  BSM_UNROLL
  for (int32_t i = 0; i < kLowLevels; ++i) counter.level[i] = vdupq_n_u8(0);
  constexpr int32_t kAtOnce = 1 << kLowLevels;
  int32_t levels = 1;
  while (count / kAtOnce >> levels != 0) ++levels;
  for (int32_t i = 0; i < levels; ++i) vst1q_u8(high.level[i], vdupq_n_u8(0));
  for (int32_t first = 0; first < count; first += kAtOnce) {
    uint8x16_t carry = add_vectors<kLowLevels - 1>(counter, vector, first);
    for (int32_t i = 0; i < levels; ++i) {
      const uint8x16_t old = vld1q_u8(high.level[i]);
      vst1q_u8(high.level[i], veorq_u8(old, carry));
      carry = vandq_u8(old, carry);
    }
  }
  // Compares with count / 4 from the lowest bit up; 16 divides it.
  const uint32_t wanted = static_cast<uint32_t>(count) / 4;
  uint8x16_t result = vdupq_n_u8(255);
  BSM_UNROLL
  for (int32_t i = 0; i < 4; ++i) result = vorrq_u8(result, counter.level[i]);
  BSM_UNROLL
  for (int32_t i = 4; i < kLowLevels; ++i) {
    result = (wanted >> i & 1u) != 0 ? vandq_u8(result, counter.level[i]) : vorrq_u8(result, counter.level[i]);
  }
  for (int32_t i = 0; i < levels; ++i) {
    const uint8x16_t level = vld1q_u8(high.level[i]);
    result = (wanted >> (kLowLevels + i) & 1u) != 0 ? vandq_u8(result, level) : vorrq_u8(result, level);
  }
  return result;
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_BIT_COUNTER_H
