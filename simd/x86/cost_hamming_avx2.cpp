// cost_hamming, AVX2, POPCNT: descriptors of 64, 128 and 256 bits take 16 candidates at once, neighbours in the other view's
// row, and go by 64-bit words at the ends of the row. Set bits are looked up by half bytes. Bound, per 256 bits of
// candidates: 1 load, 9 operations; to add up 16 candidates 5 for 64 bits, 13 for 128, 21 for 256.
// Other lengths take four pixels of the other view against own pixels one after the other, as in match_hamming. Bound for
// four candidates: by word 9, the first addition of which is none, once 1 to sum bytes; above 256 bits by four words 8, 3
// carry-save additions of 5, a count of 6, an addition, once 18; and 3 to 16 bits. Three ports do them: 10 cycles for 192
// bits, 27 for 512.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/levels_avx2.h"

#include "simd/x86/cost_hamming_words.h"
#include "simd/x86/hamming_avx2.h"

namespace bsm {
namespace {

constexpr int32_t kAtOnce = 16;  // candidates

// A pixel whose costs are counted, repeated over a register.
struct Own {
  Bytes bits, mask;
};

template <int32_t kWords>
inline Bytes repeat(const uint8_t* from) {
  return kWords == 1 ? every_word(from) : kWords == 2 ? table16(from) : load(from);
}

// Set bits of each 64-bit word of a register of candidates that differ under the mask.
inline Bytes count_register(const Own& own, const uint8_t* other) {
  const Bytes counts = table16(reinterpret_cast<const uint8_t*>("\0\1\1\2\1\2\2\3\1\2\2\3\2\3\3\4"));
  const Bytes low_half = set8(15);
  const Bytes differing = both(differ(load(other), own.bits), own.mask);
  const Bytes low = look_up(counts, both(differing, low_half));
  const Bytes high = look_up(counts, both(right16<4>(differing), low_half));
  return _mm256_sad_epu8(add8(low, high), zero());
}

// Eight registers of counts to one: lane l holds the sums of words 2 l and 2 l + 1 of each.
inline Bytes count_eight(const Own& own, const uint8_t* other) {
  Bytes pairs[4];
  BSM_UNROLL
  for (int32_t i = 0; i < 4; ++i) {
    pairs[i] = _mm256_packus_epi32(count_register(own, other + 64 * i), count_register(own, other + 64 * i + 32));
  }
  const Bytes bytes = _mm256_packus_epi16(_mm256_packus_epi32(pairs[0], pairs[1]), _mm256_packus_epi32(pairs[2], pairs[3]));
  return _mm256_maddubs_epi16(bytes, set8(1));
}

// Costs of 16 candidates in the order of memory.
template <int32_t kWords>
inline Bytes count_sixteen(const Own& own, const uint8_t* other) {
  if constexpr (kWords == 1) {  // four neighbours a register, two in each lane
    const Bytes first = _mm256_packus_epi32(count_register(own, other), count_register(own, other + 32));
    const Bytes second = _mm256_packus_epi32(count_register(own, other + 64), count_register(own, other + 96));
    return _mm256_permutevar8x32_epi32(_mm256_packus_epi32(first, second), _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7));
  }
  const Bytes a = count_eight(own, other);
  if (kWords == 2) {  // even candidates in one lane, odd ones in the other
    const __m128i even = _mm256_castsi256_si128(a);
    const __m128i odd = _mm256_extracti128_si256(a, 1);
    return _mm256_set_m128i(_mm_unpackhi_epi16(even, odd), _mm_unpacklo_epi16(even, odd));
  }
  const Bytes b = count_eight(own, other + 256);
  return add16(_mm256_permute2x128_si256(a, b, 0x20), _mm256_permute2x128_si256(a, b, 0x31));
}

inline Bytes reverse(Bytes a) {
  const Bytes order = table16(reinterpret_cast<const uint8_t*>("\16\17\14\15\12\13\10\11\6\7\4\5\2\3\0\1"));
  const Bytes lanes = look_up(a, order);
  return _mm256_permute2x128_si256(lanes, lanes, 1);
}

// kWords: 1, 2 or 4.
template <int32_t kWords>
void count_row(const CostHammingArgs& row) {
  const CostHammingArgs args = row;  // a copy, which the costs written cannot change
  const int32_t bytes = args.bits / 8;
  const bool descending = args.view == 0;
  const LastLanes last((args.num_disparities + kAtOnce - 1) % kAtOnce + 1);
  for (int32_t x = 0; x < args.width; ++x) {
    const uint8_t* bits = args.own + ptrdiff_t{x} * bytes;
    const uint8_t* mask = args.own_mask == nullptr ? nullptr : args.own_mask + ptrdiff_t{x} * bytes;
    const Own own{repeat<kWords>(bits), mask == nullptr ? ones() : repeat<kWords>(mask)};
    const LevelRange levels = candidate_levels(args, x);
    for (int32_t level = 0; level < args.stride; level += kAtOnce) {
      uint16_t* costs = args.cost + ptrdiff_t{x} * args.stride + level;
      const int32_t disparity = args.min_disparity + level;
      const int32_t first = descending ? x - disparity - (kAtOnce - 1) : x + disparity;
      if (0 <= first && first <= args.width - kAtOnce && level < args.num_disparities) {
        Bytes cost = count_sixteen<kWords>(own, args.other + ptrdiff_t{first} * bytes);
        if (descending) cost = reverse(cost);
        store(costs, level + kAtOnce <= args.num_disparities ? cost : either(cost, last.padding));
        continue;
      }
      store(costs, ones());
      const int32_t begin = levels.first < level ? 0 : levels.first - level;
      const int32_t end = levels.last < level + kAtOnce ? levels.last - level : kAtOnce - 1;
      if (begin > end) continue;
      const ptrdiff_t matched = descending ? x - disparity - begin : x + disparity + begin;
      const Candidates candidates{args.other + matched * bytes, descending ? -bytes : bytes, begin, end};
      count_words<kWords>(bits, mask, bytes, candidates, costs);
    }
  }
}

// Costs of the lanes against one own pixel, by 64-bit word. kWords: words of a descriptor, few; 0 for any number.
template <bool kMasked, int32_t kWords>
BSM_INLINE __m256i count_lanes(const Block& block, View own, ptrdiff_t bytes) {
  Counter counter;
  const auto word = [&](ptrdiff_t i) {
    const __m256i differing = _mm256_xor_si256(every_word(own.descriptors + 8 * i), _mm256_load_si256(block.words + i));
    return kMasked ? _mm256_and_si256(differing, every_word(own.masks + 8 * i)) : differing;
  };
  const ptrdiff_t words = kWords != 0 ? kWords : bytes / 8;
  ptrdiff_t i = 0;
  for (; i + 4 <= words; i += 4) {
    const __m256i four[4] = {word(i), word(i + 1), word(i + 2), word(i + 3)};
    counter.add_four(four);
  }
  for (; i < words; ++i) counter.add(word(i));
  return kWords != 0 && kWords < 4 ? counter.sum() : counter.sum_of_fours();
}

// Sets all costs of a pixel to none.
inline void clear(const CostHammingArgs& args, int32_t x) {
  uint16_t* costs = args.cost + ptrdiff_t{x} * args.stride;
  for (int32_t level = 0; level < args.stride; level += kAtOnce) store(costs + level, ones());
}

template <bool kMasked, int32_t kWords>
BSM_NOINLINE void count_blocks(const CostHammingArgs& row) {
  const CostHammingArgs args = row;  // a copy, which the costs written cannot change
  const ptrdiff_t bytes = args.bits / 8;
  const bool descending = args.view == 0;
  const int32_t step = descending ? 1 : -1;
  const __m128i order = descending ? _mm_setr_epi8(12, 13, 8, 9, 4, 5, 0, 1, -1, -1, -1, -1, -1, -1, -1, -1)
                                   : _mm_setr_epi8(0, 1, 4, 5, 8, 9, 12, 13, -1, -1, -1, -1, -1, -1, -1, -1);
  int32_t cleared = 0;
  for (int32_t first = 0; first < args.width; first += kPixels) {
    const int32_t pixels = args.width - first < kPixels ? args.width - first : kPixels;
    const Block block(args.other + first * bytes, pixels, bytes, static_cast<__m256i*>(args.scratch));
    // Own pixel x has the levels base + step * x and the next three, the last pixel's first when descending.
    const int32_t base = descending ? -args.min_disparity - first - (kPixels - 1) : first - args.min_disparity;
    const int32_t least = descending ? first + args.min_disparity : base - args.num_disparities + 1;
    const Span span(args.width, least, args.num_disparities, pixels, kPixels);
    for (; cleared < span.end; ++cleared) clear(args, cleared);
    const auto four_costs = [&](View own) {  // in the order of levels
      const __m256i sums = count_lanes<kMasked, kWords>(block, own, bytes);
      return _mm_shuffle_epi8(_mm_packus_epi32(_mm256_castsi256_si128(sums), _mm256_extracti128_si256(sums, 1)), order);
    };
    View own = View{args.own, args.own_mask}.from(span.begin * bytes);
    uint16_t* costs = args.cost + ptrdiff_t{span.begin} * args.stride + base + step * span.begin;
    const auto advance = [&] {
      own = own.from(bytes);
      costs += args.stride + step;
    };
    int32_t x = span.begin;
    const int32_t ends[] = {span.all_begin, span.end};
    for (const int32_t end : ends) {
      for (; x < end; ++x, advance()) {  // some of the block's pixels are candidates
        const uint64_t four = static_cast<uint64_t>(_mm_cvtsi128_si64(four_costs(own)));
        const int32_t level = base + step * x;
        for (int32_t i = 0; i < kPixels; ++i) {
          const int32_t pixel = descending ? kPixels - 1 - i : i;
          const bool candidate = pixel < pixels && 0 <= level + i && level + i < args.num_disparities;
          if (candidate) costs[i] = static_cast<uint16_t>(four >> (16 * i));
        }
      }
      for (; x < span.all_end; ++x, advance()) _mm_storel_epi64(reinterpret_cast<__m128i*>(costs), four_costs(own));
    }
  }
  for (; cleared < args.width; ++cleared) clear(args, cleared);
}

}  // namespace

uint64_t cost_hamming_avx2_scratch(const KernelShape& shape) {
  return sizeof(__m256i) * static_cast<uint64_t>(shape.bits / 64);
}

void cost_hamming_avx2(const CostHammingArgs& args) {
  if (args.bits == 64) return count_row<1>(args);
  if (args.bits == 128) return count_row<2>(args);
  if (args.bits == 256) return count_row<4>(args);
  if (args.own_mask == nullptr) return count_blocks<false, 0>(args);  // for studies: any length alike
  with_words<7>(args.bits / 64, [&](auto words) { count_blocks<true, decltype(words)::kCount>(args); });
}

}  // namespace bsm
#endif
