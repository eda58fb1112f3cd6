// mask_threshold for AVX2 and SSE4.2: kLanes neighbouring pixels at once, the way of mask_threshold_avx512.cpp.
// A pass tries eight thresholds: bit j of a byte says that the SAD is within threshold j, a pair is one AND, and carry-save
// adders count: 6 operations and 2 loads for 8 kLanes (pixel, threshold, pair) triples. Two passes find most T. A pair's
// words of 64 pixels are one AND. Bound: three ALUs, so 2 cycles a pair, pass and kLanes pixels. Include after the lanes of
// one instruction set.
#ifndef BSM_SIMD_X86_MASK_THRESHOLD_LANES_H
#define BSM_SIMD_X86_MASK_THRESHOLD_LANES_H

#include "simd/kernels.h"
#include "simd/pattern_points.h"
#include "simd/x86/transpose_lanes.h"

namespace bsm {
namespace {

constexpr int32_t kHighLevels = 7;  // bits of a count from 64 on
constexpr int32_t kWordsAtOnce = 512;
constexpr int32_t kBlocks = 64 / kLanes;  // of pixels, whose words are made at once

struct alignas(64) MaskScratch {
  uint8_t sad[kMaxPoints][kLanes];
  uint8_t within[kMaxPoints + 1][kLanes];  // bit j: the SAD is within threshold j
  uint8_t high[kHighLevels][kLanes];
  Word words[kBlocks][kWordsAtOnce];
  Word point_words[kMaxPoints][kBlocks];  // 8 bytes apart, as the numbers of points are
  uint16_t exact_sad[kMaxPoints];
  uint16_t histogram[kMaxSad + 1];
  const PatternOrder* order;
  const PatternPoints* points;
  const uint8_t* at[kMaxPoints];  // first plane of the points of pixel 0
};

inline Bytes distance(Bytes a, Bytes b) {
  return sub8(max8(a, b), min8(a, b));
}

inline MaskScratch& begin_row(const MaskThresholdArgs& args) {
  MaskScratch& scratch = *static_cast<MaskScratch*>(args.scratch);
  scratch.order = args.pattern.order;
  scratch.points = &scratch.order->points;
  const uint8_t* const* rows = args.rows + args.pattern.radius;
  for (int32_t i = 0; i < scratch.points->count; ++i) {
    scratch.at[i] = rows[scratch.points->points[i].dy] + scratch.points->points[i].dx;
  }
  store(scratch.within[scratch.points->count], zero());
  return scratch;
}

template <int32_t kPlanes>
inline void window_sad(const MaskThresholdArgs& args, int32_t x, MaskScratch& scratch) {
  const uint8_t* own = args.rows[args.pattern.radius] + x;
  const ptrdiff_t stride = args.plane_stride;
  Bytes center[kPlanes];
  BSM_UNROLL
  for (int32_t i = 0; i < kPlanes; ++i) center[i] = load(own + i * stride);
  const int32_t count = scratch.points->count;
  for (int32_t i = 0; i < count; ++i) {
    const uint8_t* at = scratch.at[i] + x;
    Bytes color[kPlanes];
    BSM_UNROLL
    for (int32_t plane = 0; plane < kPlanes; ++plane) color[plane] = load(at + plane * stride);
    BSM_KEEP_ORDER();  // each is loaded once
    Bytes sad = distance(center[0], color[0]);
    BSM_UNROLL
    for (int32_t plane = 1; plane < kPlanes; ++plane) {
      sad = add8_saturated(sad, distance(center[plane], color[plane]));
    }
    store(scratch.sad[i], sad);
  }
}

inline void window_sad(const MaskThresholdArgs& args, int32_t x, MaskScratch& scratch) {
  if (args.planes == 3) {
    window_sad<3>(args, x, scratch);
  } else {
    window_sad<1>(args, x, scratch);
  }
}

struct Counter {
  Bytes level[6];  // bits 0..5 of 8 kLanes counts
};

// Adds the bits a and b to a level; returns the carry.
template <int32_t kLevel>
BSM_INLINE Bytes add_bits(Counter& counter, Bytes a, Bytes b) {
  const Bytes old = counter.level[kLevel];
  const Bytes odd = differ(a, b);
  counter.level[kLevel] = differ(old, odd);
  return either(both(a, b), both(old, odd));
}

BSM_INLINE Bytes pair_within(const MaskScratch& scratch, uint32_t pair) {
  const uint8_t* within = reinterpret_cast<const uint8_t*>(&scratch.within);
  constexpr uint32_t kScale = kLanes / 8;
  return both(load(within + kScale * (pair & 0xffff)), load(within + kScale * (pair >> 16)));
}

template <int32_t kLevel>
BSM_INLINE Bytes add_pairs(Counter& counter, const MaskScratch& scratch, const uint32_t* pairs) {
  if constexpr (kLevel == 0) {
    return add_bits<0>(counter, pair_within(scratch, pairs[0]), pair_within(scratch, pairs[1]));
  } else {
    const Bytes a = add_pairs<kLevel - 1>(counter, scratch, pairs);
    BSM_KEEP_ORDER();
    const Bytes b = add_pairs<kLevel - 1>(counter, scratch, pairs + (1 << kLevel));
    return add_bits<kLevel>(counter, a, b);
  }
}

// Adds a carry of weight 64 to the high bits.
BSM_INLINE void add_high(MaskScratch& scratch, int32_t levels, Bytes carry) {
  for (int32_t i = 0; i < levels; ++i) {
    const Bytes old = load(scratch.high[i]);
    store(scratch.high[i], differ(old, carry));
    carry = both(old, carry);
  }
}

// Bit j of byte x: at least bits / 4 pairs of pixel x are within threshold j.
BSM_NOINLINE Bytes enough(MaskScratch& scratch, int32_t bits) {
  Counter counter;
  BSM_UNROLL
  for (int32_t i = 0; i < 6; ++i) counter.level[i] = zero();
  int32_t levels = 1;
  while (bits >> (6 + levels) != 0) ++levels;
  for (int32_t i = 0; i < levels; ++i) store(scratch.high[i], zero());
  const PatternOrder& order = *scratch.order;
  for (int32_t first = 0; first < order.singles_count; first += PatternOrder::kSingleGroup) {
    if (first == order.singles_twice && first != 0) {  // what is counted so far counts twice
      for (int32_t i = levels - 1; i > 0; --i) store(scratch.high[i], load(scratch.high[i - 1]));
      store(scratch.high[0], counter.level[5]);
      BSM_UNROLL
      for (int32_t i = 5; i > 0; --i) counter.level[i] = counter.level[i - 1];
      counter.level[0] = zero();
    }
    add_high(scratch, levels, add_pairs<5>(counter, scratch, order.singles + first));
  }
  // Compares with bits / 4 from the lowest bit up; 16 divides it.
  const uint32_t wanted = static_cast<uint32_t>(bits) / 4;
  Bytes result = set8(-1);
  BSM_UNROLL
  for (int32_t i = 0; i < 6; ++i) {
    result = (wanted >> i & 1u) != 0 ? both(result, counter.level[i]) : either(result, counter.level[i]);
  }
  for (int32_t i = 0; i < levels; ++i) {
    const Bytes level = load(scratch.high[i]);
    result = (wanted >> (6 + i) & 1u) != 0 ? both(result, level) : either(result, level);
  }
  return result;
}

// How many of a byte's thresholds are not enough.
inline Bytes count_failed(Bytes result) {
  alignas(16) static constexpr uint8_t kZeros[16] = {4, 3, 3, 2, 3, 2, 2, 1, 3, 2, 2, 1, 2, 1, 1, 0};
  const Bytes zeros = table16(kZeros);
  const Bytes low = look_up(zeros, both(result, set8(15)));
  return add8(low, look_up(zeros, both(right16<4>(result), set8(15))));
}

// Bytes within(d) of a pass, for differences d = 0..15 in units of the pass: bit j says d <= j.
alignas(16) constexpr uint8_t kWithin[16] = {0xff, 0xfe, 0xfc, 0xf8, 0xf0, 0xe0, 0xc0, 0x80};

struct Bracket {
  Bytes low, high;  // T is within, both included
};

// A pass with eight thresholds: each pixel's lower bound + (j << kShift) + (1 << kShift) - 1.
template <int32_t kShift>
inline void narrow(MaskScratch& scratch, int32_t bits, Bracket& bracket) {
  const Bytes table = table16(kWithin);
  const int32_t count = scratch.points->count;
  for (int32_t i = 0; i < count; ++i) {
    Bytes above = sub8_saturated(load(scratch.sad[i]), bracket.low);
    if (kShift < 4) above = min8(above, set8((16 << kShift) - 1));
    if (kShift != 0) above = both(right16<kShift>(above), set8(0xff >> kShift));
    store(scratch.within[i], look_up(table, above));
  }
  const Bytes failed = count_failed(enough(scratch, bits));
  bracket.low = add8_saturated(bracket.low, kShift == 0 ? failed : left16<kShift>(failed));
  const Bytes top = min8(bracket.high, add8_saturated(bracket.low, set8((1 << kShift) - 1)));
  bracket.high = choose(top, bracket.high, equal8(failed, set8(8)));
}

// T of kLanes pixels; 255 stands for anything from 255 up. Only the pixels whose bytes in `wanted` are set count. Two passes
// find T below 64, where most are; each 64 more take one more.
inline Bytes find_threshold(MaskScratch& scratch, int32_t bits, Bytes wanted) {
  Bracket bracket{zero(), set8(-1)};
  for (;;) {
    const Bytes width = both(sub8(bracket.high, bracket.low), wanted);
    const auto all_within = [width](int32_t most) {
      return signs(equal8(sub8_saturated(width, set8(most)), zero())) == static_cast<Word>(-1);
    };
    if (all_within(0)) return bracket.low;
    if (all_within(7)) {
      narrow<0>(scratch, bits, bracket);
    } else {
      narrow<3>(scratch, bits, bracket);
    }
  }
}

struct LaneTable {
  uint8_t lanes[2 * kLanes];  // set, then not
  constexpr LaneTable() : lanes() {
    for (int32_t i = 0; i < kLanes; ++i) lanes[i] = 0xff;
  }
};
constexpr LaneTable kLaneTable{};

// The bytes of the pixels, of kLanes, that lie in the row.
inline Bytes lanes_of(int32_t pixels) {
  return load(kLaneTable.lanes + kLanes - pixels);
}

// Words of the points: bit x says that the SAD of pixel x is within its threshold.
inline void threshold_points(const MaskThresholdArgs& args, int32_t x, int32_t block, int32_t pixels, Bytes threshold,
                             MaskScratch& scratch) {
  const int32_t count = scratch.points->count;
  for (int32_t i = 0; i < count; ++i) {
    const Bytes sad = load(scratch.sad[i]);
    scratch.point_words[i][block] = signs(equal8(min8(sad, threshold), sad));
  }
  const Word beyond = signs(both(equal8(threshold, set8(-1)), lanes_of(pixels)));
  if (beyond == 0) return;
  for (int32_t pixel = 0; pixel < pixels; ++pixel) {
    if ((beyond >> pixel & 1) == 0) continue;
    const uint32_t exact = exact_threshold(args, x + pixel, *scratch.points, scratch.exact_sad, scratch.histogram);
    const Word bit = static_cast<Word>(Word{1} << pixel);
    for (int32_t i = 0; i < count; ++i) {
      Word& word = scratch.point_words[i][block];
      word = static_cast<Word>(scratch.exact_sad[i] <= exact ? word | bit : word & ~bit);
    }
  }
}

// Words of the next pairs, of all blocks.
BSM_NOINLINE void pair_words(MaskScratch& scratch, const uint32_t* pairs, int32_t count) {
  const uint8_t* points = reinterpret_cast<const uint8_t*>(scratch.point_words);
  for (int32_t i = 0; i < count; ++i) {
    const uint32_t pair = pairs[i];
    uint64_t p, q;
    BSM_MEMCPY(&p, points + (pair & 0xffff), sizeof p);
    BSM_MEMCPY(&q, points + (pair >> 16), sizeof q);
    const uint64_t words = p & q;
    BSM_UNROLL
    for (int32_t block = 0; block < kBlocks; ++block) {
      scratch.words[block][i] = static_cast<Word>(words >> (kLanes * block));
    }
  }
}

// The masks of the blocks from x on.
inline void store_masks(const MaskThresholdArgs& args, int32_t x, MaskScratch& scratch) {
  static constexpr int32_t kInOrder[4] = {0, 1, 2, 3};
  int32_t byte_of[kLanes / 8];
  for (int32_t i = 0; i < kLanes / 8; ++i) byte_of[i] = kInOrder[i];
  const int32_t bits = args.pattern.bits;
  const ptrdiff_t bytes = bits / 8;
  for (int32_t first = 0; first < bits; first += kWordsAtOnce) {
    const int32_t count = bits - first < kWordsAtOnce ? bits - first : kWordsAtOnce;
    pair_words(scratch, scratch.points->pairs + first, count);
    for (int32_t block = 0, begin = x; block < kBlocks && begin < args.width; ++block, begin += kLanes) {
      uint8_t* const out = args.out + begin * bytes + first / 8;
      store_descriptors<false>(scratch.words[block], count, byte_of, args.width - begin, out, bytes);
    }
  }
}

// Finds the SADs of each block of pixels, then find(scratch, pixels) their thresholds, then their masks.
template <class Find>
inline void threshold_masks(const MaskThresholdArgs& args, const Find& find) {
  MaskScratch& scratch = begin_row(args);
  for (int32_t x = 0; x < args.width; x += kLanes * kBlocks) {
    for (int32_t block = 0, begin = x; block < kBlocks && begin < args.width; ++block, begin += kLanes) {
      const int32_t pixels = args.width - begin < kLanes ? args.width - begin : kLanes;
      window_sad(args, begin, scratch);
      threshold_points(args, begin, block, pixels, find(scratch, pixels), scratch);
    }
    store_masks(args, x, scratch);
  }
}

inline void threshold_masks(const MaskThresholdArgs& args) {
  threshold_masks(args, [bits = args.pattern.bits](MaskScratch& scratch, int32_t pixels) {
    return find_threshold(scratch, bits, lanes_of(pixels));
  });
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_MASK_THRESHOLD_LANES_H
