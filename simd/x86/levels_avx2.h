// More of lanes_avx2.h for kernels of 16-bit values, such as the levels of a pixel: the names of simd/x86/levels_sse42.h in
// 256 bits.
#ifndef BSM_SIMD_X86_LEVELS_AVX2_H
#define BSM_SIMD_X86_LEVELS_AVX2_H

#include "simd/x86/lanes_avx2.h"

namespace bsm {
namespace {

constexpr int32_t kLevelLanes = 16;
alignas(32) constexpr uint16_t kLevelNumbers[kLevelLanes] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

inline Bytes ones() {
  return set16(-1);
}
inline Bytes sub16(Bytes a, Bytes b) {
  return _mm256_sub_epi16(a, b);
}
// (a * b + 2^14) >> 15, signed.
inline Bytes multiply16_rounded(Bytes a, Bytes b) {
  return _mm256_mulhrs_epi16(a, b);
}
// The least lane.
inline uint32_t least_lane(Bytes a) {
  const __m128i half = _mm_min_epu16(_mm256_castsi256_si128(a), _mm256_extracti128_si256(a, 1));
  return static_cast<uint32_t>(_mm_cvtsi128_si32(_mm_minpos_epu16(half))) & 0xffff;
}
// The least lane, in all lanes.
inline Bytes least_everywhere(Bytes a) {
  const __m128i half = _mm_min_epu16(_mm256_castsi256_si128(a), _mm256_extracti128_si256(a, 1));
  return _mm256_broadcastw_epi16(_mm_minpos_epu16(half));
}
// Lane k of the result is lane k - 1 of `a`, lane 0 the last of `before`.
inline Bytes from_below(Bytes before, Bytes a) {
  return _mm256_alignr_epi8(a, _mm256_permute2x128_si256(before, a, 0x21), 14);
}
// Lane k of the result is lane k + 1 of `a`, the last lane the first of `after`.
inline Bytes from_above(Bytes a, Bytes after) {
  return _mm256_alignr_epi8(_mm256_permute2x128_si256(a, after, 0x21), a, 2);
}

// The first lanes of a pixel's last register: levels, the others are padding.
struct LastLanes {
  Bytes padding;

  explicit LastLanes(int32_t count) : padding(equal16(max16(load(kLevelNumbers), set16(count)), load(kLevelNumbers))) {}
  // Padding reads as ones and keeps what it holds.
  Bytes load_from(const uint16_t* from) const { return either(load(from), padding); }
  void store_to(uint16_t* to, Bytes value) const { store(to, choose(value, load(to), padding)); }
};

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_LEVELS_AVX2_H
