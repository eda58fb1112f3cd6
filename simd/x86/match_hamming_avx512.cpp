// match_hamming, AVX-512 F, BW, VPOPCNTDQ: eight or sixteen candidates of a left pixel at once.
// The XOR of a candidate never leaves the register: one three-operand operation XORs and masks for each view. A winner is
// the least of cost and level in one 32-bit word, so that ties need no order. Bound, per 512 bits of a candidate and both
// views: 2 logic, 2 population counts, 2 additions; 2 loads.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include <immintrin.h>

#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr uint32_t kNone = 0xffffffffu;  // no candidate

inline __m512i xor_and(__m512i a, __m512i b, __m512i mask) {
  return _mm512_ternarylogic_epi64(a, b, mask, 0x28);  // (a ^ b) & mask
}

struct View {
  const uint8_t* descriptors;
  const uint8_t* masks;
};

// Sums of the words of eight candidates in both views, by candidate.
struct Costs {
  __m256i left, right;  // 32-bit
};

// Sixteen vectors of eight counts, none above 512, to sixteen sums: 0..7 into left, 8..15 into right.
inline Costs add_up(const __m512i (&left)[8], const __m512i (&right)[8]) {
  __m512i four[4];  // four sums of 16 bits in each word, of candidates i, i + 2, i + 4, i + 6
  BSM_UNROLL
  for (int32_t i = 0; i < 2; ++i) {
    const __m512i(&from)[8] = i == 0 ? left : right;
    BSM_UNROLL
    for (int32_t k = 0; k < 2; ++k) {
      const __m512i low = _mm512_add_epi64(from[k], _mm512_slli_epi64(from[k + 2], 16));
      const __m512i high = _mm512_add_epi64(from[k + 4], _mm512_slli_epi64(from[k + 6], 16));
      four[2 * i + k] = _mm512_add_epi64(low, _mm512_slli_epi64(high, 32));
    }
  }
  // Words: a candidate's sums move together, first within 128 bits, then across.
  const __m512i a = _mm512_add_epi64(_mm512_unpacklo_epi64(four[0], four[1]), _mm512_unpackhi_epi64(four[0], four[1]));
  const __m512i b = _mm512_add_epi64(_mm512_unpacklo_epi64(four[2], four[3]), _mm512_unpackhi_epi64(four[2], four[3]));
  const __m512i halves = _mm512_add_epi64(_mm512_shuffle_i64x2(a, b, 0x44), _mm512_shuffle_i64x2(a, b, 0xee));
  const __m512i sums = _mm512_add_epi64(halves, _mm512_shuffle_i64x2(halves, halves, 0xb1));
  // 16-bit lanes of a view: candidates 0 2 4 6 1 3 5 7.
  const __m128i order = _mm_setr_epi8(0, 1, 8, 9, 2, 3, 10, 11, 4, 5, 12, 13, 6, 7, 14, 15);
  const __m128i l = _mm_shuffle_epi8(_mm512_castsi512_si128(sums), order);
  const __m128i r = _mm_shuffle_epi8(_mm512_extracti64x2_epi64(sums, 2), order);
  return Costs{_mm256_cvtepu16_epi32(l), _mm256_cvtepu16_epi32(r)};
}

// Costs of the left pixel against eight right pixels from `right` on, of `words` 64-bit words each.
template <bool kMasked>
inline Costs compare_eight(View left, View right, int32_t words) {
  __m512i left_counts[8];
  __m512i right_counts[8];
  BSM_UNROLL
  for (int32_t i = 0; i < 8; ++i) left_counts[i] = right_counts[i] = _mm512_setzero_si512();
  const ptrdiff_t bytes = ptrdiff_t{words} * 8;
  for (int32_t word = 0; word < words; word += 8) {
    const __mmask8 valid = static_cast<__mmask8>(words - word < 8 ? (1u << (words - word)) - 1 : 0xffu);
    const ptrdiff_t at = ptrdiff_t{word} * 8;
    const __m512i own = _mm512_maskz_loadu_epi64(valid, left.descriptors + at);
    const __m512i own_mask = kMasked ? _mm512_maskz_loadu_epi64(valid, left.masks + at) : own;
    BSM_UNROLL
    for (int32_t i = 0; i < 8; ++i) {
      const __m512i other = _mm512_maskz_loadu_epi64(valid, right.descriptors + i * bytes + at);
      if (kMasked) {
        const __m512i other_mask = _mm512_maskz_loadu_epi64(valid, right.masks + i * bytes + at);
        left_counts[i] = _mm512_add_epi64(left_counts[i], _mm512_popcnt_epi64(xor_and(own, other, own_mask)));
        right_counts[i] = _mm512_add_epi64(right_counts[i], _mm512_popcnt_epi64(xor_and(own, other, other_mask)));
      } else {
        left_counts[i] = _mm512_add_epi64(left_counts[i], _mm512_popcnt_epi64(_mm512_xor_si512(own, other)));
      }
    }
  }
  if (!kMasked) {
    BSM_UNROLL
    for (int32_t i = 0; i < 8; ++i) right_counts[i] = left_counts[i];
  }
  return add_up(left_counts, right_counts);
}

// The same for descriptors of 1, 2 or 4 words: a register holds several right pixels.
template <bool kMasked, int32_t kWords>
inline Costs compare_eight_short(View left, View right) {
  __m512i own, own_mask;
  if (kWords == 1) {
    own = _mm512_broadcastq_epi64(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(left.descriptors)));
    own_mask = kMasked ? _mm512_broadcastq_epi64(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(left.masks))) : own;
  } else if (kWords == 2) {
    own = _mm512_broadcast_i64x2(_mm_loadu_si128(reinterpret_cast<const __m128i*>(left.descriptors)));
    own_mask = kMasked ? _mm512_broadcast_i64x2(_mm_loadu_si128(reinterpret_cast<const __m128i*>(left.masks))) : own;
  } else {
    own = _mm512_broadcast_i64x4(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(left.descriptors)));
    own_mask = kMasked ? _mm512_broadcast_i64x4(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(left.masks))) : own;
  }
  __m512i counts[2][kWords];  // by view
  BSM_UNROLL
  for (int32_t i = 0; i < kWords; ++i) {
    const __m512i other = _mm512_loadu_si512(right.descriptors + 64 * i);
    if (kMasked) {
      counts[0][i] = _mm512_popcnt_epi64(xor_and(own, other, own_mask));
      counts[1][i] = _mm512_popcnt_epi64(xor_and(own, other, _mm512_loadu_si512(right.masks + 64 * i)));
    } else {
      counts[0][i] = counts[1][i] = _mm512_popcnt_epi64(_mm512_xor_si512(own, other));
    }
  }
  __m256i sums[2];
  BSM_UNROLL
  for (int32_t view = 0; view < 2; ++view) {
    const __m512i(&c)[kWords] = counts[view];
    if (kWords == 1) {
      sums[view] = _mm512_cvtepi64_epi32(c[0]);
    } else if (kWords == 2) {
      const __m512i sum =
          _mm512_add_epi64(_mm512_unpacklo_epi64(c[0], c[kWords - 1]), _mm512_unpackhi_epi64(c[0], c[kWords - 1]));
      const __m256i order = _mm256_setr_epi32(0, 2, 4, 6, 1, 3, 5, 7);
      sums[view] = _mm256_permutevar8x32_epi32(_mm512_cvtepi64_epi32(sum), order);
    } else {
      // Candidates 2 i and 2 i + 1 are the halves of register i.
      const __m512i a = _mm512_add_epi64(c[0], _mm512_slli_epi64(c[1 % kWords], 32));
      const __m512i b = _mm512_add_epi64(c[2 % kWords], _mm512_slli_epi64(c[3 % kWords], 32));
      const __m512i sum = _mm512_add_epi64(_mm512_unpacklo_epi64(a, b), _mm512_unpackhi_epi64(a, b));
      // 32-bit lanes, two for each 64 bits: candidates 0 2 | 4 6 | 0 2 | 4 6 || 1 3 | 5 7 | ...
      const __m512i both = _mm512_add_epi32(sum, _mm512_shuffle_i64x2(sum, sum, 0xb1));
      const __m512i order = _mm512_setr_epi32(0, 8, 1, 9, 2, 10, 3, 11, 0, 0, 0, 0, 0, 0, 0, 0);
      sums[view] = _mm512_castsi512_si256(_mm512_permutexvar_epi32(order, both));
    }
  }
  return Costs{sums[0], sums[1]};
}

template <bool kMasked, int32_t kWords>
inline Costs compare(View left, View right, int32_t words) {
  if constexpr (kWords == 0) {
    return compare_eight<kMasked>(left, right, words);
  } else {
    return compare_eight_short<kMasked, kWords>(left, right);
  }
}

inline uint16_t level_of(uint32_t key) {
  return key == kNone ? kNoLevel : static_cast<uint16_t>(key << kLevelShift);
}

inline uint32_t least(__m256i keys) {
  __m128i least = _mm_min_epu32(_mm256_castsi256_si128(keys), _mm256_extracti128_si256(keys, 1));
  least = _mm_min_epu32(least, _mm_shuffle_epi32(least, 0x4e));
  least = _mm_min_epu32(least, _mm_shuffle_epi32(least, 0xb1));
  return static_cast<uint32_t>(_mm_cvtsi128_si32(least));
}

// A row's costs and winners; kWords: 64-bit words of a descriptor, 0 for any number.
template <bool kMasked, int32_t kWords>
struct Row {
  const MatchHammingArgs& args;
  uint32_t* right_best;  // a key for each right pixel, with 8 more on both sides

  // Compares left pixel x at levels level .. level + 7 and updates the right pixels' winners. Returns the left keys.
  __m256i eight_levels(int32_t x, int32_t level) const {
    const __m256i none = _mm256_set1_epi32(-1);
    const ptrdiff_t bytes = args.bits / 8;
    const int32_t levels = args.num_disparities - level < 8 ? args.num_disparities - level : 8;
    // Right pixels first .. first + 7 meet x at levels level + 7 .. level; those begin .. end - 1 are candidates.
    const int32_t first = x - args.min_disparity - level - 7;
    const int32_t begin = 8 - levels > -first ? 8 - levels : -first;
    const int32_t end = args.width - first < 8 ? args.width - first : 8;
    if (begin >= end) return none;
    const __mmask8 valid = static_cast<__mmask8>((1u << end) - (1u << begin));
    // Near the ends of the row the eight pixels compared lie further inside, and the results move back.
    const int32_t last = (args.width + 7) / 8 * 8 - 8;
    const int32_t start = first < 0 ? 0 : first > last ? last : first;
    const View left{args.left + x * bytes, kMasked ? args.left_mask + x * bytes : nullptr};
    const View right{args.right + start * bytes, kMasked ? args.right_mask + start * bytes : nullptr};
    Costs costs = compare<kMasked, kWords>(left, right, args.bits / 64);
    if (start != first) {
      const __m256i lanes = _mm256_add_epi32(_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), _mm256_set1_epi32(first - start));
      costs.left = _mm256_permutevar8x32_epi32(costs.left, lanes);
      costs.right = _mm256_permutevar8x32_epi32(costs.right, lanes);
    }
    const __m256i numbers = _mm256_add_epi32(_mm256_set1_epi32(level), _mm256_setr_epi32(7, 6, 5, 4, 3, 2, 1, 0));
    const __m256i left_keys = _mm256_or_si256(_mm256_slli_epi32(costs.left, 16), numbers);
    const __m256i right_keys = _mm256_or_si256(_mm256_slli_epi32(costs.right, 16), numbers);
    __m256i* best = reinterpret_cast<__m256i*>(right_best + first);
    const __m256i old = _mm256_loadu_si256(best);
    _mm256_storeu_si256(best, _mm256_mask_min_epu32(old, valid, old, right_keys));
    return _mm256_mask_mov_epi32(none, valid, left_keys);
  }
};

template <bool kMasked, int32_t kWords>
void match_row(const MatchHammingArgs& args) {
  uint32_t* left_best = static_cast<uint32_t*>(args.scratch);
  uint32_t* right_best = left_best + args.width + 8;
  for (int32_t x = -8; x < args.width + 8; ++x) right_best[x] = kNone;
  const Row<kMasked, kWords> row{args, right_best};
  if (kWords != 0) {
    for (int32_t x = 0; x < args.width; ++x) {
      __m256i best = _mm256_set1_epi32(-1);
      for (int32_t level = 0; level < args.num_disparities; level += 8) {
        best = _mm256_min_epu32(best, row.eight_levels(x, level));
      }
      left_best[x] = least(best);
    }
  } else {
    // Eight levels at a time, so that their right pixels stay in the first-level cache while x runs.
    for (int32_t x = 0; x < args.width; ++x) left_best[x] = kNone;
    for (int32_t level = 0; level < args.num_disparities; level += 8) {
      for (int32_t x = 0; x < args.width; ++x) {
        const uint32_t key = least(row.eight_levels(x, level));
        if (key < left_best[x]) left_best[x] = key;
      }
    }
  }
  for (int32_t x = 0; x < args.width; ++x) {
    args.left_level[x] = level_of(left_best[x]);
    args.right_level[x] = level_of(right_best[x]);
  }
}

template <bool kMasked>
void match_row_of(const MatchHammingArgs& args) {
  switch (args.bits / 64) {
    case 1:
      return match_row<kMasked, 1>(args);
    case 2:
      return match_row<kMasked, 2>(args);
    case 4:
      return match_row<kMasked, 4>(args);
    default:
      return match_row<kMasked, 0>(args);
  }
}

}  // namespace

uint64_t match_hamming_avx512_scratch(const KernelShape& shape) {
  return sizeof(uint32_t) * (2 * static_cast<uint64_t>(shape.width) + 16);
}

void match_hamming_avx512(const MatchHammingArgs& args) {
  if (args.left_mask != nullptr) {
    match_row_of<true>(args);
  } else {
    match_row_of<false>(args);
  }
}

}  // namespace bsm
#endif
