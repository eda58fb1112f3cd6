// match_hamming, AVX2: 256 bits of a candidate at once, population counts by table of nibbles.
// Counting of a candidate stops, 1024 bits at a time, once neither view can win; descriptors of 64, 128 and 256 bits are
// counted in words. Bound, per 256 bits of a candidate and both views: 1 XOR, 2 ANDs, 2 population counts of 6 operations, 2
// additions of bytes; 4 loads. Descriptors whose length is no multiple of 256 bits end with 64-bit words.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include <immintrin.h>

#include "simd/x86/match_row.h"

namespace bsm {
namespace {

inline __m256i load(const uint8_t* bytes) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(bytes));
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

// Sums of the bytes of both: left in the lower half of the result, right in the upper one.
inline Costs sum_bytes(__m256i left, __m256i right) {
  const __m256i l = _mm256_sad_epu8(left, _mm256_setzero_si256());
  const __m256i r = _mm256_sad_epu8(right, _mm256_setzero_si256());
  const __m256i both = _mm256_or_si256(l, _mm256_slli_epi64(r, 32));
  __m128i sum = _mm_add_epi64(_mm256_castsi256_si128(both), _mm256_extracti128_si256(both, 1));
  sum = _mm_add_epi64(sum, _mm_unpackhi_epi64(sum, sum));
  const uint64_t word = static_cast<uint64_t>(_mm_cvtsi128_si64(sum));
  return Costs{static_cast<uint32_t>(word), static_cast<uint32_t>(word >> 32)};
}

// Adds 256 bits of the candidate to the counts of bytes; at most 31 times.
template <bool kMasked>
inline void add_vector(Pixel left, Pixel right, ptrdiff_t at, __m256i& left_count, __m256i& right_count) {
  const __m256i differing = _mm256_xor_si256(load(left.descriptor + at), load(right.descriptor + at));
  if (kMasked) {
    left_count = _mm256_add_epi8(left_count, count_bytes(_mm256_and_si256(differing, load(left.mask + at))));
    right_count = _mm256_add_epi8(right_count, count_bytes(_mm256_and_si256(differing, load(right.mask + at))));
  } else {
    left_count = right_count = _mm256_add_epi8(left_count, count_bytes(differing));
  }
}

template <bool kMasked>
inline void add_word(Pixel left, Pixel right, ptrdiff_t at, Costs& costs) {
  const uint64_t differing = load_word(left.descriptor + at) ^ load_word(right.descriptor + at);
  const uint64_t own = kMasked ? differing & load_word(left.mask + at) : differing;
  const uint64_t other = kMasked ? differing & load_word(right.mask + at) : differing;
  costs.left += static_cast<uint32_t>(_mm_popcnt_u64(own));
  costs.right += static_cast<uint32_t>(_mm_popcnt_u64(other));
}

template <bool kMasked>
inline Costs hamming(Pixel left, Pixel right, ptrdiff_t bytes, uint32_t left_limit, uint32_t right_limit) {
  Costs costs{0, 0};
  ptrdiff_t at = 0;
  while (at + 32 <= bytes) {
    __m256i left_count = _mm256_setzero_si256();
    __m256i right_count = _mm256_setzero_si256();
    if (at + 128 <= bytes) {
      BSM_UNROLL
      for (int32_t i = 0; i < 4; ++i, at += 32) add_vector<kMasked>(left, right, at, left_count, right_count);
    } else {
      for (; at + 32 <= bytes; at += 32) add_vector<kMasked>(left, right, at, left_count, right_count);
    }
    const Costs more = sum_bytes(left_count, right_count);
    costs.left += more.left;
    costs.right += more.right;
    if (costs.left > left_limit && costs.right > right_limit) return costs;
  }
  for (; at < bytes; at += 8) add_word<kMasked>(left, right, at, costs);
  return costs;
}

// Descriptors of exactly kWords words.
template <bool kMasked, int32_t kWords>
void match_words(const MatchHammingArgs& args) {
  match_row<kMasked>(args, [](Pixel left, Pixel right, uint32_t, uint32_t) {
    Costs costs{0, 0};
    BSM_UNROLL
    for (int32_t i = 0; i < kWords; ++i) add_word<kMasked>(left, right, ptrdiff_t{i} * 8, costs);
    return costs;
  });
}

template <bool kMasked>
void match(const MatchHammingArgs& args) {
  const ptrdiff_t bytes = args.bits / 8;
  switch (args.bits / 64) {
    case 1:
      return match_words<kMasked, 1>(args);
    case 2:
      return match_words<kMasked, 2>(args);
    case 4:
      return match_words<kMasked, 4>(args);
    default:
      return match_row<kMasked>(args, [bytes](Pixel left, Pixel right, uint32_t left_limit, uint32_t right_limit) {
        return hamming<kMasked>(left, right, bytes, left_limit, right_limit);
      });
  }
}

}  // namespace

uint64_t match_hamming_avx2_scratch(const KernelShape& shape) {
  return match_scratch_bytes(shape);
}

void match_hamming_avx2(const MatchHammingArgs& args) {
  if (args.left_mask != nullptr) {
    match<true>(args);
  } else {
    match<false>(args);
  }
}

}  // namespace bsm
#endif
