// Vectors of 32 pixels for the kernels that AVX2 and SSE4.2 share: the names of simd/x86/lanes_sse42.h in 256 bits.
#ifndef BSM_SIMD_X86_LANES_AVX2_H
#define BSM_SIMD_X86_LANES_AVX2_H

#include <immintrin.h>
#include <stddef.h>
#include <stdint.h>

#include "platform/compiler.h"

namespace bsm {
namespace {

using Bytes = __m256i;
constexpr int32_t kLanes = 32;  // bytes in a vector
using Word = uint32_t;          // a bit for each

inline Bytes load(const void* from) {
  return _mm256_loadu_si256(static_cast<const __m256i*>(from));
}
inline void store(void* to, Bytes value) {
  _mm256_storeu_si256(static_cast<__m256i*>(to), value);
}
inline Bytes zero() {
  return _mm256_setzero_si256();
}
inline Bytes set8(int32_t value) {
  return _mm256_set1_epi8(static_cast<char>(value));
}
inline Bytes set16(int32_t value) {
  return _mm256_set1_epi16(static_cast<int16_t>(value));
}
inline Bytes table16(const uint8_t* table) {
  return _mm256_broadcastsi128_si256(_mm_loadu_si128(reinterpret_cast<const __m128i*>(table)));
}
inline Bytes max8(Bytes a, Bytes b) {
  return _mm256_max_epu8(a, b);
}
inline Bytes min8(Bytes a, Bytes b) {
  return _mm256_min_epu8(a, b);
}
inline Bytes add8(Bytes a, Bytes b) {
  return _mm256_add_epi8(a, b);
}
inline Bytes sub8(Bytes a, Bytes b) {
  return _mm256_sub_epi8(a, b);
}
inline Bytes add8_saturated(Bytes a, Bytes b) {
  return _mm256_adds_epu8(a, b);
}
inline Bytes sub8_saturated(Bytes a, Bytes b) {
  return _mm256_subs_epu8(a, b);
}
inline Bytes equal8(Bytes a, Bytes b) {
  return _mm256_cmpeq_epi8(a, b);
}
inline Bytes equal16(Bytes a, Bytes b) {
  return _mm256_cmpeq_epi16(a, b);
}
inline Bytes max16(Bytes a, Bytes b) {
  return _mm256_max_epu16(a, b);
}
inline Bytes min16(Bytes a, Bytes b) {
  return _mm256_min_epu16(a, b);
}
inline Bytes add16(Bytes a, Bytes b) {
  return _mm256_add_epi16(a, b);
}
inline Bytes add16_saturated(Bytes a, Bytes b) {
  return _mm256_adds_epu16(a, b);
}
inline Bytes multiply16_low(Bytes a, Bytes b) {
  return _mm256_mullo_epi16(a, b);
}
inline Bytes multiply16_high(Bytes a, Bytes b) {
  return _mm256_mulhi_epu16(a, b);
}
inline Bytes average16(Bytes a, Bytes b) {
  return _mm256_avg_epu16(a, b);
}
template <int kBits>
inline Bytes left16(Bytes a) {
  return _mm256_slli_epi16(a, kBits);
}
template <int kBits>
inline Bytes right16(Bytes a) {
  return _mm256_srli_epi16(a, kBits);
}
inline Bytes both(Bytes a, Bytes b) {
  return _mm256_and_si256(a, b);
}
inline Bytes either(Bytes a, Bytes b) {
  return _mm256_or_si256(a, b);
}
inline Bytes differ(Bytes a, Bytes b) {
  return _mm256_xor_si256(a, b);
}
inline Bytes look_up(Bytes table, Bytes index) {  // index 0..15
  return _mm256_shuffle_epi8(table, index);
}
inline Bytes choose(Bytes a, Bytes b, Bytes mask) {  // b where the mask is set
  return _mm256_blendv_epi8(a, b, mask);
}
inline Word signs(Bytes a) {
  return static_cast<Word>(_mm256_movemask_epi8(a));
}
// The first kLanes / 2 bytes at `from` as 16-bit values.
inline Bytes widen(const uint8_t* from) {
  return _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from)));
}
// Masks of 16 bits, of pixels 0..15 and 16..31, to a mask of bytes in the order of kPackedByte.
inline Bytes pack(Bytes low, Bytes high) {
  return _mm256_packs_epi16(low, high);
}
constexpr int32_t kPackedByte[kLanes / 8] = {0, 2, 1, 3};  // where byte i of signs(pack(..)) lies

// Byte b of kLanes words goes to vector b, in the order of the words.
inline void split_bytes(const Word* words, Bytes out[kLanes / 8]) {
  const __m256i by_byte = table16(reinterpret_cast<const uint8_t*>("\0\4\10\14\1\5\11\15\2\6\12\16\3\7\13\17"));
  const __m256i order = _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7);
  const __m256i a = look_up(load(words), by_byte);
  const __m256i b = look_up(load(words + 8), by_byte);
  const __m256i c = look_up(load(words + 16), by_byte);
  const __m256i d = look_up(load(words + 24), by_byte);
  const __m256i ab_low = _mm256_unpacklo_epi32(a, b);
  const __m256i ab_high = _mm256_unpackhi_epi32(a, b);
  const __m256i cd_low = _mm256_unpacklo_epi32(c, d);
  const __m256i cd_high = _mm256_unpackhi_epi32(c, d);
  out[0] = _mm256_permutevar8x32_epi32(_mm256_unpacklo_epi64(ab_low, cd_low), order);
  out[1] = _mm256_permutevar8x32_epi32(_mm256_unpackhi_epi64(ab_low, cd_low), order);
  out[2] = _mm256_permutevar8x32_epi32(_mm256_unpacklo_epi64(ab_high, cd_high), order);
  out[3] = _mm256_permutevar8x32_epi32(_mm256_unpackhi_epi64(ab_high, cd_high), order);
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_LANES_AVX2_H
