// From vectors of eight bits of each pixel to the pixels' descriptors.
#ifndef BSM_SIMD_ARM_TRANSPOSE_SVE_H
#define BSM_SIMD_ARM_TRANSPOSE_SVE_H

#include "simd/arm/sve.h"

namespace bsm {
namespace {

// Words of consecutive pixels, `stride` bytes apart; of `pixels` pixels.
inline void store_words(svuint64_t words, int32_t pixels, uint8_t* out, ptrdiff_t stride) {
  const svint64_t offsets = svindex_s64(0, stride);
  svst1_scatter_offset(svwhilelt_b64(int32_t{0}, pixels), reinterpret_cast<uint64_t*>(out), offsets, words);
}

// Sixteen bits each of the pixels of a vector of 16-bit lanes, to words `stride` bytes apart.
inline void store_quarters(svuint16_t a, svuint16_t b, svuint16_t c, svuint16_t d, int32_t pixels, uint8_t* out,
                           ptrdiff_t stride) {
  const int32_t words = static_cast<int32_t>(svcntd());
  const svuint32_t ab0 = svreinterpret_u32(svzip1(a, b));
  const svuint32_t ab1 = svreinterpret_u32(svzip2(a, b));
  const svuint32_t cd0 = svreinterpret_u32(svzip1(c, d));
  const svuint32_t cd1 = svreinterpret_u32(svzip2(c, d));
  store_words(svreinterpret_u64(svzip1(ab0, cd0)), pixels, out, stride);
  store_words(svreinterpret_u64(svzip2(ab0, cd0)), pixels - words, out + words * stride, stride);
  store_words(svreinterpret_u64(svzip1(ab1, cd1)), pixels - 2 * words, out + 2 * words * stride, stride);
  store_words(svreinterpret_u64(svzip2(ab1, cd1)), pixels - 3 * words, out + 3 * words * stride, stride);
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_TRANSPOSE_SVE_H
