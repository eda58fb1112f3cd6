// cost_hamming, AVX-512 F, BW, VL, VPOPCNTDQ: eight pixels of the other view against own pixels one after the other.
// The eight pixels' words lie apart by number, in registers or in the first-level cache, as in match_hamming: counts add up
// without a move between lanes, and no load crosses a cache line.
// Bound for eight candidates: by word of a descriptor 1 logic, 1 population count, 1 addition, the first of which is none;
// then 1 move of all sums to 16 bits in the order of levels. Two ports do them, one of which alone counts and moves: 6
// cycles for 256 bits, 3 for 128. A block meets D + 7 own pixels for D levels: 7 in D + 7 lanes are idle.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include <immintrin.h>

#include "simd/kernels.h"
#include "simd/x86/hamming_avx512.h"

namespace bsm {
namespace {

constexpr int32_t kPixels = 8;        // of a block: lanes
constexpr int32_t kCostsAtOnce = 32;  // of a register

// Where a block's costs belong: in order, those of own pixel x are levels base + step * x and the next seven.
struct Meeting {
  int32_t base, step;
  __mmask8 inside;  // which of them are of pixels within the row
  int32_t num_disparities;
  __m512i order;  // of the lanes, by their lowest 16 bits

  int32_t level(int32_t x) const { return base + step * x; }
  __m128i levels(int32_t x) const {
    return _mm_add_epi16(_mm_set1_epi16(static_cast<int16_t>(level(x))), _mm_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7));
  }
  // Which levels are candidates; one below 0 is a large number.
  __mmask8 candidates(__m128i levels) const {
    return _mm_mask_cmplt_epu16_mask(inside, levels, _mm_set1_epi16(static_cast<int16_t>(num_disparities)));
  }
};

// Of the block's pixels first .. first + pixels - 1, within the row.
inline Meeting meet(const CostHammingArgs& args, int32_t first, int32_t pixels) {
  const uint32_t inside = (1u << pixels) - 1;
  if (args.view == 0) {  // the last pixel has the lowest level
    return Meeting{-args.min_disparity - first - (kPixels - 1), 1, static_cast<__mmask8>(inside << (kPixels - pixels)),
                   args.num_disparities, _mm512_castsi128_si512(_mm_setr_epi16(28, 24, 20, 16, 12, 8, 4, 0))};
  }
  return Meeting{first - args.min_disparity, -1, static_cast<__mmask8>(inside), args.num_disparities,
                 _mm512_castsi128_si512(_mm_setr_epi16(0, 4, 8, 12, 16, 20, 24, 28))};
}

// Costs of kCount own pixels. kWhole: all lanes are candidates.
template <int32_t kCount, bool kWhole, bool kMasked, int32_t kWords>
BSM_INLINE void count_some(const Block<kWords>& block, View own, ptrdiff_t bytes, uint16_t* costs, ptrdiff_t step,
                           const Meeting& meeting, __m128i& levels) {
  __m512i sums[kCount];
  BSM_UNROLL
  for (int32_t k = 0; k < kCount; ++k) sums[k] = _mm512_setzero_si512();
  block.for_each_word(bytes, [&](ptrdiff_t at) {
    const __m512i other = block.word(at);
    BSM_UNROLL
    for (int32_t k = 0; k < kCount; ++k) {
      const __m512i mask = kMasked ? every_word(own.masks + k * bytes + at) : _mm512_set1_epi32(-1);
      sums[k] = _mm512_add_epi64(sums[k], count(every_word(own.descriptors + k * bytes + at), other, mask));
    }
  });
  BSM_UNROLL
  for (int32_t k = 0; k < kCount; ++k, costs += step) {
    const __m128i cost = _mm512_castsi512_si128(_mm512_permutexvar_epi16(meeting.order, sums[k]));
    if (kWhole) {
      _mm_storeu_si128(reinterpret_cast<__m128i*>(costs), cost);
    } else {
      _mm_mask_storeu_epi16(costs, meeting.candidates(levels), cost);
      levels = _mm_add_epi16(levels, _mm_set1_epi16(static_cast<int16_t>(meeting.step)));
    }
  }
}

// Own pixels begin .. end - 1.
template <bool kWhole, bool kMasked, int32_t kWords>
inline void count_pixels(Block<kWords> block, const CostHammingArgs& args, const Meeting& meeting, int32_t begin,
                         int32_t end) {
  constexpr int32_t kAtOnce = Block<kWords>::kAtOnce;
  const ptrdiff_t bytes = kWords == 0 ? args.bits / 8 : 8 * kWords;
  const ptrdiff_t step = args.stride + meeting.step;
  View own = View{args.own, args.own_mask}.from(begin * bytes);
  uint16_t* costs = args.cost + ptrdiff_t{begin} * args.stride + meeting.level(begin);
  __m128i levels = meeting.levels(begin);
  int32_t x = begin;
  for (; x + kAtOnce <= end; x += kAtOnce, own = own.from(kAtOnce * bytes), costs += kAtOnce * step) {
    count_some<kAtOnce, kWhole, kMasked>(block, own, bytes, costs, step, meeting, levels);
  }
  if constexpr (kAtOnce > 1) {
    for (; x < end; ++x, own = own.from(bytes), costs += step) {
      count_some<1, kWhole, kMasked>(block, own, bytes, costs, step, meeting, levels);
    }
  }
}

// Sets costs of pixel x to none where no block writes them, and more.
BSM_NOINLINE void clear_all(uint16_t* costs, int32_t begin, int32_t end) {
  for (int32_t level = begin; level < end; level += kCostsAtOnce) _mm512_storeu_si512(costs + level, _mm512_set1_epi32(-1));
}
inline void clear(const CostHammingArgs& args, int32_t x) {
  uint16_t* costs = args.cost + ptrdiff_t{x} * args.stride;
  const int32_t least = args.view == 0 ? x - args.min_disparity - args.num_disparities + 1 : x + args.min_disparity;
  if (least < 0 || least + args.num_disparities > args.width) {
    clear_all(costs, 0, args.stride);
  } else if (args.num_disparities < args.stride - kCostsAtOnce) {
    clear_all(costs, args.num_disparities / kCostsAtOnce * kCostsAtOnce, args.stride);
  } else {
    _mm512_storeu_si512(costs + args.stride - kCostsAtOnce, _mm512_set1_epi32(-1));
  }
}

template <bool kMasked, int32_t kWords>
BSM_NOINLINE void count_row(const CostHammingArgs& row) {
  const CostHammingArgs args = row;  // a copy, which the costs written cannot change
  const ptrdiff_t bytes = args.bits / 8;
  int32_t cleared = 0;
  for (int32_t first = 0; first < args.width; first += kPixels) {
    const int32_t pixels = args.width - first < kPixels ? args.width - first : kPixels;
    const Block<kWords> block(args.other + first * bytes, pixels, bytes, static_cast<__m512i*>(args.scratch));
    const Meeting meeting = meet(args, first, pixels);
    const int32_t least = meeting.step > 0 ? -meeting.base - (kPixels - 1) : meeting.base - args.num_disparities + 1;
    const Span span(args.width, least, args.num_disparities, pixels, kPixels);
    for (; cleared < span.end; ++cleared) clear(args, cleared);
    count_pixels<false, kMasked>(block, args, meeting, span.begin, span.all_begin);
    count_pixels<true, kMasked>(block, args, meeting, span.all_begin, span.all_end);
    count_pixels<false, kMasked>(block, args, meeting, span.all_end, span.end);
  }
  for (; cleared < args.width; ++cleared) clear(args, cleared);
}

}  // namespace

uint64_t cost_hamming_avx512_scratch(const KernelShape& shape) {
  return sizeof(__m512i) * static_cast<uint64_t>(whole_words(shape.bits / 8));
}

void cost_hamming_avx512(const CostHammingArgs& args) {
  if (args.own_mask == nullptr) return count_row<false, 0>(args);  // for studies: any length alike
  switch (args.bits / 64) {
    case 1:
      return count_row<true, 1>(args);
    case 2:
      return count_row<true, 2>(args);
    case 4:
      return count_row<true, 4>(args);
    default:
      return count_row<true, 0>(args);
  }
}

}  // namespace bsm
#endif
