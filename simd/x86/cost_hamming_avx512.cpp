// cost_hamming, AVX-512 F, BW, VL, VPOPCNTDQ: an own pixel against blocks of eight neighbours of the other view.
// The other view's row is split once into blocks whose words lie apart by number: counts add up without a move between
// lanes. An own pixel's words, each in all lanes, stay in registers while the blocks of its candidates pass; those above 512
// bits meet four blocks at once. The levels, rounded up to eight, begin and end within blocks. The two ends together are
// eight pixels: every block's words stand beside those of the block at the other end, so that one load takes both ends and
// no lane is idle. It is the only load of the row that crosses cache lines.
// Bound for eight candidates: by word of a descriptor 1 logic, 1 population count, 1 addition, the first of which is none;
// then 1 move of all sums to 16 bits in the order of levels. Two ports do them, one of which alone counts and moves: 6
// cycles for 256 bits, 3 for 128, 12 for 512. Beside them stand 2 loads a word of an own pixel, and 2 or 3 moves and 2
// stores a word of a block, which as many own pixels meet as there are levels.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include <immintrin.h>

#include "simd/kernels.h"
#include "simd/x86/cost_hamming_words.h"
#include "simd/x86/hamming_avx512.h"

namespace bsm {
namespace {

constexpr int32_t kRegisterWords = 8;  // of an own pixel's descriptor, and as many of its mask
constexpr int32_t kCostsAtOnce = 32;   // of a register

// An own pixel's words in all lanes; kWords == 0: any number, in memory.
template <bool kMasked, int32_t kWords>
struct OwnPixel {
  __m512i bits[kWords], masks[kWords];

  explicit OwnPixel(View own) {
    BSM_UNROLL
    for (int32_t i = 0; i < kWords; ++i) {
      bits[i] = every_word(own.descriptors + 8 * i);
      masks[i] = kMasked ? every_word(own.masks + 8 * i) : _mm512_set1_epi32(-1);
    }
  }
  __m512i bit_word(ptrdiff_t i) const { return bits[i]; }
  __m512i mask_word(ptrdiff_t i) const { return masks[i]; }
};
template <bool kMasked>
struct OwnPixel<kMasked, 0> {
  View own;

  explicit OwnPixel(View pixel) : own(pixel) {}
  __m512i bit_word(ptrdiff_t i) const { return every_word(own.descriptors + 8 * i); }
  __m512i mask_word(ptrdiff_t i) const { return kMasked ? every_word_once(own.masks + 8 * i) : _mm512_set1_epi32(-1); }
};

// The other view's row: each block's words beside those of the block where an own pixel's levels end that begin in this one,
// the two in the order of the row, word by word.
struct Pairs {
  __m512i* memory;
  ptrdiff_t words;  // of a descriptor
  int32_t blocks;   // of the row
  int32_t levels;   // in blocks
  bool descending;  // levels rise to the left

  Pairs(const CostHammingArgs& args, ptrdiff_t words_)
      : memory(static_cast<__m512i*>(args.scratch)),
        words(words_),
        blocks(block_count(args.width)),
        levels(block_count(args.num_disparities)),
        descending(args.view == 0) {}

  // Whether there is a pair whose lower levels are those of a block, within the row or not.
  bool has(int32_t block) const {
    return descending ? 0 <= block && block < blocks + levels : -levels <= block && block < blocks;
  }
  __m512i* pair(int32_t block) const { return memory + ptrdiff_t{descending ? block : block + levels} * 2 * words; }
  // A block's first word, and that beside another block; the next follow by twos.
  __m512i* block(int32_t block) const { return pair(block) + (descending ? 1 : 0); }
  __m512i* beside(int32_t block) const { return descending ? pair(block + levels) : pair(block - levels) + 1; }
  // From a block to the one with the next levels.
  ptrdiff_t step() const { return descending ? -2 * words : 2 * words; }
};

// Splits blocks begin .. end - 1, as many as the row has, and returns the next one.
template <int32_t kWords>
inline int32_t split_row(const CostHammingArgs& args, const Pairs& pairs, int32_t begin, int32_t end) {
  const ptrdiff_t bytes = args.bits / 8;
  for (; begin < end && begin < pairs.blocks; ++begin) {
    const int32_t first = begin * kPixels;
    __m512i* const block = pairs.block(begin);
    __m512i* const beside = pairs.beside(begin);
    split_block<kWords>(args.other + first * bytes, args.width - first, bytes, [&](ptrdiff_t number, __m512i lanes) {
      _mm512_store_si512(block + 2 * number, lanes);
      _mm512_store_si512(beside + 2 * number, lanes);
    });
  }
  return begin;
}

// Where the costs of a pixel go.
struct Costs {
  uint16_t* whole;       // of the next whole block
  uint16_t *low, *high;  // of the first eight levels and of the last eight
};

inline void store_eight(uint16_t* costs, __m128i eight) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(costs), eight);
}

// Counts kBlocks whole blocks, `step` registers apart, and with kEnds the eight pixels at `ends`, which are of the first
// levels and of the last. Whole blocks come later than the ends, as they write over those levels that are not the ends'.
template <int32_t kBlocks, bool kEnds, bool kMasked, int32_t kWords>
BSM_INLINE void count_blocks(const OwnPixel<kMasked, kWords>& own, const __m512i* block, ptrdiff_t step,
                             const uint64_t* ends, ptrdiff_t words, __m512i order, Costs costs) {
  __m512i sums[kBlocks + kEnds];
  BSM_UNROLL
  for (int32_t k = 0; k < kBlocks + kEnds; ++k) sums[k] = _mm512_setzero_si512();
  const auto add = [&](ptrdiff_t i) {
    const __m512i bits = own.bit_word(i);
    const __m512i mask = own.mask_word(i);
    BSM_UNROLL
    for (int32_t k = 0; k < kBlocks + kEnds; ++k) {
      const __m512i other =
          k < kBlocks ? _mm512_load_si512(block + k * step + 2 * i) : _mm512_loadu_si512(ends + 2 * kPixels * i);
      sums[k] = _mm512_add_epi64(sums[k], count(other, bits, mask));
    }
  };
  if constexpr (kWords != 0) {
    BSM_UNROLL
    for (int32_t i = 0; i < kWords; ++i) add(i);
  } else {
    for (ptrdiff_t i = 0; i < words; ++i) add(i);
  }
  BSM_UNROLL
  for (int32_t k = kBlocks + kEnds - 1; k >= 0; --k) {
    const __m128i eight = _mm512_castsi512_si128(_mm512_permutexvar_epi16(order, sums[k]));
    if (k < kBlocks) {
      store_eight(costs.whole + kPixels * k, eight);
    } else {
      store_eight(costs.low, eight);
      store_eight(costs.high, eight);
    }
  }
}

// Sets costs begin .. end - 1 to none.
inline void clear(uint16_t* costs, int32_t begin, int32_t end) {
  for (int32_t level = begin; level < end; level += kCostsAtOnce) {
    const int32_t left = end - level;
    const __mmask32 some = left < kCostsAtOnce ? (1u << left) - 1 : ~0u;
    _mm512_mask_storeu_epi16(costs + level, some, _mm512_set1_epi32(-1));
  }
}

// The same from `begin` up to a multiple of eight, by stores that need no mask.
inline void clear_eighth(uint16_t* costs, int32_t begin) {
  const uint64_t none = ~uint64_t{0};
  if ((begin & 1) != 0) BSM_MEMCPY(costs + begin, &none, 2);
  begin += begin & 1;
  if ((begin & 2) != 0) BSM_MEMCPY(costs + begin, &none, 4);
  begin += begin & 2;
  if ((begin & 4) != 0) BSM_MEMCPY(costs + begin, &none, 8);
}

// Sets the costs where pixel x has no candidates to none.
BSM_NOINLINE void clear_others(const CostHammingArgs& args, int32_t x) {
  uint16_t* costs = args.cost + ptrdiff_t{x} * args.stride;
  const LevelRange levels = candidate_levels(args, x);
  const bool none = levels.first > levels.last;
  clear(costs, 0, none ? args.stride : levels.first);
  clear(costs, none ? args.stride : levels.last + 1, args.stride);
}

inline bool all_candidates(const CostHammingArgs& args, int32_t x) {
  const LevelRange levels = candidate_levels(args, x);
  return levels.first == 0 && levels.last == args.num_disparities - 1;
}

// Own pixels begin .. end - 1, whose levels begin in one block, those of the first at `lane`.
template <bool kMasked, int32_t kWords>
inline void count_run(const CostHammingArgs& args, const Pairs& pairs, int32_t block, int32_t lane, int32_t begin,
                      int32_t end, __m512i order) {
  constexpr int32_t kAtOnce = kWords == 0 ? 4 : 1;
  const ptrdiff_t words = kWords == 0 ? pairs.words : kWords;
  const ptrdiff_t step = pairs.step();
  // Whole blocks, in the order of levels: those of the row between this one and the one that it is paired with.
  const int32_t rest = pairs.descending ? block : pairs.blocks - 1 - block;
  const int32_t near = rest < pairs.blocks ? 1 : rest - pairs.blocks + 1;
  const int32_t blocks = (rest < pairs.levels ? rest : pairs.levels - 1) - near + 1;
  const __m512i* const nearest = pairs.block(block) + near * step;
  const uint64_t* ends = reinterpret_cast<const uint64_t*>(pairs.pair(block)) + lane + (pairs.descending ? 1 : 0);
  View own = View{args.own, args.own_mask}.from(ptrdiff_t{begin} * (args.bits / 8));
  uint16_t* costs = args.cost + ptrdiff_t{begin} * args.stride;
  uint16_t* whole = costs + kPixels * near - (pairs.descending ? kPixels - 1 - lane : lane);
  const ptrdiff_t next = args.stride + (pairs.descending ? 1 : -1);
  BSM_KEEP_LOOP
  for (int32_t x = begin; x < end; ++x) {
    const OwnPixel<kMasked, kWords> pixel(own);
    const __m512i* from = nearest;
    Costs to{whole, costs, costs + kPixels * (pairs.levels - 1)};
    int32_t left = blocks;
    const auto advance = [&](int32_t count) {
      from += count * step;
      to.whole += kPixels * count;
      left -= count;
    };
    if (left >= kAtOnce - 1) {
      count_blocks<kAtOnce - 1, true>(pixel, from, step, ends, words, order, to);
      advance(kAtOnce - 1);
    } else {
      count_blocks<0, true>(pixel, from, step, ends, words, order, to);
    }
    while (left >= kAtOnce) {
      count_blocks<kAtOnce, false>(pixel, from, step, ends, words, order, to);
      advance(kAtOnce);
    }
    while (kAtOnce > 1 && left > 0) {
      count_blocks<1, false>(pixel, from, step, ends, words, order, to);
      advance(1);
    }
    clear_eighth(costs, args.num_disparities);
    own = own.from(args.bits / 8);
    costs += args.stride;
    whole += next;
    ++ends;
  }
}

template <bool kMasked, int32_t kWords>
BSM_NOINLINE void count_row(const CostHammingArgs& row) {
  const CostHammingArgs args = row;  // a copy, which the costs written cannot change
  const Pairs pairs(args, kWords == 0 ? args.bits / 64 : kWords);
  const __m128i ascending = _mm_setr_epi16(0, 4, 8, 12, 16, 20, 24, 28);
  const __m128i descending = _mm_setr_epi16(28, 24, 20, 16, 12, 8, 4, 0);
  const __m512i order = _mm512_castsi128_si512(pairs.descending ? descending : ascending);
  int32_t split = 0;
  for (int32_t begin = 0, end = 0; begin < args.width; begin = end) {
    const int32_t lowest = pairs.descending ? begin - args.min_disparity : begin + args.min_disparity;
    const int32_t lane = lowest & (kPixels - 1);
    const int32_t block = (lowest - lane) / kPixels;
    end = begin + kPixels - lane < args.width ? begin + kPixels - lane : args.width;
    // One block ahead, whose words are in the cache when they are loaded from two places at once.
    split = split_row<kWords>(args, pairs, split, block + (pairs.descending ? 0 : pairs.levels) + 2);
    if (pairs.has(block)) count_run<kMasked, kWords>(args, pairs, block, lane, begin, end, order);
    if (all_candidates(args, begin) && all_candidates(args, end - 1)) {
      for (int32_t x = begin; x < end && pairs.levels * kPixels < args.stride; ++x)
        clear(args.cost + ptrdiff_t{x} * args.stride, pairs.levels * kPixels, args.stride);
    } else {
      for (int32_t x = begin; x < end; ++x) clear_others(args, x);
    }
  }
}

}  // namespace

uint64_t cost_hamming_avx512_scratch(const KernelShape& shape) {
  const int32_t pairs = block_count(shape.width) + block_count(shape.num_disparities);
  return 2 * sizeof(__m512i) * static_cast<uint64_t>(pairs) * static_cast<uint64_t>(shape.bits / 64);
}

void cost_hamming_avx512(const CostHammingArgs& args) {
  if (args.own_mask == nullptr) return count_row<false, 0>(args);  // for studies: any length alike
  with_words<kRegisterWords>(args.bits / 64, [&](auto words) { count_row<true, decltype(words)::kCount>(args); });
}

}  // namespace bsm
#endif
