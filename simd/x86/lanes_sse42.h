// Vectors of 16 pixels for the kernels that AVX2 and SSE4.2 share: the names of simd/x86/lanes_avx2.h in 128 bits.
#ifndef BSM_SIMD_X86_LANES_SSE42_H
#define BSM_SIMD_X86_LANES_SSE42_H

#include <nmmintrin.h>
#include <stddef.h>
#include <stdint.h>

#include "platform/compiler.h"

namespace bsm {
namespace {

using Bytes = __m128i;
constexpr int32_t kLanes = 16;  // bytes in a vector
using Word = uint16_t;          // a bit for each

inline Bytes load(const void* from) {
  return _mm_loadu_si128(static_cast<const __m128i*>(from));
}
inline void store(void* to, Bytes value) {
  _mm_storeu_si128(static_cast<__m128i*>(to), value);
}
inline Bytes zero() {
  return _mm_setzero_si128();
}
inline Bytes set8(int32_t value) {
  return _mm_set1_epi8(static_cast<char>(value));
}
inline Bytes set16(int32_t value) {
  return _mm_set1_epi16(static_cast<int16_t>(value));
}
inline Bytes table16(const uint8_t* table) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(table));
}
inline Bytes max8(Bytes a, Bytes b) {
  return _mm_max_epu8(a, b);
}
inline Bytes min8(Bytes a, Bytes b) {
  return _mm_min_epu8(a, b);
}
inline Bytes add8(Bytes a, Bytes b) {
  return _mm_add_epi8(a, b);
}
inline Bytes sub8(Bytes a, Bytes b) {
  return _mm_sub_epi8(a, b);
}
inline Bytes add8_saturated(Bytes a, Bytes b) {
  return _mm_adds_epu8(a, b);
}
inline Bytes sub8_saturated(Bytes a, Bytes b) {
  return _mm_subs_epu8(a, b);
}
inline Bytes equal8(Bytes a, Bytes b) {
  return _mm_cmpeq_epi8(a, b);
}
inline Bytes equal16(Bytes a, Bytes b) {
  return _mm_cmpeq_epi16(a, b);
}
inline Bytes max16(Bytes a, Bytes b) {
  return _mm_max_epu16(a, b);
}
inline Bytes min16(Bytes a, Bytes b) {
  return _mm_min_epu16(a, b);
}
inline Bytes add16(Bytes a, Bytes b) {
  return _mm_add_epi16(a, b);
}
inline Bytes add16_saturated(Bytes a, Bytes b) {
  return _mm_adds_epu16(a, b);
}
inline Bytes multiply16_low(Bytes a, Bytes b) {
  return _mm_mullo_epi16(a, b);
}
inline Bytes multiply16_high(Bytes a, Bytes b) {
  return _mm_mulhi_epu16(a, b);
}
inline Bytes average16(Bytes a, Bytes b) {
  return _mm_avg_epu16(a, b);
}
template <int kBits>
inline Bytes left16(Bytes a) {
  return _mm_slli_epi16(a, kBits);
}
template <int kBits>
inline Bytes right16(Bytes a) {
  return _mm_srli_epi16(a, kBits);
}
inline Bytes both(Bytes a, Bytes b) {
  return _mm_and_si128(a, b);
}
inline Bytes either(Bytes a, Bytes b) {
  return _mm_or_si128(a, b);
}
inline Bytes differ(Bytes a, Bytes b) {
  return _mm_xor_si128(a, b);
}
inline Bytes look_up(Bytes table, Bytes index) {  // index 0..15
  return _mm_shuffle_epi8(table, index);
}
inline Bytes choose(Bytes a, Bytes b, Bytes mask) {  // b where the mask is set
  return _mm_blendv_epi8(a, b, mask);
}
inline Word signs(Bytes a) {
  return static_cast<Word>(_mm_movemask_epi8(a));
}
// The first kLanes / 2 bytes at `from` as 16-bit values.
inline Bytes widen(const uint8_t* from) {
  return _mm_cvtepu8_epi16(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)));
}
// Masks of 16 bits, of pixels 0..7 and 8..15, to a mask of bytes in the order of kPackedByte.
inline Bytes pack(Bytes low, Bytes high) {
  return _mm_packs_epi16(low, high);
}
constexpr int32_t kPackedByte[kLanes / 8] = {0, 1};  // where byte i of signs(pack(..)) lies

// Byte b of kLanes words goes to vector b, in the order of the words.
inline void split_bytes(const Word* words, Bytes out[kLanes / 8]) {
  const __m128i by_byte = table16(reinterpret_cast<const uint8_t*>("\0\2\4\6\10\12\14\16\1\3\5\7\11\13\15\17"));
  const __m128i a = look_up(load(words), by_byte);
  const __m128i b = look_up(load(words + 8), by_byte);
  out[0] = _mm_unpacklo_epi64(a, b);
  out[1] = _mm_unpackhi_epi64(a, b);
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_LANES_SSE42_H
