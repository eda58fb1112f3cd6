// More of lanes_sse42.h for kernels of 16-bit values, such as the levels of a pixel: the names of simd/x86/levels_avx2.h in
// 128 bits.
#ifndef BSM_SIMD_X86_LEVELS_SSE42_H
#define BSM_SIMD_X86_LEVELS_SSE42_H

#include "simd/x86/lanes_sse42.h"

namespace bsm {
namespace {

constexpr int32_t kLevelLanes = 8;
alignas(16) constexpr uint16_t kLevelNumbers[kLevelLanes] = {0, 1, 2, 3, 4, 5, 6, 7};

inline Bytes ones() {
  return set16(-1);
}
inline Bytes sub16(Bytes a, Bytes b) {
  return _mm_sub_epi16(a, b);
}
// (a * b + 2^14) >> 15, signed.
inline Bytes multiply16_rounded(Bytes a, Bytes b) {
  return _mm_mulhrs_epi16(a, b);
}
// The least lane.
inline uint32_t least_lane(Bytes a) {
  return static_cast<uint32_t>(_mm_cvtsi128_si32(_mm_minpos_epu16(a))) & 0xffff;
}
// The least lane, in all lanes.
inline Bytes least_everywhere(Bytes a) {
  return _mm_shuffle_epi8(_mm_minpos_epu16(a), _mm_set1_epi16(0x0100));
}
// Lane k of the result is lane k - 1 of `a`, lane 0 the last of `before`.
inline Bytes from_below(Bytes before, Bytes a) {
  return _mm_alignr_epi8(a, before, 14);
}
// Lane k of the result is lane k + 1 of `a`, the last lane the first of `after`.
inline Bytes from_above(Bytes a, Bytes after) {
  return _mm_alignr_epi8(after, a, 2);
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

#endif  // BSM_SIMD_X86_LEVELS_SSE42_H
