// Counts of set bits in AVX2, with words of four descriptors told apart by number: a register holds the same word of each,
// so that counts add up without a move between lanes. Set bits are looked up by half bytes.
#ifndef BSM_SIMD_X86_HAMMING_AVX2_H
#define BSM_SIMD_X86_HAMMING_AVX2_H

#include <immintrin.h>
#include <stddef.h>
#include <stdint.h>

#include "platform/compiler.h"
#include "simd/x86/hamming_blocks.h"

namespace bsm {
namespace {

constexpr int32_t kPixels = 4;  // of a block: lanes

inline int64_t load_lane(const uint8_t* word) {
  return static_cast<int64_t>(load_word(word));
}

inline __m256i every_word(const uint8_t* word) {
  return _mm256_set1_epi64x(load_lane(word));
}

// Set bits of each byte.
inline __m256i count_bytes(__m256i bits) {
  const __m256i counts =
      _mm256_setr_epi8(0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4, 0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4);
  const __m256i nibble = _mm256_set1_epi8(15);
  const __m256i low = _mm256_shuffle_epi8(counts, _mm256_and_si256(bits, nibble));
  const __m256i high = _mm256_shuffle_epi8(counts, _mm256_and_si256(_mm256_srli_epi16(bits, 4), nibble));
  return _mm256_add_epi8(low, high);
}

// Counts of words: bytes of up to 31 words, or with `fours` bits of one and of two and bytes of four, of 4 * 31
// words.
struct Counter {
  __m256i bytes, ones, twos, fours;

  Counter() : bytes(_mm256_setzero_si256()), ones(bytes), twos(bytes), fours(bytes) {}

  void add(__m256i word) { bytes = _mm256_add_epi8(bytes, count_bytes(word)); }
  void add_four(const __m256i (&words)[4]) {
    const __m256i a = carry(ones, words[0], words[1]);
    const __m256i b = carry(ones, words[2], words[3]);
    fours = _mm256_add_epi8(fours, count_bytes(carry(twos, a, b)));
  }
  // Sums of each lane.
  __m256i sum() const { return _mm256_sad_epu8(bytes, _mm256_setzero_si256()); }
  __m256i sum_of_fours() const {
    const __m256i two = count_bytes(twos);
    const __m256i few = _mm256_add_epi8(_mm256_add_epi8(two, two), _mm256_add_epi8(count_bytes(ones), bytes));
    const __m256i zero = _mm256_setzero_si256();
    return _mm256_add_epi64(_mm256_sad_epu8(few, zero), _mm256_slli_epi64(_mm256_sad_epu8(fours, zero), 2));
  }

 private:
  // Adds two bits to one of the same weight and returns those of twice the weight.
  static __m256i carry(__m256i& sum, __m256i a, __m256i b) {
    const __m256i differing = _mm256_xor_si256(sum, a);
    const __m256i carried = _mm256_or_si256(_mm256_and_si256(sum, a), _mm256_and_si256(differing, b));
    sum = _mm256_xor_si256(differing, b);
    return carried;
  }
};

// Four neighbours' descriptors: their words by number, in memory.
struct Block {
  __m256i* words;

  // Of the first `pixels` of them the last one fills the lanes behind it.
  Block(const uint8_t* descriptors, int32_t pixels, ptrdiff_t bytes, __m256i* memory) : words(memory) {
    const uint8_t* lane[kPixels];
    for (int32_t i = 0; i < kPixels; ++i) lane[i] = descriptors + (i < pixels ? i : pixels - 1) * bytes;
    for (ptrdiff_t at = 0; at < bytes; at += 8) {
      _mm256_store_si256(words + at / 8, _mm256_setr_epi64x(load_lane(lane[0] + at), load_lane(lane[1] + at),
                                                            load_lane(lane[2] + at), load_lane(lane[3] + at)));
    }
  }
};

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_HAMMING_AVX2_H
