// Registers of 32 levels for the kernels that run over the levels of a pixel: the names of simd/x86/levels_avx2.h in 512
// bits.
#ifndef BSM_SIMD_X86_LEVELS_AVX512_H
#define BSM_SIMD_X86_LEVELS_AVX512_H

#include <immintrin.h>
#include <stddef.h>
#include <stdint.h>

#include "platform/compiler.h"

namespace bsm {
namespace {

using Bytes = __m512i;
constexpr int32_t kLevelLanes = 32;

inline Bytes load(const void* from) {
  return _mm512_loadu_si512(from);
}
inline void store(void* to, Bytes value) {
  _mm512_storeu_si512(to, value);
}
inline Bytes ones() {
  return _mm512_set1_epi32(-1);
}
inline Bytes set16(int32_t value) {
  return _mm512_set1_epi16(static_cast<int16_t>(value));
}
inline Bytes min16(Bytes a, Bytes b) {
  return _mm512_min_epu16(a, b);
}
inline Bytes add16_saturated(Bytes a, Bytes b) {
  return _mm512_adds_epu16(a, b);
}
inline Bytes sub16(Bytes a, Bytes b) {
  return _mm512_sub_epi16(a, b);
}
// The least lane, in all lanes. Halves fold down to 128 bits, whose least lane is one instruction.
inline Bytes least_everywhere(Bytes a) {
  const __m256i half = _mm256_min_epu16(_mm512_castsi512_si256(a), _mm512_extracti64x4_epi64(a, 1));
  const __m128i quarter = _mm_min_epu16(_mm256_castsi256_si128(half), _mm256_extracti128_si256(half, 1));
  return _mm512_broadcastw_epi16(_mm_minpos_epu16(quarter));
}
// Lane k of the result is lane k - 1 of `a`, lane 0 the last of `before`.
inline Bytes from_below(Bytes before, Bytes a) {
  const __m512i lanes = _mm512_set_epi16(30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, 19, 18, 17, 16, 15, 14, 13, 12, 11, 10,
                                         9, 8, 7, 6, 5, 4, 3, 2, 1, 0, 63);
  return _mm512_permutex2var_epi16(a, lanes, before);
}
// Lane k of the result is lane k + 1 of `a`, the last lane the first of `after`.
inline Bytes from_above(Bytes a, Bytes after) {
  const __m512i lanes = _mm512_set_epi16(32, 31, 30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, 19, 18, 17, 16, 15, 14, 13, 12,
                                         11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1);
  return _mm512_permutex2var_epi16(a, lanes, after);
}

// The first lanes of a pixel's last register: levels, the others are padding.
struct LastLanes {
  __mmask32 kept;

  explicit LastLanes(int32_t count) : kept(static_cast<__mmask32>(~uint32_t{0} >> (kLevelLanes - count))) {}
  // Padding reads as ones and is not written.
  Bytes load_from(const uint16_t* from) const { return _mm512_mask_loadu_epi16(ones(), kept, from); }
  void store_to(uint16_t* to, Bytes value) const { _mm512_mask_storeu_epi16(to, kept, value); }
};

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_LEVELS_AVX512_H
