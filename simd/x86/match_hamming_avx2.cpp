// match_hamming, AVX2: four right pixels against left pixels one after the other, both views.
// The right pixels' words lie apart by number, a lane for each pixel, in the first-level cache; a left pixel's word goes to
// all lanes as it is loaded, so that counts add up without a move between lanes. Set bits are looked up by half bytes, four
// words of long descriptors added bit by bit before. A winner is the least of cost and level in one 32-bit word, so that
// ties need no order.
// Bound for four candidates, by word of a descriptor: 1 XOR, 2 ANDs, 2 counts of 6 operations, 2 additions, the first of
// which are none; 4 loads; once 2 sums of bytes. Above 256 bits, by four words: 12, and for each view 3 carry-save additions
// of 5, a count and an addition; once 18 a view. Then 4 to make keys of both views, 2 minima, 1 for the next levels. Three
// ports do them: 25 cycles for 256 bits and 313 for 4096, 6.3 and 78 a candidate. A block meets D + 3 left pixels for D
// levels.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include <immintrin.h>

#include "simd/kernels.h"
#include "simd/x86/hamming_avx2.h"

namespace bsm {
namespace {

// Four right pixels: their descriptors and masks.
struct RightPixels {
  Block words, masks;

  RightPixels(View right, int32_t pixels, ptrdiff_t bytes, __m256i* memory)
      : words(right.descriptors, pixels, bytes, memory),
        masks(right.masks == nullptr ? right.descriptors : right.masks, pixels, bytes, memory + bytes / 8) {}
};

// Costs of the lanes against one left pixel, by 64-bit word.
struct Costs {
  __m256i left, right;
};

// kWords: words of a descriptor, few; 0 for any number.
template <bool kMasked, int32_t kWords>
BSM_INLINE Costs count(const RightPixels& right, View left, ptrdiff_t bytes) {
  Counter left_counter, right_counter;
  const auto word = [&](ptrdiff_t i, __m256i& own, __m256i& other) {
    const __m256i differing =
        _mm256_xor_si256(every_word(left.descriptors + 8 * i), _mm256_load_si256(right.words.words + i));
    own = kMasked ? _mm256_and_si256(differing, every_word(left.masks + 8 * i)) : differing;
    other = kMasked ? _mm256_and_si256(differing, _mm256_load_si256(right.masks.words + i)) : differing;
  };
  __m256i own[4], other[4];
  if constexpr (kWords != 0) {
    BSM_UNROLL
    for (int32_t i = 0; i < kWords; ++i) {
      word(i, own[0], other[0]);
      left_counter.add(own[0]);
      right_counter.add(other[0]);
    }
    return Costs{left_counter.sum(), right_counter.sum()};
  } else {
    ptrdiff_t i = 0;
    for (; i + 4 <= bytes / 8; i += 4) {
      BSM_UNROLL
      for (int32_t k = 0; k < 4; ++k) word(i + k, own[k], other[k]);
      left_counter.add_four(own);
      if (kMasked) right_counter.add_four(other);
    }
    for (; i < bytes / 8; ++i) {
      word(i, own[0], other[0]);
      left_counter.add(own[0]);
      if (kMasked) right_counter.add(other[0]);
    }
    const __m256i cost = left_counter.sum_of_fours();
    return Costs{cost, kMasked ? right_counter.sum_of_fours() : cost};
  }
}

// How a block's pixels meet left pixels.
struct Meeting {
  int32_t left;    // the pixel that meets the first one at level 0
  int32_t pixels;  // of the block, within the row
  int32_t num_disparities;

  // Levels of the pixels for left pixel x, in both halves of a word.
  __m256i levels(int32_t x) const {
    return _mm256_slli_epi32(_mm256_sub_epi32(_mm256_set1_epi32(x - left), lanes()), kLevelShift);
  }
  // All bits of the lanes that are no candidates at such levels.
  __m256i no_candidates(__m256i levels) const {
    const __m256i beyond = _mm256_cmpgt_epi32(lanes(), _mm256_set1_epi32(pixels - 1));
    const __m256i below = _mm256_cmpgt_epi32(_mm256_setzero_si256(), levels);
    const __m256i above = _mm256_cmpgt_epi32(levels, _mm256_set1_epi32((num_disparities - 1) << kLevelShift));
    return _mm256_or_si256(beyond, _mm256_or_si256(below, above));
  }

 private:
  static __m256i lanes() { return _mm256_setr_epi32(0, 0, 1, 1, 2, 2, 3, 3); }
};

// Compares left pixels begin .. end - 1 and returns the block's least keys, `best` so far. A vector of keys holds the left
// view's in the lower halves of its words, the right view's in the upper. kWhole: all pixels of the block are candidates.
template <bool kWhole, bool kMasked, int32_t kWords>
inline __m256i compare(const RightPixels& right, View left, ptrdiff_t bytes, Meeting meeting, int32_t begin, int32_t end,
                       __m256i* left_best, __m256i best) {
  if (kWords != 0) bytes = 8 * kWords;
  __m256i levels = meeting.levels(begin);
  left = left.from(begin * bytes);
  for (int32_t x = begin; x < end; ++x, left = left.from(bytes)) {
    const Costs costs = count<kMasked, kWords>(right, left, bytes);
    const __m256i both = _mm256_or_si256(_mm256_slli_epi64(costs.left, 16), _mm256_slli_epi64(costs.right, 48));
    __m256i keys = _mm256_or_si256(both, levels);
    if (!kWhole) keys = _mm256_or_si256(keys, meeting.no_candidates(levels));
    _mm256_store_si256(left_best + x, _mm256_min_epu32(_mm256_load_si256(left_best + x), keys));
    best = _mm256_min_epu32(best, keys);
    levels = _mm256_add_epi32(levels, _mm256_set1_epi32(1 << kLevelShift));
  }
  return best;
}

inline uint16_t least_lower_half(__m256i keys) {
  __m128i least = _mm_min_epu32(_mm256_castsi256_si128(keys), _mm256_extracti128_si256(keys, 1));
  least = _mm_min_epu32(least, _mm_shuffle_epi32(least, 0x4e));
  return static_cast<uint16_t>(_mm_cvtsi128_si32(least));
}

template <bool kMasked, int32_t kWords>
BSM_NOINLINE void match_row(const MatchHammingArgs& row) {
  const MatchHammingArgs args = row;  // a copy, which the levels written cannot change
  const ptrdiff_t bytes = args.bits / 8;
  __m256i* left_best = static_cast<__m256i*>(args.scratch);
  for (int32_t x = 0; x < args.width; ++x) _mm256_store_si256(left_best + x, _mm256_set1_epi32(-1));
  const View left{args.left, args.left_mask};
  const View right{args.right, args.right_mask};
  for (int32_t first = 0; first < args.width; first += kPixels) {
    const int32_t pixels = args.width - first < kPixels ? args.width - first : kPixels;
    const Meeting meeting{first + args.min_disparity, pixels, args.num_disparities};
    const Span span(args.width, meeting.left, args.num_disparities, pixels, kPixels);
    const RightPixels block(right.from(first * bytes), pixels, bytes, left_best + args.width);
    __m256i best = _mm256_set1_epi32(-1);
    best = compare<false, kMasked, kWords>(block, left, bytes, meeting, span.begin, span.all_begin, left_best, best);
    best = compare<true, kMasked, kWords>(block, left, bytes, meeting, span.all_begin, span.all_end, left_best, best);
    best = compare<false, kMasked, kWords>(block, left, bytes, meeting, span.all_end, span.end, left_best, best);
    alignas(32) uint64_t keys[kPixels];
    _mm256_store_si256(reinterpret_cast<__m256i*>(keys), best);
    for (int32_t i = 0; i < pixels; ++i) args.right_level[first + i] = static_cast<uint16_t>(keys[i] >> 32);
  }
  // A key's lower half is its level, and kNoLevel without candidates.
  for (int32_t x = 0; x < args.width; ++x) args.left_level[x] = least_lower_half(left_best[x]);
}

}  // namespace

uint64_t match_hamming_avx2_scratch(const KernelShape& shape) {
  return sizeof(__m256i) * (static_cast<uint64_t>(shape.width) + 2 * static_cast<uint64_t>(shape.bits / 64));
}

void match_hamming_avx2(const MatchHammingArgs& args) {
  if (args.left_mask == nullptr) return match_row<false, 0>(args);  // for studies: any length alike
  with_words<4>(args.bits / 64, [&](auto words) { match_row<true, decltype(words)::kCount>(args); });
}

}  // namespace bsm
#endif
