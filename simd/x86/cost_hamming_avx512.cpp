// cost_hamming, AVX-512 BW, VPOPCNTDQ: 32 candidates at once, neighbours in the other view's row.
// One three-operand operation XORs and masks; counts of 64-bit words are packed to bytes and added in pairs. Bound, per 32
// candidates of 128 bits: 8 loads, 8 logic, 8 population counts, 9 to add up and order.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include <immintrin.h>

#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 32;  // candidates at once

// Bits begin..end-1 of 64.
inline uint64_t range(int32_t begin, int32_t end) {
  begin = begin < 0 ? 0 : begin;
  end = end > 64 ? 64 : end;
  return begin < end ? ~uint64_t{0} >> (64 - (end - begin)) << begin : 0;
}

// The pixel whose costs are counted: descriptor and mask, repeated over a register where they are shorter.
struct Own {
  __m512i bits, mask;
  const uint8_t* descriptor;
  const uint8_t* kept;  // nullptr: all bits
};

// Candidates of the other view in the order of memory; those outside begin..end-1 are not in the row.
struct Candidates {
  const uint8_t* first;
  int32_t begin, end;
};

template <int32_t kWords>
inline __m512i repeat(const uint8_t* from) {
  if constexpr (kWords == 1) {
    return _mm512_broadcastq_epi64(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)));
  } else if constexpr (kWords == 2) {
    return _mm512_broadcast_i64x2(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from)));
  } else if constexpr (kWords == 4) {
    return _mm512_broadcast_i64x4(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)));
  } else {
    return _mm512_setzero_si512();
  }
}

// Set bits of (other ^ own) & mask, by 64-bit word. The first operand is overwritten: the one that is not needed again.
inline __m512i count(__m512i other, __m512i own, __m512i mask) {
  return _mm512_popcnt_epi64(_mm512_ternarylogic_epi64(other, own, mask, 0x28));
}

// Counts of register `i` of the candidates, by word.
template <int32_t kWords, bool kWhole>
inline __m512i count_register(const Own& own, const Candidates& other, int32_t i) {
  const uint8_t* from = other.first + ptrdiff_t{i} * 64;
  if (kWhole) return count(_mm512_loadu_si512(from), own.bits, own.mask);
  const __mmask8 inside = static_cast<__mmask8>(range(kWords * other.begin - 8 * i, kWords * other.end - 8 * i));
  return count(_mm512_maskz_loadu_epi64(inside, from), own.bits, own.mask);
}

// Four registers of counts to one: lane l holds words 2 l and 2 l + 1 of the first, then of the second, .., in 16 bits.
inline __m512i pack_four(__m512i a, __m512i b, __m512i c, __m512i d) {
  return _mm512_packus_epi32(_mm512_packus_epi32(a, b), _mm512_packus_epi32(c, d));
}

// Eight registers of counts, each at most 64, to one: lane l holds the sums of words 2 l and 2 l + 1 of each.
template <int32_t kWords, bool kWhole>
inline __m512i count_eight(const Own& own, const Candidates& other, int32_t first) {
  const auto four = [&](int32_t i) {
    return pack_four(count_register<kWords, kWhole>(own, other, i), count_register<kWords, kWhole>(own, other, i + 1),
                     count_register<kWords, kWhole>(own, other, i + 2), count_register<kWords, kWhole>(own, other, i + 3));
  };
  return _mm512_maddubs_epi16(_mm512_packus_epi16(four(first), four(first + 4)), _mm512_set1_epi8(1));
}

// Eight candidates from `first` on, of any number of words: each lane of 128 bits holds a part of their eight sums.
template <bool kWhole>
inline __m512i count_long(const Own& own, const Candidates& other, int32_t words, int32_t first) {
  __m512i counts[8];
  BSM_UNROLL
  for (int32_t i = 0; i < 8; ++i) counts[i] = _mm512_setzero_si512();
  const ptrdiff_t bytes = ptrdiff_t{words} * 8;
  const uint8_t* from = other.first + first * bytes;
  for (int32_t word = 0; word < words; word += 8) {
    const __mmask8 valid = static_cast<__mmask8>(words - word < 8 ? (1u << (words - word)) - 1 : 0xffu);
    const ptrdiff_t at = ptrdiff_t{word} * 8;
    const __m512i bits = _mm512_maskz_loadu_epi64(valid, own.descriptor + at);
    const __m512i mask = own.kept == nullptr ? _mm512_set1_epi32(-1) : _mm512_maskz_loadu_epi64(valid, own.kept + at);
    BSM_UNROLL
    for (int32_t i = 0; i < 8; ++i) {
      const bool inside = kWhole || (other.begin <= first + i && first + i < other.end);
      const __m512i candidate = _mm512_maskz_loadu_epi64(inside ? valid : __mmask8{0}, from + i * bytes + at);
      counts[i] = _mm512_add_epi64(counts[i], count(candidate, bits, mask));
    }
  }
  const __m512i ones = _mm512_set1_epi16(1);
  return _mm512_packus_epi32(_mm512_madd_epi16(pack_four(counts[0], counts[1], counts[2], counts[3]), ones),
                             _mm512_madd_epi16(pack_four(counts[4], counts[5], counts[6], counts[7]), ones));
}

// Where candidate k of count_candidates lies.
template <int32_t kWords>
constexpr int32_t lane_of(int32_t k) {
  return kWords == 1   ? 8 * (k % 8 / 2) + 2 * (k / 8) + k % 2
         : kWords == 2 ? 8 * (k % 4) + k / 4
         : kWords == 4 ? 8 * (2 * (k / 16) + k % 2) + k / 2 % 8
                       : k;
}

// Costs of 32 candidates; kWords: 64-bit words of a descriptor, 0 for any number.
template <int32_t kWords, bool kWhole>
inline __m512i count_candidates(const Own& own, const Candidates& other, int32_t words) {
  if constexpr (kWords == 1) {
    return pack_four(count_register<1, kWhole>(own, other, 0), count_register<1, kWhole>(own, other, 1),
                     count_register<1, kWhole>(own, other, 2), count_register<1, kWhole>(own, other, 3));
  } else if constexpr (kWords == 2) {
    return count_eight<2, kWhole>(own, other, 0);
  } else if constexpr (kWords == 4) {
    const __m512i a = count_eight<4, kWhole>(own, other, 0);
    const __m512i b = count_eight<4, kWhole>(own, other, 8);
    return _mm512_add_epi16(_mm512_shuffle_i64x2(a, b, 0x88), _mm512_shuffle_i64x2(a, b, 0xdd));
  } else {
    const auto sixteen = [&](int32_t first) {
      const __m512i a = count_long<kWhole>(own, other, words, first);
      const __m512i b = count_long<kWhole>(own, other, words, first + 8);
      return _mm512_add_epi16(_mm512_shuffle_i64x2(a, b, 0x44), _mm512_shuffle_i64x2(a, b, 0xee));
    };
    const __m512i a = sixteen(0);
    const __m512i b = sixteen(16);
    return _mm512_add_epi16(_mm512_shuffle_i64x2(a, b, 0x88), _mm512_shuffle_i64x2(a, b, 0xdd));
  }
}

// Lanes of count_candidates in the order of levels: descending positions for the left view, ascending for the right.
template <int32_t kWords>
struct LevelOrder {
  alignas(64) uint16_t lane[2][kLanes];

  constexpr LevelOrder() : lane() {
    for (int32_t k = 0; k < kLanes; ++k) {
      lane[0][k] = static_cast<uint16_t>(lane_of<kWords>(kLanes - 1 - k));
      lane[1][k] = static_cast<uint16_t>(lane_of<kWords>(k));
    }
  }
};

template <int32_t kWords>
constexpr LevelOrder<kWords> kLevelOrder{};

// What stays the same for all pixels of a row.
struct Row {
  const uint8_t* other;
  ptrdiff_t bytes;  // of a descriptor
  int32_t words;
  int32_t width;
  bool descending;
};

// Costs of 32 levels, not all of them candidates: `first` is the leftmost pixel of the other view.
template <int32_t kWords>
BSM_NOINLINE __m512i count_partly(const Row& row, const Own& own, __m512i order, int32_t first, __mmask32 levels) {
  const __m512i none = _mm512_set1_epi32(-1);
  const int32_t begin = first < 0 ? -first : 0;
  const int32_t end = row.width - first < kLanes ? row.width - first : kLanes;
  if (begin >= end) return none;
  const Candidates other{row.other + first * row.bytes, begin, end};
  const uint64_t inside = row.descending ? range(kLanes - end, kLanes - begin) : range(begin, end);
  const __m512i counts = count_candidates<kWords, false>(own, other, row.words);
  return _mm512_mask_permutexvar_epi16(none, static_cast<__mmask32>(inside & levels), order, counts);
}

template <int32_t kWords>
BSM_NOINLINE void count_row(const CostHammingArgs& args) {
  const Row row{args.other, args.bits / 8, args.bits / 64, args.width, args.view == 0};
  const uint8_t* own_bits = args.own;
  const uint8_t* own_mask = args.own_mask;
  uint16_t* costs = args.cost;
  const int32_t stride = args.stride;
  const int32_t num_disparities = args.num_disparities;
  const int32_t min_disparity = args.min_disparity;
  const __m512i order = _mm512_load_si512(kLevelOrder<kWords>.lane[args.view]);
  const __m512i none = _mm512_set1_epi32(-1);
  for (int32_t x = 0; x < row.width; ++x, costs += stride) {
    Own own{repeat<kWords>(own_bits), none, own_bits, own_mask};
    own_bits += row.bytes;
    if (own_mask != nullptr) {
      own.mask = repeat<kWords>(own_mask);
      own_mask += row.bytes;
    }
    for (int32_t level = 0; level < stride; level += kLanes) {
      const int32_t disparity = min_disparity + level;
      const int32_t first = row.descending ? x - disparity - (kLanes - 1) : x + disparity;
      const int32_t count = num_disparities - level;
      const __mmask32 levels = count >= kLanes ? ~__mmask32{0} : static_cast<__mmask32>(range(0, count));
      __m512i cost;
      if (0 <= first && first <= row.width - kLanes) {
        const Candidates other{row.other + first * row.bytes, 0, kLanes};
        const __m512i counts = count_candidates<kWords, true>(own, other, row.words);
        cost = _mm512_mask_permutexvar_epi16(none, levels, order, counts);
      } else {
        cost = count_partly<kWords>(row, own, order, first, levels);
      }
      _mm512_storeu_si512(costs + level, cost);
    }
  }
}

}  // namespace

uint64_t cost_hamming_avx512_scratch(const KernelShape&) {
  return 0;
}

void cost_hamming_avx512(const CostHammingArgs& args) {
  switch (args.bits / 64) {
    case 1:
      return count_row<1>(args);
    case 2:
      return count_row<2>(args);
    case 4:
      return count_row<4>(args);
    default:
      return count_row<0>(args);
  }
}

}  // namespace bsm
#endif
