// Counts under a mask in AVX-512 F, VL and VPOPCNTDQ, with words of eight descriptors told apart by number: a register holds
// the same word of each, so that counts add up without a move between lanes.
#ifndef BSM_SIMD_X86_HAMMING_AVX512_H
#define BSM_SIMD_X86_HAMMING_AVX512_H

#include <immintrin.h>
#include <stddef.h>
#include <stdint.h>

#include "platform/compiler.h"
#include "simd/x86/hamming_blocks.h"

namespace bsm {
namespace {

constexpr int32_t kPixels = 8;  // of a block: lanes

// Blocks that begin with one of `pixels` neighbours.
constexpr int32_t block_count(int32_t pixels) {
  return (pixels + kPixels - 1) / kPixels;
}

// Set bits of (other ^ own) & mask, by 64-bit word. The first operand is overwritten: the one that is not needed again.
inline __m512i count(__m512i other, __m512i own, __m512i mask) {
  return _mm512_popcnt_epi64(_mm512_ternarylogic_epi64(other, own, mask, 0x28));
}

inline __m512i every_word(const uint8_t* word) {
  return _mm512_broadcastq_epi64(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(word)));
}

// The same for several uses: GCC would load it again for each.
inline __m512i every_word_once(const uint8_t* word) {
  __m512i words = every_word(word);
#ifndef __clang__
  __asm__("" : "+v"(words));
#endif
  return words;
}

// The first of eight words, as many as there are.
inline __mmask8 first_words(ptrdiff_t count) {
  return static_cast<__mmask8>(count >= 8 ? 0xffu : count > 0 ? (1u << count) - 1 : 0u);
}

// kWords registers, 1, 2 or 4, with eight descriptors in a row to one register for each number of a word; every `step`-th
// of `to`.
template <int32_t kWords>
inline void split_words(const __m512i (&from)[kWords], __m512i* to, int32_t step) {
  if constexpr (kWords == 1) {
    *to = from[0];
  } else {
    const __m512i evens = _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14);
    const __m512i odds = _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15);
    __m512i even[kWords / 2], odd[kWords / 2];
    BSM_UNROLL
    for (int32_t i = 0; i < kWords / 2; ++i) {
      even[i] = _mm512_permutex2var_epi64(from[2 * i], evens, from[2 * i + 1]);
      odd[i] = _mm512_permutex2var_epi64(from[2 * i], odds, from[2 * i + 1]);
    }
    split_words<kWords / 2>(even, to, 2 * step);
    split_words<kWords / 2>(odd, to + step, 2 * step);
  }
}

// The same for four of a longer descriptor's words, of which `words` are loaded; those of pixels from `pixels` on are zero.
inline void split_four(const uint8_t* descriptors, int32_t pixels, ptrdiff_t bytes, __mmask8 words, __m512i (&to)[4]) {
  const auto load = [&](int32_t i) {
    return _mm256_maskz_loadu_epi64(i < pixels ? words : __mmask8{0}, descriptors + i * bytes);
  };
  __m512i from[4];  // two pixels each
  BSM_UNROLL
  for (int32_t i = 0; i < 4; ++i) {
    from[i] = _mm512_inserti64x4(_mm512_castsi256_si512(load(2 * i)), load(2 * i + 1), 1);
  }
  split_words<4>(from, to, 1);
}

// Eight neighbours' descriptors apart by number: store(number, lanes) for each of their words. Those from `pixels` on are
// zero. kWords: words of a descriptor, 0 for any number.
template <int32_t kWords, class Store>
BSM_INLINE void split_block(const uint8_t* descriptors, int32_t pixels, ptrdiff_t bytes, const Store& store) {
  if constexpr (kWords == 1 || kWords == 2 || kWords == 4) {
    __m512i from[kWords], words[kWords];
    BSM_UNROLL
    for (int32_t i = 0; i < kWords; ++i) {
      from[i] = _mm512_maskz_loadu_epi64(first_words(ptrdiff_t{pixels} * kWords - 8 * i), descriptors + 64 * i);
    }
    split_words<kWords>(from, words, 1);
    BSM_UNROLL
    for (int32_t i = 0; i < kWords; ++i) store(ptrdiff_t{i}, words[i]);
  } else {
    const ptrdiff_t count = kWords != 0 ? kWords : bytes / 8;
    for (ptrdiff_t at = 0; at < count; at += 4) {
      __m512i words[4];
      split_four(descriptors + 8 * at, pixels, bytes, first_words(count - at) & 0xf, words);
      BSM_UNROLL
      for (int32_t i = 0; i < 4; ++i) {
        if (at + i < count) store(at + i, words[i]);
      }
    }
  }
}

// Eight neighbours' descriptors of kWords words in registers; those from `pixels` on are zero.
template <int32_t kWords>
struct Block {
  static constexpr int32_t kAtOnce = 1;  // pixels that meet the block together
  __m512i words[kWords];

  Block(const uint8_t* descriptors, int32_t pixels, ptrdiff_t bytes, __m512i*) {
    split_block<kWords>(descriptors, pixels, bytes, [&](ptrdiff_t i, __m512i lanes) { words[i] = lanes; });
  }
  // The eight words that begin with byte `at` of their descriptors.
  __m512i word(ptrdiff_t at) const { return words[at / 8]; }
  template <class Visit>
  static BSM_INLINE void for_each_word(ptrdiff_t, const Visit& visit) {
    BSM_UNROLL
    for (int32_t i = 0; i < kWords; ++i) visit(ptrdiff_t{8} * i);
  }
};

// The same for any number of words, in memory.
template <>
struct Block<0> {
  static constexpr int32_t kAtOnce = 4;
  __m512i* words;

  Block(const uint8_t* descriptors, int32_t pixels, ptrdiff_t bytes, __m512i* memory) : words(memory) {
    split_block<0>(descriptors, pixels, bytes, [&](ptrdiff_t i, __m512i lanes) { _mm512_store_si512(memory + i, lanes); });
  }
  __m512i word(ptrdiff_t at) const { return _mm512_load_si512(words + at / 8); }
  template <class Visit>
  static BSM_INLINE void for_each_word(ptrdiff_t bytes, const Visit& visit) {
    for (ptrdiff_t at = 0; at < bytes; at += 8) visit(at);
  }
};

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_HAMMING_AVX512_H
