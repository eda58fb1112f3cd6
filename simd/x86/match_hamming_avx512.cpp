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

// Descriptors and masks of neighbours in a row.
struct View {
  const uint8_t* descriptors;
  const uint8_t* masks;

  View from(ptrdiff_t bytes) const { return View{descriptors + bytes, masks == nullptr ? nullptr : masks + bytes}; }
};

// Sums of the lanes of a block against one left pixel, under the masks of each view.
struct Costs {
  __m512i left, right;
};

template <bool kMasked>
BSM_INLINE void add(Costs& costs, __m512i own, const uint8_t* own_mask, __m512i other, __m512i other_mask) {
  if (kMasked) {
    costs.left = _mm512_add_epi64(costs.left, count(own, other, every_word(own_mask)));
    costs.right = _mm512_add_epi64(costs.right, count(own, other, other_mask));
  } else {
    costs.left = costs.right = _mm512_add_epi64(costs.left, _mm512_popcnt_epi64(_mm512_xor_si512(own, other)));
  }
}

// A block of descriptors of kWords words, a power of two.
template <bool kMasked, int32_t kWords>
struct ShortBlock {
  static constexpr int32_t kAtOnce = 1;
  __m512i words[kWords], masks[kWords];

  ShortBlock(View right, ptrdiff_t, __m512i*) {
    split_eight<kWords>(right.descriptors, words);
    if (kMasked) split_eight<kWords>(right.masks, masks);
  }

  BSM_INLINE void compare(View left, ptrdiff_t, Costs (&costs)[1]) const {
    BSM_UNROLL
    for (int32_t i = 0; i < kWords; ++i) {
      add<kMasked>(costs[0], every_word(left.descriptors + 8 * i), left.masks + 8 * i, words[i], masks[i]);
    }
  }
};

// A block of descriptors of any length: words and masks by number in `memory`.
template <bool kMasked>
struct LongBlock {
  static constexpr int32_t kAtOnce = 4;
  const __m512i* words;
  const __m512i* masks;

  LongBlock(View right, ptrdiff_t bytes, __m512i* memory) : words(memory), masks(memory + whole_words(bytes)) {
    split_long(right.descriptors, bytes, memory);
    if (kMasked) split_long(right.masks, bytes, memory + whole_words(bytes));
  }

  template <int32_t kCount>
  BSM_INLINE void compare(View left, ptrdiff_t bytes, Costs (&costs)[kCount]) const {
    for (ptrdiff_t at = 0; at < bytes; at += 8) {
      const __m512i other = _mm512_load_si512(words + at / 8);
      const __m512i other_mask = _mm512_load_si512(masks + at / 8);
      BSM_UNROLL
      for (int32_t k = 0; k < kCount; ++k) {
        add<kMasked>(costs[k], every_word(left.descriptors + k * bytes + at), left.masks + k * bytes + at, other,
                     other_mask);
      }
    }
  }
};

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
  // Pixels that are candidates of left pixel x, which has one.
  __mmask8 candidates(int32_t x) const {
    const int32_t last = x - left < pixels - 1 ? x - left : pixels - 1;
    const int32_t before = x - left - num_disparities + 1;
    return static_cast<__mmask8>((2u << last) - (before > 0 ? 1u << before : 1u));
  }
};

// Compares left pixels x .. x + kCount - 1 and returns the block's least keys, `best` so far. A vector of keys holds the
// left view's in the lower halves of its words, the right view's in the upper. kWhole: all of the block's pixels are
// candidates.
template <int32_t kCount, bool kWhole, bool kMasked, class Block>
BSM_INLINE __m512i compare_some(const Block& block, View left, ptrdiff_t bytes, const Meeting& meeting, int32_t x,
                                __m512i& levels, __m512i* left_best, __m512i best) {
  const __m512i none = _mm512_set1_epi32(-1);
  Costs costs[kCount];
  BSM_UNROLL
  for (int32_t k = 0; k < kCount; ++k) costs[k].left = costs[k].right = _mm512_setzero_si512();
  block.compare(left.from(x * bytes), bytes, costs);
  BSM_UNROLL
  for (int32_t k = 0; k < kCount; ++k) {
    __m512i keys =
        _mm512_ternarylogic_epi64(_mm512_slli_epi64(costs[k].left, 16), _mm512_slli_epi64(costs[k].right, 48), levels,
                                  0xfe);  // or
    if (!kWhole) keys = _mm512_mask_mov_epi64(none, meeting.candidates(x + k), keys);
    _mm512_store_si512(left_best + x + k, _mm512_min_epu32(_mm512_load_si512(left_best + x + k), keys));
    best = _mm512_min_epu32(best, keys);
    levels = _mm512_add_epi32(levels, _mm512_set1_epi32(1 << kLevelShift));
  }
  return best;
}

// The same for left pixels begin .. end - 1.
template <bool kWhole, bool kMasked, class Block>
inline __m512i compare(Block block, View left, ptrdiff_t bytes, Meeting meeting, int32_t begin, int32_t end,
                       __m512i* left_best, __m512i best) {
  __m512i levels = meeting.levels(begin);
  int32_t x = begin;
  for (; x + Block::kAtOnce <= end; x += Block::kAtOnce) {
    best = compare_some<Block::kAtOnce, kWhole, kMasked>(block, left, bytes, meeting, x, levels, left_best, best);
  }
  if constexpr (Block::kAtOnce > 1) {
    for (; x < end; ++x) best = compare_some<1, kWhole, kMasked>(block, left, bytes, meeting, x, levels, left_best, best);
  }
  return best;
}

inline uint32_t least_lower_half(__m512i keys) {
  const __m256i half = _mm256_min_epu32(_mm512_castsi512_si256(keys), _mm512_extracti64x4_epi64(keys, 1));
  __m128i least = _mm_min_epu32(_mm256_castsi256_si128(half), _mm256_extracti128_si256(half, 1));
  least = _mm_min_epu32(least, _mm_shuffle_epi32(least, 0x4e));
  return static_cast<uint32_t>(_mm_cvtsi128_si32(least));
}

template <bool kMasked, class Block>
void match_row(const MatchHammingArgs& row) {
  const MatchHammingArgs args = row;  // a copy, which the levels written cannot change
  const ptrdiff_t bytes = args.bits / 8;
  __m512i* left_best = static_cast<__m512i*>(args.scratch);
  for (int32_t x = 0; x < args.width; ++x) _mm512_store_si512(left_best + x, _mm512_set1_epi32(-1));
  const View left{args.left, args.left_mask};
  const View right{args.right, args.right_mask};
  const auto within = [&](int32_t x) { return x < 0 ? 0 : x < args.width ? x : args.width; };
  for (int32_t first = 0; first < args.width; first += kPixels) {
    const int32_t pixels = args.width - first < kPixels ? args.width - first : kPixels;
    const Meeting meeting{first + args.min_disparity, pixels, args.num_disparities};
    // Left pixels begin .. end - 1 have candidates in the block, those from all_begin to all_end - 1 have eight.
    const int32_t begin = within(meeting.left);
    const int32_t end = within(meeting.left + args.num_disparities + pixels - 1);
    int32_t all_begin = within(meeting.left + kPixels - 1);
    int32_t all_end = within(meeting.left + args.num_disparities);
    if (pixels < kPixels || all_begin >= all_end) all_begin = all_end = end;
    const Block block(right.from(first * bytes), bytes, left_best + args.width);
    __m512i best = _mm512_set1_epi32(-1);
    best = compare<false, kMasked>(block, left, bytes, meeting, begin, all_begin, left_best, best);
    best = compare<true, kMasked>(block, left, bytes, meeting, all_begin, all_end, left_best, best);
    best = compare<false, kMasked>(block, left, bytes, meeting, all_end, end, left_best, best);
    _mm_mask_storeu_epi16(args.right_level + first, static_cast<__mmask8>((1u << pixels) - 1),
                          _mm512_cvtepi64_epi16(_mm512_srli_epi64(best, 32)));
  }
  // A key's lower half is its level, and kNoLevel without candidates.
  for (int32_t x = 0; x < args.width; ++x) args.left_level[x] = static_cast<uint16_t>(least_lower_half(left_best[x]));
}

template <bool kMasked>
void match(const MatchHammingArgs& args) {
  switch (args.bits / 64) {
    case 1:
      return match_row<kMasked, ShortBlock<kMasked, 1>>(args);
    case 2:
      return match_row<kMasked, ShortBlock<kMasked, 2>>(args);
    case 4:
      return match_row<kMasked, ShortBlock<kMasked, 4>>(args);
    case 8:
      return match_row<kMasked, ShortBlock<kMasked, 8>>(args);
    default:
      return match_row<kMasked, LongBlock<kMasked>>(args);
  }
}

}  // namespace

uint64_t match_hamming_avx512_scratch(const KernelShape& shape) {
  return sizeof(__m512i) * (static_cast<uint64_t>(shape.width) + 2 * static_cast<uint64_t>(whole_words(shape.bits / 8)));
}

void match_hamming_avx512(const MatchHammingArgs& args) {
  if (args.left_mask != nullptr) {
    match<true>(args);
  } else {
    match<false>(args);
  }
}

}  // namespace bsm
#endif
