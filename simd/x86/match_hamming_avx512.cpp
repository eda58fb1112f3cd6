// match_hamming, AVX-512 F, BW, VPOPCNTDQ: eight right pixels against left pixels one after the other, both views.
// The right pixels' words lie apart by number, a lane for each pixel: in registers, or in the first-level cache for long
// descriptors, which then meet four left pixels at once. A left pixel's word goes to all lanes as it is loaded, so that
// counts add up without a move between lanes and no load crosses a cache line. The XOR of a candidate never leaves the
// register: one three-operand operation XORs and masks for each view. A winner is the least of cost and level in one 32-bit
// word, so that ties need no order. Bound for eight candidates: by word of a descriptor 2 logic, 2 population counts, 2
// additions, the first 2 of which are none; then 3 to make keys of both views, 2 minima, 1 for the next levels. Two ports do
// them, one of which alone counts: 14 cycles for 256 bits and 194 for 4096, 1.8 and 24.3 a candidate. Carry-save additions
// before the counts would gain nothing, as each takes two operations and saves two. A block meets D + 7 left pixels for D
// levels: 7 in D + 7 lanes are idle.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include <immintrin.h>

#include "simd/kernels.h"
#include "simd/x86/hamming_avx512.h"

namespace bsm {
namespace {

constexpr int32_t kPixels = 8;  // of a block: lanes

// How a block's pixels meet left pixels.
struct Meeting {
  int32_t left;    // the pixel that meets the first one at level 0
  int32_t pixels;  // of the block, within the row
  int32_t num_disparities;

  // Levels of the eight pixels for left pixel x, in both halves of a word.
  __m512i levels(int32_t x) const {
    const __m512i behind = _mm512_setr_epi32(0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7);
    return _mm512_slli_epi32(_mm512_sub_epi32(_mm512_set1_epi32(x - left), behind), kLevelShift);
  }
  // Pixels that are candidates at such levels; one below 0 is a large number.
  __mmask8 candidates(__m512i levels) const {
    const __m512i end = _mm512_set1_epi64(static_cast<int64_t>(num_disparities) << (32 + kLevelShift));
    return _mm512_mask_cmplt_epu64_mask(static_cast<__mmask8>((1u << pixels) - 1), levels, end);
  }
};

// Eight right pixels: their descriptors and masks.
template <bool kMasked, int32_t kWords>
struct RightPixels {
  Block<kWords> words, masks;

  RightPixels(View right, int32_t pixels, ptrdiff_t bytes, __m512i* memory)
      : words(right.descriptors, pixels, bytes, memory),
        masks(kMasked ? right.masks : right.descriptors, pixels, bytes, memory + (kMasked ? whole_words(bytes) : 0)) {}
};

// Compares left pixels x .. x + kCount - 1 and returns the right pixels' least keys, `best` so far. A vector of keys holds
// the left view's in the lower halves of its words, the right view's in the upper. kWhole: all right pixels are candidates.
template <int32_t kCount, bool kWhole, bool kMasked, int32_t kWords>
BSM_INLINE __m512i compare_some(const RightPixels<kMasked, kWords>& right, View left, ptrdiff_t bytes,
                                const Meeting& meeting, int32_t x, __m512i& levels, __m512i* left_best, __m512i best) {
  const __m512i none = _mm512_set1_epi32(-1);
  left = left.from(x * bytes);
  __m512i left_costs[kCount], right_costs[kCount];
  BSM_UNROLL
  for (int32_t k = 0; k < kCount; ++k) left_costs[k] = right_costs[k] = _mm512_setzero_si512();
  Block<kWords>::for_each_word(bytes, [&](ptrdiff_t at) {
    const __m512i other = right.words.word(at);
    const __m512i other_mask = right.masks.word(at);
    BSM_UNROLL
    for (int32_t k = 0; k < kCount; ++k) {
      const __m512i own = every_word(left.descriptors + k * bytes + at);
      const __m512i own_mask = kMasked ? every_word(left.masks + k * bytes + at) : none;
      left_costs[k] = _mm512_add_epi64(left_costs[k], count(own, other, own_mask));
      if (kMasked) right_costs[k] = _mm512_add_epi64(right_costs[k], count(own, other, other_mask));
    }
  });
  BSM_UNROLL
  for (int32_t k = 0; k < kCount; ++k) {
    const __m512i right_cost = kMasked ? right_costs[k] : left_costs[k];
    __m512i keys = _mm512_ternarylogic_epi64(_mm512_slli_epi64(left_costs[k], 16), _mm512_slli_epi64(right_cost, 48), levels,
                                             0xfe);  // or
    if (!kWhole) keys = _mm512_mask_mov_epi64(none, meeting.candidates(levels), keys);
    _mm512_store_si512(left_best + x + k, _mm512_min_epu32(_mm512_load_si512(left_best + x + k), keys));
    best = _mm512_min_epu32(best, keys);
    levels = _mm512_add_epi32(levels, _mm512_set1_epi32(1 << kLevelShift));
  }
  return best;
}

// The same for left pixels begin .. end - 1.
template <bool kWhole, bool kMasked, int32_t kWords>
inline __m512i compare(RightPixels<kMasked, kWords> right, View left, ptrdiff_t bytes, Meeting meeting, int32_t begin,
                       int32_t end, __m512i* left_best, __m512i best) {
  constexpr int32_t kAtOnce = Block<kWords>::kAtOnce;
  if (kWords != 0) bytes = 8 * kWords;
  __m512i levels = meeting.levels(begin);
  int32_t x = begin;
  for (; x + kAtOnce <= end; x += kAtOnce) {
    best = compare_some<kAtOnce, kWhole>(right, left, bytes, meeting, x, levels, left_best, best);
  }
  if constexpr (kAtOnce > 1) {
    for (; x < end; ++x) best = compare_some<1, kWhole>(right, left, bytes, meeting, x, levels, left_best, best);
  }
  return best;
}

inline uint32_t least_lower_half(__m512i keys) {
  const __m256i half = _mm256_min_epu32(_mm512_castsi512_si256(keys), _mm512_extracti64x4_epi64(keys, 1));
  __m128i least = _mm_min_epu32(_mm256_castsi256_si128(half), _mm256_extracti128_si256(half, 1));
  least = _mm_min_epu32(least, _mm_shuffle_epi32(least, 0x4e));
  return static_cast<uint32_t>(_mm_cvtsi128_si32(least));
}

template <bool kMasked, int32_t kWords>
BSM_NOINLINE void match_row(const MatchHammingArgs& row) {
  const MatchHammingArgs args = row;  // a copy, which the levels written cannot change
  const ptrdiff_t bytes = args.bits / 8;
  __m512i* left_best = static_cast<__m512i*>(args.scratch);
  for (int32_t x = 0; x < args.width; ++x) _mm512_store_si512(left_best + x, _mm512_set1_epi32(-1));
  const View left{args.left, args.left_mask};
  const View right{args.right, args.right_mask};
  for (int32_t first = 0; first < args.width; first += kPixels) {
    const int32_t pixels = args.width - first < kPixels ? args.width - first : kPixels;
    const Meeting meeting{first + args.min_disparity, pixels, args.num_disparities};
    const Span span(args.width, meeting.left, args.num_disparities, pixels, kPixels);
    const RightPixels<kMasked, kWords> block(right.from(first * bytes), pixels, bytes, left_best + args.width);
    __m512i best = _mm512_set1_epi32(-1);
    best = compare<false>(block, left, bytes, meeting, span.begin, span.all_begin, left_best, best);
    best = compare<true>(block, left, bytes, meeting, span.all_begin, span.all_end, left_best, best);
    best = compare<false>(block, left, bytes, meeting, span.all_end, span.end, left_best, best);
    _mm_mask_storeu_epi16(args.right_level + first, static_cast<__mmask8>((1u << pixels) - 1),
                          _mm512_cvtepi64_epi16(_mm512_srli_epi64(best, 32)));
  }
  // A key's lower half is its level, and kNoLevel without candidates.
  for (int32_t x = 0; x < args.width; ++x) args.left_level[x] = static_cast<uint16_t>(least_lower_half(left_best[x]));
}

}  // namespace

uint64_t match_hamming_avx512_scratch(const KernelShape& shape) {
  return sizeof(__m512i) * (static_cast<uint64_t>(shape.width) + 2 * static_cast<uint64_t>(whole_words(shape.bits / 8)));
}

void match_hamming_avx512(const MatchHammingArgs& args) {
  if (args.left_mask == nullptr) return match_row<false, 0>(args);  // for studies: any length alike
  switch (args.bits / 64) {
    case 1:
      return match_row<true, 1>(args);
    case 2:
      return match_row<true, 2>(args);
    case 4:
      return match_row<true, 4>(args);
    default:
      return match_row<true, 0>(args);
  }
}

}  // namespace bsm
#endif
