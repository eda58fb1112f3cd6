// match_hamming, AVX-512 F, BW, VL, VPOPCNTDQ: eight right pixels against left pixels one after the other, both views.
// The right pixels' words lie apart by number, a lane for each pixel: in registers, or in the first-level cache for long
// descriptors, which then meet four left pixels at once. A left pixel's word goes to all lanes as it is loaded, so that
// counts add up without a move between lanes and no load crosses a cache line. The XOR of a candidate never leaves the
// register: one three-operand operation XORs and masks for each view. A winner is the least of cost and level in one 32-bit
// word, so that ties need no order. The first seven left pixels that meet a block meet some of its lanes, and in the others
// the last lanes of the block D pixels before: the two blocks' words mix as they are loaded, no lane is idle. Where D is no
// multiple of eight, nor a little less, blocks do not mix and meet D + 7 left pixels for D levels.
// Bound for eight candidates: by word of a descriptor 2 logic, 2 population counts, 2 additions, the first 2 of which are
// none; then 3 to make keys of both views, 2 minima, 1 for the next levels. Two ports do them, one of which alone counts: 14
// cycles for 256 bits and 194 for 4096, 1.8 and 24.3 a candidate. Carry-save additions before the counts would gain nothing,
// as each takes two operations and saves two.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include <immintrin.h>

#include "simd/kernels.h"
#include "simd/x86/hamming_avx512.h"

namespace bsm {
namespace {

constexpr int32_t kRegisterWords = 4;  // of a block's descriptors, and as many of its masks

// Eight right pixels: their descriptors and masks, in registers or in memory.
template <bool kMasked, int32_t kWords>
struct RightPixels {
  Block<kWords> words, masks;

  RightPixels(View right, int32_t pixels, ptrdiff_t bytes, __m512i* memory)
      : words(right.descriptors, pixels, bytes, memory),
        masks(kMasked ? right.masks : right.descriptors, pixels, bytes, kMasked ? memory + bytes / 8 : memory) {}
  __m512i word(ptrdiff_t at) const { return words.word(at); }
  __m512i mask(ptrdiff_t at) const { return masks.word(at); }
  // Leaves those of registers in memory, too.
  void keep(__m512i* memory) const {
    BSM_UNROLL
    for (int32_t i = 0; i < kWords; ++i) {
      _mm512_store_si512(memory + i, word(8 * i));
      _mm512_store_si512(memory + kWords + i, mask(8 * i));
    }
  }
};

// Lanes of one block, and `early` lanes of another in memory.
template <bool kMasked, int32_t kWords>
struct MixedPixels {
  const RightPixels<kMasked, kWords>& late;
  const __m512i *words, *masks;
  __mmask8 early;

  __m512i word(ptrdiff_t at) const { return _mm512_mask_load_epi64(late.word(at), early, words + at / 8); }
  __m512i mask(ptrdiff_t at) const { return _mm512_mask_load_epi64(late.mask(at), early, masks + at / 8); }
};

// A row of both views and its winners so far.
struct Row {
  MatchHammingArgs args;
  ptrdiff_t bytes;     // of a descriptor
  int32_t apart;       // pixels from a block to the one that it mixes with, beyond the row when none does
  int32_t slots;       // for right blocks that are not finished
  __m512i* left_best;  // keys by pixel
  __m512i* memory;     // slots: keys, words, masks

  // The levels, rounded up to blocks; when that adds more idle lanes than mixing saves, no blocks mix.
  static int32_t pixels_apart(int32_t width, int32_t num_disparities) {
    const int32_t levels = block_count(num_disparities) * kPixels;
    return levels - num_disparities < kPixels / 2 && levels < width ? levels : width;
  }
  static int32_t slots_of(int32_t width, int32_t apart) { return apart < width ? apart / kPixels + 1 : 1; }
  static ptrdiff_t slot_registers(int32_t bits) { return 1 + 2 * (bits / 64); }

  explicit Row(const MatchHammingArgs& row)
      : args(row),
        bytes(row.bits / 8),
        apart(pixels_apart(row.width, row.num_disparities)),
        slots(slots_of(row.width, apart)),
        left_best(static_cast<__m512i*>(row.scratch)),
        memory(left_best + row.width) {}

  View left(int32_t x) const { return View{args.left, args.left_mask}.from(x * bytes); }
  View right(int32_t x) const { return View{args.right, args.right_mask}.from(x * bytes); }
  __m512i* slot(int32_t number) const { return memory + number * slot_registers(args.bits); }
  // Lanes of the block that begins with a pixel of the row.
  __mmask8 pixels(int32_t first) const { return first_words(args.width - first); }
  int32_t within(int32_t x) const { return x < 0 ? 0 : x < args.width ? x : args.width; }
  void finish(int32_t first, __m512i keys) const {
    _mm_mask_storeu_epi16(args.right_level + first, pixels(first), _mm512_cvtepi64_epi16(_mm512_srli_epi64(keys, 32)));
  }
};

// Levels of a block's pixels for a left pixel that meets the first of them at `level`, in both halves of a word.
inline __m512i levels_from(int32_t level) {
  const __m512i behind = _mm512_setr_epi32(0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7);
  return _mm512_slli_epi32(_mm512_sub_epi32(_mm512_set1_epi32(level), behind), kLevelShift);
}
inline __m512i next(__m512i levels) {
  return _mm512_add_epi32(levels, _mm512_set1_epi32(1 << kLevelShift));
}

// Keys of kCount left pixels; `levels`, those of the first, move on to the pixel behind. A vector of keys holds the left
// view's in the lower halves of its words, the right view's in the upper. kWhole: all lanes are candidates, else some of
// `pixels`, and the others' keys none.
template <int32_t kCount, bool kWhole, bool kMasked, int32_t kWords, class Pixels>
BSM_INLINE void compare_some(const Row& row, const Pixels& right, View left, __mmask8 pixels, __m512i& levels,
                             __m512i (&keys)[kCount]) {
  const ptrdiff_t bytes = kWords != 0 ? 8 * kWords : row.bytes;
  __m512i left_costs[kCount], right_costs[kCount];
  BSM_UNROLL
  for (int32_t k = 0; k < kCount; ++k) left_costs[k] = right_costs[k] = _mm512_setzero_si512();
  Block<kWords>::for_each_word(bytes, [&](ptrdiff_t at) {
    const __m512i other = right.word(at);
    const __m512i other_mask = right.mask(at);
    BSM_UNROLL
    for (int32_t k = 0; k < kCount; ++k) {
      const __m512i own = every_word(left.descriptors + k * bytes + at);
      const __m512i own_mask = kMasked ? every_word(left.masks + k * bytes + at) : _mm512_set1_epi32(-1);
      left_costs[k] = _mm512_add_epi64(left_costs[k], count(own, other, own_mask));
      if (kMasked) right_costs[k] = _mm512_add_epi64(right_costs[k], count(own, other, other_mask));
    }
  });
  BSM_UNROLL
  for (int32_t k = 0; k < kCount; ++k) {
    const __m512i right_cost = kMasked ? right_costs[k] : left_costs[k];
    keys[k] = _mm512_ternarylogic_epi64(_mm512_slli_epi64(left_costs[k], 16), _mm512_slli_epi64(right_cost, 48), levels,
                                        0xfe);  // or
    if (!kWhole) {                              // a level below 0 is a large number
      const __m512i end = _mm512_set1_epi64(static_cast<int64_t>(row.args.num_disparities) << (32 + kLevelShift));
      const __mmask8 candidates = _mm512_mask_cmplt_epu64_mask(pixels, levels, end);
      keys[k] = _mm512_mask_mov_epi64(_mm512_set1_epi32(-1), candidates, keys[k]);
    }
    levels = next(levels);
  }
}

inline void enter_left(__m512i* best, __m512i keys) {
  _mm512_store_si512(best, _mm512_min_epu32(_mm512_load_si512(best), keys));
}

// Left pixels begin .. end - 1 against a block, the first of them at `level`. Returns the right pixels' least keys, `best`
// so far.
template <bool kWhole, bool kMasked, int32_t kWords>
inline __m512i compare(const Row& row, RightPixels<kMasked, kWords> right, __mmask8 pixels, int32_t level, int32_t begin,
                       int32_t end, __m512i best) {
  constexpr int32_t kAtOnce = Block<kWords>::kAtOnce;
  const ptrdiff_t bytes = kWords != 0 ? 8 * kWords : row.bytes;
  __m512i levels = levels_from(level);
  View left = row.left(begin);
  __m512i* left_best = row.left_best + begin;
  const auto some = [&](auto& keys) {
    constexpr int32_t kCount = sizeof keys / sizeof keys[0];
    compare_some<kCount, kWhole, kMasked, kWords>(row, right, left, pixels, levels, keys);
    BSM_UNROLL
    for (int32_t k = 0; k < kCount; ++k) {
      enter_left(left_best + k, keys[k]);
      best = _mm512_min_epu32(best, keys[k]);
    }
    left = left.from(kCount * bytes);
    left_best += kCount;
  };
  int32_t count = end - begin;
  for (; count >= kAtOnce; count -= kAtOnce) {
    __m512i keys[kAtOnce];
    some(keys);
  }
  if constexpr (kAtOnce > 1) {
    for (; count > 0; --count) {
      __m512i keys[1];
      some(keys);
    }
  }
  return best;
}

// The same for left pixels of which the one at level n meets n + 1 lanes of the block, and in the other lanes the one in
// slot `early`, which ends there.
template <bool kWhole, bool kMasked, int32_t kWords>
inline __m512i compare_mixed(const Row& row, RightPixels<kMasked, kWords> right, __mmask8 pixels, int32_t level,
                             int32_t begin, int32_t end, __m512i* early) {
  const ptrdiff_t bytes = kWords != 0 ? 8 * kWords : row.bytes;
  __m512i levels = levels_from(level);
  View left = row.left(begin);
  __m512i best = _mm512_set1_epi32(-1), early_best = _mm512_load_si512(early);
  for (int32_t x = begin; x < end; ++x, ++level, left = left.from(bytes)) {
    const __mmask8 others = static_cast<__mmask8>(0xfe << level);
    const __mmask16 halves = static_cast<__mmask16>(0xfffc << 2 * level);  // of words, the same
    const MixedPixels<kMasked, kWords> mixed{right, early + 1, early + 1 + bytes / 8, others};
    __m512i both = _mm512_mask_add_epi32(levels, halves, levels, _mm512_set1_epi32(row.apart << kLevelShift));
    __m512i keys[1];
    compare_some<1, kWhole, kMasked, kWords>(row, mixed, left, static_cast<__mmask8>(pixels | others), both, keys);
    enter_left(row.left_best + x, keys[0]);
    best = _mm512_mask_min_epu32(best, static_cast<__mmask16>(~halves), best, keys[0]);
    early_best = _mm512_mask_min_epu32(early_best, halves, early_best, keys[0]);
    levels = next(levels);
  }
  _mm512_store_si512(early, early_best);
  return best;
}

inline uint32_t least_lower_half(__m512i keys) {
  const __m256i half = _mm256_min_epu32(_mm512_castsi512_si256(keys), _mm512_extracti64x4_epi64(keys, 1));
  __m128i least = _mm_min_epu32(_mm256_castsi256_si128(half), _mm256_extracti128_si256(half, 1));
  least = _mm_min_epu32(least, _mm_shuffle_epi32(least, 0x4e));
  return static_cast<uint32_t>(_mm_cvtsi128_si32(least));
}

template <bool kMasked, int32_t kWords>
BSM_NOINLINE void match_row(const MatchHammingArgs& args) {
  const Row row(args);  // with a copy of them, which the levels written cannot change
  const int32_t width = row.args.width, num_disparities = row.args.num_disparities;
  for (int32_t x = 0; x < width; ++x) _mm512_store_si512(row.left_best + x, _mm512_set1_epi32(-1));
  int32_t number = 0;  // of the slot
  for (int32_t first = 0; first < width; first += kPixels) {
    const __mmask8 pixels = row.pixels(first);
    __m512i* const slot = row.slot(number);
    number = number + 1 == row.slots ? 0 : number + 1;
    const RightPixels<kMasked, kWords> block(row.right(first), width - first, row.bytes, slot + 1);
    if (row.slots > 1) block.keep(slot + 1);
    __m512i best = _mm512_set1_epi32(-1);
    const int32_t zero = first + row.args.min_disparity;  // the left pixel that meets the first lane at level 0
    int32_t x = row.within(zero);
    const auto some = [&](int32_t end) {  // of the lanes
      best = compare<false>(row, block, pixels, x - zero, x, end, best);
      x = end;
    };
    const int32_t all = row.within(zero + kPixels - 1);
    if (first < row.apart) {
      some(all);
    } else {
      __m512i* const early = row.slot(number);
      const bool whole = pixels == 0xff && num_disparities == row.apart;
      best = whole ? compare_mixed<true>(row, block, pixels, x - zero, x, all, early)
                   : compare_mixed<false>(row, block, pixels, x - zero, x, all, early);
      row.finish(first - row.apart, _mm512_load_si512(early));
      x = all;
    }
    if (pixels == 0xff && num_disparities >= kPixels) {
      const int32_t end = row.within(zero + num_disparities);
      best = compare<true>(row, block, pixels, x - zero, x, end, best);
      x = end;
    }
    const bool mixes = first + row.apart < width;  // with a block to come
    some(row.within(mixes ? zero + row.apart : zero + num_disparities + kPixels - 1));
    if (mixes) {
      _mm512_store_si512(slot, best);
    } else {
      row.finish(first, best);
    }
  }
  // A key's lower half is its level, and kNoLevel without candidates.
  for (int32_t x = 0; x < width; ++x) row.args.left_level[x] = static_cast<uint16_t>(least_lower_half(row.left_best[x]));
}

}  // namespace

uint64_t match_hamming_avx512_scratch(const KernelShape& shape) {
  const int32_t apart = Row::pixels_apart(shape.width, shape.num_disparities);
  const ptrdiff_t slots = Row::slots_of(shape.width, apart);
  return sizeof(__m512i) * static_cast<uint64_t>(shape.width + slots * Row::slot_registers(shape.bits));
}

void match_hamming_avx512(const MatchHammingArgs& args) {
  if (args.left_mask == nullptr) return match_row<false, 0>(args);  // for studies: any length alike
  with_words<kRegisterWords>(args.bits / 64, [&](auto words) { match_row<true, decltype(words)::kCount>(args); });
}

}  // namespace bsm
#endif
