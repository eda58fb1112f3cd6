// mask_threshold, AVX-512 BW, VBMI, GFNI: 64 neighbouring pixels at once.
// The SAD of every window offset in use is one byte a pixel, saturated at 255. A pass tries eight thresholds: bit j of a
// byte says that the SAD is within threshold j, and carry-save adders count each of the 512 bits over all pairs. Three pairs
// that share an offset are added first: 8 operations and 4 loads for them all, ANDs with the shared offset included; pairs
// that come twice are counted once and count twice. Two passes find most T. With T known, one compare an offset gives a word
// of 64 pixels; a pair is one AND of the words of two blocks. Bound: two ALUs, so 4/3 cycles a pair and pass, and 7/8 for
// the transposition, which one of them does.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/kernels.h"
#include "simd/pattern_points.h"
#include "simd/x86/transpose_avx512.h"

namespace bsm {
namespace {

constexpr int32_t kBlocks = 2;      // whose words are made at once
constexpr int32_t kHighLevels = 8;  // bits of a count from 32 on

struct Counter {
  __m512i level[5];  // bits 0..4 of 512 counts
};

struct alignas(64) Scratch {
  uint8_t sad[kMaxPoints][64];
  uint8_t within[kMaxPoints + 1][64];  // bit j: the SAD is within threshold j
  __m512i high[kHighLevels];           // counts are ones + 2 twos + 32 high
  Counter twice[2];                    // ones and twos of what counts twice, once
  uint64_t tile[kTileWords];
  uint64_t words[kBlocks][kTileWords];
  uint64_t point_words[kMaxPoints][kBlocks];
  uint16_t exact_sad[kMaxPoints];
  uint16_t histogram[kMaxSad + 1];
  const PatternOrder* order;
  const PatternPoints* points;
  const uint8_t* at[kMaxPoints];  // first plane of the points of pixel 0
};

inline __m512i distance(__m512i a, __m512i b) {
  return _mm512_sub_epi8(_mm512_max_epu8(a, b), _mm512_min_epu8(a, b));
}

// The same with a compare, which another ALU does.
inline __m512i distance_by_order(__m512i a, __m512i b) {
  return _mm512_mask_sub_epi8(_mm512_sub_epi8(a, b), _mm512_cmplt_epu8_mask(a, b), b, a);
}

// Thresholds of a pass above a pixel's lower bound, as bytes within(d) for differences d = 0..63.
struct Thresholds {
  uint8_t within[64];
};

constexpr Thresholds make_thresholds(const int32_t (&limits)[8]) {
  Thresholds table{};
  for (int32_t d = 0; d < 64; ++d) {
    for (int32_t j = 0; j < 8; ++j) {
      if (d <= limits[j]) table.within[d] = static_cast<uint8_t>(table.within[d] | 1 << j);
    }
  }
  return table;
}

// The first pass: thresholds kFirstLeast + these, so that below 71, where most are, no bracket is wider than the nine values
// that one pass by ones tells apart.
constexpr int32_t kFirstLeast = 8;
alignas(64) constexpr Thresholds kFirst = make_thresholds({0, 9, 18, 27, 36, 45, 54, 62});
alignas(64) constexpr Thresholds kNext = make_thresholds({0, 1, 2, 3, 4, 5, 6, 7});

// Differences above 63 are within no threshold.
inline __m512i find_within(__m512i sad, __m512i least, __m512i table) {
  const __m512i above = _mm512_min_epu8(_mm512_subs_epu8(sad, least), _mm512_set1_epi8(63));
  return _mm512_permutexvar_epi8(above, table);
}

// SADs of all points, and what is within the thresholds of the first pass.
template <int32_t kPlanes>
BSM_NOINLINE void window_sad(const MaskThresholdArgs& args, int32_t x, Scratch& scratch) {
  const uint8_t* own = args.rows[args.pattern.radius] + x;
  const ptrdiff_t stride = args.plane_stride;
  __m512i center[kPlanes];
  BSM_UNROLL
  for (int32_t i = 0; i < kPlanes; ++i) center[i] = _mm512_loadu_si512(own + i * stride);
  const __m512i least = _mm512_set1_epi8(kFirstLeast);
  const __m512i table = _mm512_load_si512(kFirst.within);
  const int32_t count = scratch.points->count;
  for (int32_t i = 0; i < count; ++i) {
    const uint8_t* at = scratch.at[i] + x;
    __m512i color[kPlanes];
    BSM_UNROLL
    for (int32_t plane = 0; plane < kPlanes; ++plane) color[plane] = _mm512_loadu_si512(at + plane * stride);
    BSM_KEEP_ORDER();  // each is loaded once
    __m512i sad = distance(center[0], color[0]);
    BSM_UNROLL
    for (int32_t plane = 1; plane < kPlanes; ++plane) {
      sad = _mm512_adds_epu8(sad, distance_by_order(center[plane], color[plane]));
    }
    _mm512_store_si512(scratch.sad[i], sad);
    _mm512_store_si512(scratch.within[i], find_within(sad, least, table));
  }
}

// sum and carry of three bits.
inline __m512i sum3(__m512i a, __m512i b, __m512i c) {
  return _mm512_ternarylogic_epi64(a, b, c, 0x96);
}
// The carry of old + a + b by the sum: a where a = b, else the old bit, which is then the opposite of the sum. So the sum
// may take the register of the old bit, and nothing is copied.
inline __m512i carry3(__m512i a, __m512i b, __m512i sum) {
  return _mm512_ternarylogic_epi64(a, b, sum, 0xd4);
}

// Adds the bits a and b to a level; returns the carry.
template <int32_t kLevel>
BSM_INLINE __m512i add(Counter& counter, __m512i a, __m512i b) {
  counter.level[kLevel] = sum3(counter.level[kLevel], a, b);
  return carry3(a, b, counter.level[kLevel]);
}

BSM_INLINE __m512i load_within(const Scratch& scratch, uint16_t point) {
  return _mm512_load_si512(reinterpret_cast<const uint8_t*>(&scratch.within) + 8 * ptrdiff_t{point});
}

// How many of a triple's pairs are within: a bit of weight 1 and one of weight 2.
struct Two {
  __m512i ones, twos;
};

BSM_INLINE Two triple_within(const Scratch& scratch, const PatternOrder::Triple& triple) {
  const __m512i a = load_within(scratch, triple.others[0]);
  const __m512i b = load_within(scratch, triple.others[1]);
  const __m512i sum = sum3(load_within(scratch, triple.others[2]), a, b);
  const __m512i shared = load_within(scratch, triple.shared);
  return Two{_mm512_and_si512(sum, shared), _mm512_and_si512(carry3(a, b, sum), shared)};
}

// Counts the pairs of the next 2 << kLevel triples, bits of the two weights apart; returns the carries.
template <int32_t kLevel>
BSM_INLINE Two add_triples(Counter& ones, Counter& twos, const Scratch& scratch, const PatternOrder::Triple* triples) {
  Two a, b;
  if constexpr (kLevel == 0) {
    a = triple_within(scratch, triples[0]);
    b = triple_within(scratch, triples[1]);
  } else {
    a = add_triples<kLevel - 1>(ones, twos, scratch, triples);
    // Loads below stay below, and what the carries need above: so few values wait that none leaves the registers.
    __asm__ volatile("" : "+v"(a.ones), "+v"(a.twos) : : "memory");
    b = add_triples<kLevel - 1>(ones, twos, scratch, triples + (1 << kLevel));
  }
  return Two{add<kLevel>(ones, a.ones, b.ones), add<kLevel>(twos, a.twos, b.twos)};
}

// Adds carries of the weights 32 and 64 to the high bits.
BSM_INLINE void add_high(__m512i* high, int32_t levels, Two carries) {
  __m512i carry = _mm512_and_si512(high[0], carries.ones);
  high[0] = _mm512_xor_si512(high[0], carries.ones);
  high[1] = sum3(high[1], carry, carries.twos);
  carry = carry3(carry, carries.twos, high[1]);
  for (int32_t i = 2; i < levels; ++i) {
    const __m512i old = high[i];
    high[i] = _mm512_xor_si512(old, carry);
    carry = _mm512_and_si512(old, carry);
  }
}

// Counts whole groups of triples.
BSM_INLINE void count(Counter& ones, Counter& twos, int32_t levels, Scratch& scratch, int32_t begin, int32_t end) {
  for (int32_t first = begin; first < end; first += PatternOrder::kTripleGroup) {
    add_high(scratch.high, levels, add_triples<4>(ones, twos, scratch, scratch.order->triples + first));
  }
}

// Counts the triples that count twice, once.
BSM_NOINLINE void count_twice(Scratch& scratch, int32_t levels) {
  Counter ones, twos;
  BSM_UNROLL
  for (int32_t i = 0; i < 5; ++i) ones.level[i] = twos.level[i] = _mm512_setzero_si512();
  count(ones, twos, levels, scratch, 0, scratch.order->triples_twice);
  BSM_UNROLL
  for (int32_t i = 0; i < 5; ++i) {
    scratch.twice[0].level[i] = ones.level[i];
    scratch.twice[1].level[i] = twos.level[i];
  }
}

// Bit j of byte x: at least bits / 4 pairs of pixel x are within threshold j.
BSM_NOINLINE __m512i enough(Scratch& scratch, int32_t bits) {
  int32_t levels = 2;
  while (bits >> (5 + levels) != 0) ++levels;
  for (int32_t i = 0; i < levels; ++i) scratch.high[i] = _mm512_setzero_si512();
  Counter ones, twos;
  BSM_UNROLL
  for (int32_t i = 0; i < 5; ++i) ones.level[i] = twos.level[i] = _mm512_setzero_si512();
  if (scratch.order->triples_twice != 0) {
    count_twice(scratch, levels);
    for (int32_t i = levels - 1; i > 0; --i) scratch.high[i] = scratch.high[i - 1];
    scratch.high[0] = _mm512_setzero_si512();
    add_high(scratch.high, levels, Two{scratch.twice[0].level[4], scratch.twice[1].level[4]});
    BSM_UNROLL
    for (int32_t i = 1; i < 5; ++i) {
      ones.level[i] = scratch.twice[0].level[i - 1];
      twos.level[i] = scratch.twice[1].level[i - 1];
    }
  }
  count(ones, twos, levels, scratch, scratch.order->triples_twice, scratch.order->triples_count);
  // Adds the counts up and compares with bits / 4, from the lowest bit up.
  const uint32_t wanted = static_cast<uint32_t>(bits) / 4;
  __m512i result = _mm512_set1_epi8(-1);
  __m512i carry = _mm512_setzero_si512();
  const auto compare = [&](int32_t bit, __m512i a, __m512i b) {
    const __m512i sum = sum3(carry, a, b);
    carry = carry3(a, b, sum);
    result = (wanted >> bit & 1u) != 0 ? _mm512_and_si512(result, sum) : _mm512_or_si512(result, sum);
  };
  compare(0, ones.level[0], _mm512_setzero_si512());
  BSM_UNROLL
  for (int32_t i = 1; i < 5; ++i) compare(i, ones.level[i], twos.level[i - 1]);
  compare(5, scratch.high[0], twos.level[4]);
  for (int32_t i = 1; i < levels; ++i) compare(5 + i, scratch.high[i], _mm512_setzero_si512());
  return result;
}

// How many thresholds of a byte are not enough.
inline __m512i count_failed(__m512i result) {
  const __m512i zeros = _mm512_broadcast_i32x4(_mm_setr_epi8(4, 3, 3, 2, 3, 2, 2, 1, 3, 2, 2, 1, 2, 1, 1, 0));
  const __m512i nibble = _mm512_set1_epi8(15);
  const __m512i low = _mm512_shuffle_epi8(zeros, _mm512_and_si512(result, nibble));
  const __m512i high = _mm512_shuffle_epi8(zeros, _mm512_and_si512(_mm512_srli_epi16(result, 4), nibble));
  return _mm512_add_epi8(low, high);
}

struct Bracket {
  __m512i low, high;  // T is within, both included
};

inline Bracket first_bracket(Scratch& scratch, int32_t bits) {
  const __m512i failed = count_failed(enough(scratch, bits));
  const __m512i low = _mm512_broadcast_i32x4(_mm_setr_epi8(0, 9, 18, 27, 36, 45, 54, 63, 71, 0, 0, 0, 0, 0, 0, 0));
  const __m512i high = _mm512_broadcast_i32x4(_mm_setr_epi8(8, 17, 26, 35, 44, 53, 62, 70, -1, 0, 0, 0, 0, 0, 0, 0));
  return Bracket{_mm512_shuffle_epi8(low, failed), _mm512_shuffle_epi8(high, failed)};
}

// A pass over the next eight thresholds of each pixel: one apart, eight apart for the pixels of `wide`.
inline void narrow(Scratch& scratch, int32_t bits, __mmask64 wide, Bracket& bracket) {
  const __m512i table = _mm512_load_si512(kNext.within);
  const __m512i low = bracket.low;
  const int32_t count = scratch.points->count;
  if (wide == 0) {
    for (int32_t i = 0; i < count; ++i) {
      _mm512_store_si512(scratch.within[i], find_within(_mm512_load_si512(scratch.sad[i]), low, table));
    }
  } else {
    const __m512i last = _mm512_set1_epi8(63);
    const __m512i eighth = _mm512_set1_epi8(31);
    for (int32_t i = 0; i < count; ++i) {
      const __m512i above = _mm512_subs_epu8(_mm512_load_si512(scratch.sad[i]), low);
      const __m512i by_eight = _mm512_and_si512(_mm512_srli_epi16(above, 3), eighth);
      const __m512i index = _mm512_mask_mov_epi8(_mm512_min_epu8(above, last), wide, by_eight);
      _mm512_store_si512(scratch.within[i], _mm512_permutexvar_epi8(index, table));
    }
  }
  const __m512i failed = count_failed(enough(scratch, bits));
  bracket.low = _mm512_adds_epu8(bracket.low, _mm512_mask_mov_epi8(failed, wide, _mm512_slli_epi16(failed, 3)));
  const __m512i top = _mm512_adds_epu8(bracket.low, _mm512_maskz_set1_epi8(wide, 7));
  const __mmask64 open = _mm512_cmpeq_epi8_mask(failed, _mm512_set1_epi8(8));
  bracket.high = _mm512_mask_min_epu8(bracket.high, ~open, bracket.high, top);
}

// T of 64 pixels; 255 stands for anything from 255 up. Only the pixels of `wanted` count.
inline __m512i find_threshold(Scratch& scratch, int32_t bits, __mmask64 wanted) {
  Bracket bracket = first_bracket(scratch, bits);
  for (;;) {
    const __m512i width = _mm512_maskz_sub_epi8(wanted, bracket.high, bracket.low);
    if (_mm512_test_epi8_mask(width, width) == 0) return bracket.low;
    narrow(scratch, bits, _mm512_cmpgt_epu8_mask(width, _mm512_set1_epi8(8)), bracket);
  }
}

// Words of the points: bit x says that the SAD of pixel x is within its threshold.
BSM_NOINLINE void threshold_points(const MaskThresholdArgs& args, int32_t x, int32_t block, __mmask64 wanted,
                                   __m512i threshold, Scratch& scratch) {
  const int32_t count = scratch.points->count;
  for (int32_t i = 0; i < count; ++i) {
    scratch.point_words[i][block] = _mm512_cmple_epu8_mask(_mm512_load_si512(scratch.sad[i]), threshold);
  }
  uint64_t beyond = _mm512_mask_cmpeq_epi8_mask(wanted, threshold, _mm512_set1_epi8(-1));
  for (; beyond != 0; beyond &= beyond - 1) {
    const int32_t pixel = __builtin_ctzll(beyond);
    const uint32_t exact = exact_threshold(args, x + pixel, *scratch.points, scratch.exact_sad, scratch.histogram);
    for (int32_t i = 0; i < count; ++i) {
      const uint64_t bit = uint64_t{1} << pixel;
      uint64_t& word = scratch.point_words[i][block];
      word = scratch.exact_sad[i] <= exact ? word | bit : word & ~bit;
    }
  }
}

// Words of the next pairs, of both blocks.
BSM_NOINLINE void pair_words(Scratch& scratch, const uint32_t* pairs, int32_t count) {
  const uint8_t* points = reinterpret_cast<const uint8_t*>(scratch.point_words);
  for (int32_t i = 0; i < count; ++i) {
    const uint32_t pair = pairs[i];
    const __m128i p = _mm_load_si128(reinterpret_cast<const __m128i*>(points + 2 * uint64_t{pair & 0xffff}));
    const __m128i q = _mm_load_si128(reinterpret_cast<const __m128i*>(points + 2 * uint64_t{pair >> 16}));
    const __m128i words = _mm_and_si128(p, q);
    _mm_storel_epi64(reinterpret_cast<__m128i*>(&scratch.words[0][i]), words);
    _mm_storel_epi64(reinterpret_cast<__m128i*>(&scratch.words[1][i]), _mm_unpackhi_epi64(words, words));
  }
}

// Finds the thresholds of each 64 pixels from x on by find(scratch, x, wanted), then their masks.
template <class Find>
BSM_INLINE void threshold_masks(const MaskThresholdArgs& args, const Find& find) {
  Scratch& scratch = *static_cast<Scratch*>(args.scratch);
  const int32_t bits = args.pattern.bits;
  const ptrdiff_t bytes = bits / 8;
  scratch.order = args.pattern.order;
  scratch.points = &scratch.order->points;
  const uint8_t* const* rows = args.rows + args.pattern.radius;
  for (int32_t i = 0; i < scratch.points->count; ++i) {
    scratch.at[i] = rows[scratch.points->points[i].dy] + scratch.points->points[i].dx;
  }
  _mm512_store_si512(scratch.within[scratch.points->count], _mm512_setzero_si512());
  for (int32_t x = 0; x < args.width; x += 64 * kBlocks) {
    const int32_t blocks = args.width - x <= 64 ? 1 : kBlocks;
    for (int32_t block = 0; block < blocks; ++block) {
      const int32_t begin = x + 64 * block;
      const int32_t pixels = args.width - begin < 64 ? args.width - begin : 64;
      const __mmask64 wanted = ~uint64_t{0} >> (64 - pixels);
      threshold_points(args, begin, block, wanted, find(scratch, begin, wanted), scratch);
    }
    for (int32_t first = 0; first < bits; first += kTileWords) {
      const int32_t count = bits - first < kTileWords ? bits - first : kTileWords;
      pair_words(scratch, scratch.points->pairs + first, count);
      for (int32_t block = 0; block < blocks; ++block) {
        const int32_t begin = x + 64 * block;
        store_descriptors(scratch.words[block], count / 64, args.width - begin, args.out + begin * bytes + first / 8, bytes,
                          scratch.tile);
      }
    }
  }
}

}  // namespace

uint64_t mask_threshold_avx512_scratch(const KernelShape&) {
  return sizeof(Scratch);
}

void mask_threshold_avx512(const MaskThresholdArgs& args) {
  threshold_masks(args, [&args](Scratch& scratch, int32_t x, __mmask64 wanted) {
    if (args.planes == 3) {
      window_sad<3>(args, x, scratch);
    } else {
      window_sad<1>(args, x, scratch);
    }
    return find_threshold(scratch, args.pattern.bits, wanted);
  });
}

}  // namespace bsm
#endif
