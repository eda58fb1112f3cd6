// Words of 64 pixels to descriptors: bit x of word i becomes bit i of pixel x (AVX-512 VBMI, GFNI).
// GFNI turns 8 x 8 bits in one instruction; the rest is bytes and words in registers: 112 instructions for 64 x 64 bits.
#ifndef BSM_SIMD_X86_TRANSPOSE_AVX512_H
#define BSM_SIMD_X86_TRANSPOSE_AVX512_H

#include <immintrin.h>
#include <stddef.h>
#include <stdint.h>

#include "platform/compiler.h"

namespace bsm {
namespace {

constexpr int32_t kTileWords = 512;  // words that one tile of descriptors takes: 64 bytes of each pixel
constexpr uint64_t kTileBytes = 8 * 64 * 8;

// Byte 8 b + 7 - i of the result is byte 8 i + b: rows of bits for the matrix product, which counts them from the top.
alignas(64) constexpr uint8_t kRowsOfOctets[64] = {56, 48, 40, 32, 24, 16, 8,  0, 57, 49, 41, 33, 25, 17, 9,  1,
                                                   58, 50, 42, 34, 26, 18, 10, 2, 59, 51, 43, 35, 27, 19, 11, 3,
                                                   60, 52, 44, 36, 28, 20, 12, 4, 61, 53, 45, 37, 29, 21, 13, 5,
                                                   62, 54, 46, 38, 30, 22, 14, 6, 63, 55, 47, 39, 31, 23, 15, 7};

// 64 words to 64 words; word 8 k + 2 l + h of the result belongs to pixel 16 l + 2 k + h.
inline void transpose_words(const uint64_t* words, uint64_t* out) {
  const __m512i rows = _mm512_load_si512(kRowsOfOctets);
  const __m512i unit = _mm512_set1_epi64(static_cast<int64_t>(0x8040201008040201u));
  __m512i y[8];
  BSM_UNROLL
  for (int32_t i = 0; i < 8; ++i) {
    const __m512i octets = _mm512_permutexvar_epi8(rows, _mm512_loadu_si512(words + 8 * i));
    y[i] = _mm512_gf2p8affine_epi64_epi8(unit, octets, 0);
  }
  __m512i pairs[8];
  BSM_UNROLL
  for (int32_t i = 0; i < 4; ++i) {
    pairs[i] = _mm512_unpacklo_epi8(y[2 * i], y[2 * i + 1]);
    pairs[i + 4] = _mm512_unpackhi_epi8(y[2 * i], y[2 * i + 1]);
  }
  BSM_UNROLL
  for (int32_t i = 0; i < 8; i += 4) {  // bytes 0..7, then 8..15 of each lane
    const __m512i low0 = _mm512_unpacklo_epi16(pairs[i], pairs[i + 1]);
    const __m512i low1 = _mm512_unpacklo_epi16(pairs[i + 2], pairs[i + 3]);
    const __m512i high0 = _mm512_unpackhi_epi16(pairs[i], pairs[i + 1]);
    const __m512i high1 = _mm512_unpackhi_epi16(pairs[i + 2], pairs[i + 3]);
    uint64_t* to = out + 8 * i;
    _mm512_store_si512(to, _mm512_unpacklo_epi32(low0, low1));
    _mm512_store_si512(to + 8, _mm512_unpackhi_epi32(low0, low1));
    _mm512_store_si512(to + 16, _mm512_unpacklo_epi32(high0, high1));
    _mm512_store_si512(to + 24, _mm512_unpackhi_epi32(high0, high1));
  }
}

// Eight words of eight pixels each, transposed.
inline void transpose_groups(const uint64_t* groups, __m512i out[8]) {
  __m512i half[2][4];
  BSM_UNROLL
  for (int32_t i = 0; i < 4; ++i) {
    const __m512i a = _mm512_load_si512(groups + 64 * (2 * i));
    const __m512i b = _mm512_load_si512(groups + 64 * (2 * i + 1));
    half[0][i] = _mm512_unpacklo_epi64(a, b);
    half[1][i] = _mm512_unpackhi_epi64(a, b);
  }
  BSM_UNROLL
  for (int32_t h = 0; h < 2; ++h) {
    const __m512i a = _mm512_shuffle_i64x2(half[h][0], half[h][1], 0x44);
    const __m512i b = _mm512_shuffle_i64x2(half[h][0], half[h][1], 0xee);
    const __m512i c = _mm512_shuffle_i64x2(half[h][2], half[h][3], 0x44);
    const __m512i d = _mm512_shuffle_i64x2(half[h][2], half[h][3], 0xee);
    out[h] = _mm512_shuffle_i64x2(a, c, 0x88);
    out[2 + h] = _mm512_shuffle_i64x2(a, c, 0xdd);
    out[4 + h] = _mm512_shuffle_i64x2(b, d, 0x88);
    out[6 + h] = _mm512_shuffle_i64x2(b, d, 0xdd);
  }
}

// At most eight groups of 64 words to the same 8 * groups bytes of `pixels` descriptors, `stride` bytes apart. tile:
// kTileBytes of memory.
BSM_NOINLINE void store_descriptors(const uint64_t* words, int32_t groups, int32_t pixels, uint8_t* out, ptrdiff_t stride,
                                    uint64_t* tile) {
  for (int32_t group = 0; group < groups; ++group) transpose_words(words + 64 * group, tile + 64 * group);
  if (groups <= 2) {
    BSM_UNROLL
    for (int32_t k = 0; k < 8; ++k) {
      const __m512i a = _mm512_load_si512(tile + 8 * k);
      const __m512i b = _mm512_load_si512(tile + 8 * k + (groups == 2 ? 64 : 0));
      const __m512i half[2] = {_mm512_unpacklo_epi64(a, b), _mm512_unpackhi_epi64(a, b)};
      BSM_UNROLL
      for (int32_t h = 0; h < 2; ++h) {
        const __m128i lanes[4] = {_mm512_castsi512_si128(half[h]), _mm512_extracti64x2_epi64(half[h], 1),
                                  _mm512_extracti64x2_epi64(half[h], 2), _mm512_extracti64x2_epi64(half[h], 3)};
        BSM_UNROLL
        for (int32_t l = 0; l < 4; ++l) {
          const int32_t pixel = 16 * l + 2 * k + h;
          if (pixel >= pixels) break;
          __m128i* to = reinterpret_cast<__m128i*>(out + pixel * stride);
          if (groups == 2) {
            _mm_storeu_si128(to, lanes[l]);
          } else {
            _mm_storel_epi64(to, lanes[l]);
          }
        }
      }
    }
    return;
  }
  const __mmask8 kept = static_cast<__mmask8>((1u << groups) - 1);
  BSM_UNROLL
  for (int32_t k = 0; k < 8; ++k) {
    __m512i pixel_words[8];
    transpose_groups(tile + 8 * k, pixel_words);
    BSM_UNROLL
    for (int32_t i = 0; i < 8; ++i) {
      const int32_t pixel = 16 * (i >> 1) + 2 * k + (i & 1);
      if (pixel < pixels) _mm512_mask_storeu_epi64(out + pixel * stride, kept, pixel_words[i]);
    }
  }
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_TRANSPOSE_AVX512_H
