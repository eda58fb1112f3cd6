// mask_threshold, NEON: sixteen neighbouring pixels at once.
// The SADs of the window's points saturate at 255; a pair's weight is the maximum of two of them. A pass over the pairs of a
// short descriptor tries eight thresholds, mostly two passes find it; for long ones the threshold is searched bit by bit,
// 128 pixels at once. Thresholds from 255 on are found exactly, pixel by pixel. Bound for short ones, per pair and sixteen
// pixels: 4 operations and 4 loads, and for each pass 1 load, 5 operations.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "simd/arm/bit_counter.h"
#include "simd/arm/threshold_bracket.h"
#include "simd/arm/transpose.h"
#include "simd/kernels.h"
#include "simd/pattern_points.h"

namespace bsm {
namespace {

constexpr int32_t kLong = 640;  // descriptors of so many bits and more are long
constexpr int32_t kTile = 128;  // pixels at once for them
constexpr int32_t kGroups = kTile / kLanes;

constexpr int32_t kEvenPoints = kMaxPoints + 1;  // two at once

struct ShortScratch {
  uint8_t sad[kEvenPoints * kLanes];  // by point, then by pixel
  uint8_t weight[kLong * kLanes];     // by pair, then by pixel
};

struct LongScratch {
  uint8_t sad[kEvenPoints * kTile];     // by point, then by pixel
  uint8_t within[kMaxPoints * kLanes];  // by point, a bit for each pixel: bit g of byte i for pixel i of group g
  uint8_t octets[8][kGroups][kLanes];   // by byte of 64 pairs, then by group
};

struct Scratch {
  uint16_t exact_sad[kMaxPoints];
  uint16_t histogram[kMaxSad + 1];
  const PatternPoints* points;
  const uint8_t* point[kEvenPoints];  // first plane of each point, at x = 0
  uint16_t pairs[2 * BSM_MAX_BITS];   // bytes from the first vector of the points to those of p and q
  HighLevels high;
  union {
    ShortScratch few;
    LongScratch many;
  };
};

// The pattern's points and pairs as the loops below take them.
void list_points(const MaskThresholdArgs& args, Scratch& scratch) {
  scratch.points = &args.pattern.order->points;
  const uint8_t* const* rows = args.rows + args.pattern.radius;
  for (int32_t i = 0; i < scratch.points->count; ++i) {
    scratch.point[i] = rows[scratch.points->points[i].dy] + scratch.points->points[i].dx;
  }
  scratch.point[scratch.points->count] = scratch.point[0];
  static_assert(kLanes == 2 * 8, "the numbers of points are 8 apart");
  for (int32_t i = 0; i < args.pattern.bits; i += 4) {
    vst1q_u16(scratch.pairs + 2 * i, vshlq_n_u16(vreinterpretq_u16_u32(vld1q_u32(scratch.points->pairs + i)), 1));
  }
}

template <int32_t kPlanes>
inline uint8x16_t sad_at(const uint8_t* point, const ptrdiff_t (&offset)[kPlanes], const uint8x16_t (&center)[kPlanes]) {
  uint8x16_t sum = vabdq_u8(center[0], vld1q_u8(point + offset[0]));
  BSM_UNROLL
  for (int32_t i = 1; i < kPlanes; ++i) sum = vqaddq_u8(sum, vabdq_u8(center[i], vld1q_u8(point + offset[i])));
  return sum;
}

// SADs of sixteen pixels and their neighbours at all points, `row` bytes apart in sad; of one more when their number is odd.
template <int32_t kPlanes, ptrdiff_t kRow>
inline void window_sad(const MaskThresholdArgs& args, int32_t x, const Scratch& scratch, uint8_t* sad) {
  const uint8_t* own = args.rows[args.pattern.radius];
  ptrdiff_t offset[kPlanes];
  uint8x16_t center[kPlanes];
  for (int32_t i = 0; i < kPlanes; ++i) {
    offset[i] = x + i * args.plane_stride;
    center[i] = vld1q_u8(own + offset[i]);
  }
  const uint8_t* const* point = scratch.point;
  const uint8_t* const* const end = point + scratch.points->count;
  for (; point < end; point += 2, sad += 2 * kRow) {
    const uint8x16_t first = sad_at<kPlanes>(point[0], offset, center);
    const uint8x16_t second = sad_at<kPlanes>(point[1], offset, center);
    vst1q_u8(sad, first);
    vst1q_u8(sad + kRow, second);
  }
}

template <ptrdiff_t kRow>
inline void window_sad(const MaskThresholdArgs& args, int32_t x, const Scratch& scratch, uint8_t* sad) {
  return args.planes == 3 ? window_sad<3, kRow>(args, x, scratch, sad) : window_sad<1, kRow>(args, x, scratch, sad);
}

// Pairs of short descriptors as a pass of the search takes them: a bit for each of eight thresholds. The first pass makes
// their weights.
struct NewWeights {
  const uint8_t* sad;
  const uint16_t* pairs;
  uint8_t* weights;
  Table16 table;
  BSM_INLINE uint8x16_t operator()(int32_t i) const {
    const uint8x16_t weight = vmaxq_u8(vld1q_u8(sad + pairs[2 * i]), vld1q_u8(sad + pairs[2 * i + 1]));
    vst1q_u8(weights + i * kLanes, weight);
    return look_up(table, vshrq_n_u8(weight, kFirstShift));
  }
};

template <int32_t kShift>
struct OldWeights {
  const uint8_t* weights;
  uint8x16_t low;
  Table16 table;
  BSM_INLINE uint8x16_t operator()(int32_t i) const {
    const uint8x16_t above = vqsubq_u8(vld1q_u8(weights + i * kLanes), low);
    return look_up(table, kShift == 0 ? above : vshrq_n_u8(above, kShift == 0 ? 1 : kShift));
  }
};

template <int32_t kShift>
BSM_NOINLINE uint8x16_t passed_above(Scratch& scratch, int32_t bits, uint8x16_t low) {
  const Table16 table = load_table16(kShift == 4 ? kEverySecond.within : kEvery.within);
  return enough(OldWeights<kShift>{scratch.few.weight, low, table}, bits, scratch.high);
}

// T of sixteen pixels; 255 stands for anything from 255 up. Only the pixels whose bytes in `wanted` are set count.
inline uint8x16_t find_threshold(Scratch& scratch, int32_t bits, uint8x16_t wanted) {
  const NewWeights weights{scratch.few.sad, scratch.pairs, scratch.few.weight, load_table16(kFirst.within)};
  Bracket bracket = first_bracket(enough(weights, bits, scratch.high));
  for (;;) {
    const uint8_t width = most8(vandq_u8(vsubq_u8(bracket.high, bracket.low), wanted));
    if (width == 0) return bracket.low;
    if (width <= 16) {
      narrow<0>(passed_above<0>(scratch, bits, bracket.low), bracket);
    } else if (width <= 35) {
      narrow<2>(passed_above<2>(scratch, bits, bracket.low), bracket);
    } else {
      narrow<4>(passed_above<4>(scratch, bits, bracket.low), bracket);
    }
  }
}

BSM_NOINLINE void store_masks(const Scratch& scratch, int32_t bits, uint8x16_t threshold, int32_t pixels, uint8_t* out) {
  const ptrdiff_t bytes = bits / 8;
  const uint8_t* weight = scratch.few.weight;
  for (ptrdiff_t byte = 0; byte < bytes; byte += 8) {
    uint8x16_t octets[8];
    BSM_UNROLL
    for (int32_t i = 0; i < 8; ++i, weight += 8 * kLanes) {
      uint8x16_t within[8];
      BSM_UNROLL
      for (int32_t k = 0; k < 8; ++k) within[k] = vcleq_u8(vld1q_u8(weight + k * kLanes), threshold);
      octets[i] = gather_bits(within);
    }
    store_octets(octets, pixels, out + byte, bytes);
  }
}

// The mask of a pixel whose threshold a byte does not hold.
void store_exact(const MaskThresholdArgs& args, int32_t x, Scratch& scratch) {
  const uint16_t* sad = scratch.exact_sad;
  const uint32_t threshold = exact_threshold(args, x, *scratch.points, scratch.exact_sad, scratch.histogram);
  const uint32_t* pairs = scratch.points->pairs;
  uint8_t* out = args.out + ptrdiff_t{x} * (args.pattern.bits / 8);
  for (int32_t byte = 0; byte < args.pattern.bits / 8; ++byte) {
    uint32_t bits = 0;
    for (uint32_t i = 0; i < 8; ++i, ++pairs) {
      const bool within = sad[(*pairs & 0xffff) / 8] <= threshold && sad[(*pairs >> 16) / 8] <= threshold;
      bits |= (within ? 1u : 0u) << i;
    }
    out[byte] = static_cast<uint8_t>(bits);
  }
}

// The masks of those of sixteen pixels whose threshold a byte does not hold.
void store_beyond(const MaskThresholdArgs& args, int32_t x, int32_t pixels, uint8x16_t threshold, Scratch& scratch) {
  if (most8(threshold) != 255) return;
  uint8_t thresholds[kLanes];
  vst1q_u8(thresholds, threshold);
  for (int32_t i = 0; i < kLanes && i < pixels; ++i) {
    if (thresholds[i] == 255) store_exact(args, x + i, scratch);
  }
}

// A bit for each of 128 pixels, for all points: the SAD is within the pixel's threshold.
void find_within(Scratch& scratch, const uint8x16_t (&threshold)[kGroups]) {
  const uint8_t* sad = scratch.many.sad;
  uint8_t* within = scratch.many.within;
  const int32_t count = scratch.points->count;
  uint8x16_t most[kGroups];  // in registers: stores of bytes may change what lies in memory
  BSM_UNROLL
  for (int32_t g = 0; g < kGroups; ++g) most[g] = threshold[g];
  for (int32_t i = 0; i < count; ++i, sad += kTile, within += kLanes) {
    uint8x16_t group[kGroups];
    BSM_UNROLL
    for (int32_t g = 0; g < kGroups; ++g) group[g] = vcleq_u8(vld1q_u8(sad + g * kLanes), most[g]);
    vst1q_u8(within, gather_bits(group));
  }
}

inline uint8x16_t pair_within(const uint8_t* within, const uint16_t* pair) {
  return vandq_u8(vld1q_u8(within + pair[0]), vld1q_u8(within + pair[1]));
}

// Pairs of long descriptors: a bit for each of 128 pixels.
struct WithinPairs {
  const uint8_t* within;
  const uint16_t* pairs;
  BSM_INLINE uint8x16_t operator()(int32_t i) const { return pair_within(within, pairs + 2 * i); }
};

BSM_NOINLINE uint8x16_t enough_within(Scratch& scratch, int32_t bits) {
  return enough(WithinPairs{scratch.many.within, scratch.pairs}, bits, scratch.high);
}

// T of 128 pixels, as find_threshold.
void find_thresholds(Scratch& scratch, int32_t bits, uint8x16_t (&threshold)[kGroups]) {
  for (uint8x16_t& t : threshold) t = vdupq_n_u8(0);
  for (int32_t step = 128; step != 0; step /= 2) {
    const uint8x16_t below = vdupq_n_u8(static_cast<uint8_t>(step - 1));
    uint8x16_t tested[kGroups];
    for (int32_t g = 0; g < kGroups; ++g) tested[g] = vaddq_u8(threshold[g], below);
    find_within(scratch, tested);
    const uint8x16_t passed = enough_within(scratch, bits);
    for (int32_t g = 0; g < kGroups; ++g) {
      const uint8x16_t is_enough = vtstq_u8(passed, vdupq_n_u8(static_cast<uint8_t>(1 << g)));
      threshold[g] = vaddq_u8(threshold[g], vbicq_u8(vdupq_n_u8(static_cast<uint8_t>(step)), is_enough));
    }
  }
}

// Swaps the blocks of kShift bits above the diagonal of a with those below that of b; `kept` are the lower ones.
template <int32_t kShift>
inline void swap_blocks(uint8x16_t& a, uint8x16_t& b, uint8x16_t kept) {
  const uint8x16_t low = vbslq_u8(kept, a, vshlq_n_u8(b, kShift));
  b = vbslq_u8(kept, vshrq_n_u8(a, kShift), b);
  a = low;
}

// Bit i of byte j of v[k] becomes bit k of byte j of v[i].
inline void transpose_bits(uint8x16_t (&v)[8]) {
  BSM_UNROLL
  for (int32_t i = 0; i < 4; ++i) {
    const uint8x16_t low = vsliq_n_u8(v[i], v[i + 4], 4);
    v[i + 4] = vsriq_n_u8(v[i + 4], v[i], 4);
    v[i] = low;
  }
  BSM_UNROLL
  for (int32_t i = 0; i < 8; i += 4) {
    swap_blocks<2>(v[i], v[i + 2], vdupq_n_u8(0x33));
    swap_blocks<2>(v[i + 1], v[i + 3], vdupq_n_u8(0x33));
  }
  BSM_UNROLL
  for (int32_t i = 0; i < 8; i += 2) swap_blocks<1>(v[i], v[i + 1], vdupq_n_u8(0x55));
}

// The masks of up to 128 pixels from the bits of the points.
BSM_NOINLINE void store_tile(Scratch& scratch, int32_t bits, int32_t pixels, uint8_t* out) {
  const ptrdiff_t bytes = bits / 8;
  const uint8_t* within = scratch.many.within;
  for (int32_t first = 0; first < bits; first += 64) {
    for (int32_t byte = 0; byte < 8; ++byte) {
      uint8x16_t words[8];
      BSM_UNROLL
      for (int32_t i = 0; i < 8; ++i) words[i] = pair_within(within, scratch.pairs + 2 * (first + 8 * byte + i));
      transpose_bits(words);
      BSM_UNROLL
      for (int32_t g = 0; g < kGroups; ++g) vst1q_u8(scratch.many.octets[byte][g], words[g]);
    }
    for (int32_t x = 0; x < pixels; x += kLanes) {
      uint8x16_t octets[8];
      BSM_UNROLL
      for (int32_t byte = 0; byte < 8; ++byte) octets[byte] = vld1q_u8(scratch.many.octets[byte][x / kLanes]);
      store_octets(octets, pixels - x, out + x * bytes + first / 8, bytes);
    }
  }
}

void threshold_short(const MaskThresholdArgs& args, Scratch& scratch) {
  const int32_t bits = args.pattern.bits;
  for (int32_t x = 0; x < args.width; x += kLanes) {
    const int32_t pixels = args.width - x < kLanes ? args.width - x : kLanes;
    window_sad<kLanes>(args, x, scratch, scratch.few.sad);
    const uint8x16_t threshold = find_threshold(scratch, bits, first_lanes(pixels));
    store_masks(scratch, bits, threshold, pixels, args.out + ptrdiff_t{x} * (bits / 8));
    store_beyond(args, x, pixels, threshold, scratch);
  }
}

void threshold_long(const MaskThresholdArgs& args, Scratch& scratch) {
  const int32_t bits = args.pattern.bits;
  BSM_MEMSET(scratch.many.sad, 0, sizeof scratch.many.sad);  // of groups beyond the row
  for (int32_t x = 0; x < args.width; x += kTile) {
    const int32_t pixels = args.width - x < kTile ? args.width - x : kTile;
    const int32_t groups = (pixels + kLanes - 1) / kLanes;
    for (int32_t g = 0; g < groups; ++g) {
      window_sad<kTile>(args, x + g * kLanes, scratch, scratch.many.sad + g * kLanes);
    }
    uint8x16_t threshold[kGroups];
    find_thresholds(scratch, bits, threshold);
    find_within(scratch, threshold);
    store_tile(scratch, bits, pixels, args.out + ptrdiff_t{x} * (bits / 8));
    for (int32_t g = 0; g < groups; ++g) store_beyond(args, x + g * kLanes, pixels - g * kLanes, threshold[g], scratch);
  }
}

}  // namespace

uint64_t mask_threshold_neon_scratch(const KernelShape& shape) {
  return shape.bits < kLong ? offsetof(Scratch, few) + sizeof(ShortScratch) : sizeof(Scratch);
}

void mask_threshold_neon(const MaskThresholdArgs& args) {
  Scratch& scratch = *static_cast<Scratch*>(args.scratch);
  list_points(args, scratch);
  if (args.pattern.bits < kLong) {
    threshold_short(args, scratch);
  } else {
    threshold_long(args, scratch);
  }
}

}  // namespace bsm
#endif
