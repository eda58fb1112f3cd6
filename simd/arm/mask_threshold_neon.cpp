// mask_threshold, NEON: sixteen neighbouring pixels at once.
// The SADs of the window's points saturate at 255; a pair's weight is the maximum of two of them. The threshold is searched
// bit by bit: a pass counts the pairs within a threshold. Thresholds from 255 on are found exactly, pixel by pixel. Bound,
// per pair and sixteen pixels: 4 operations and 4 loads, and for each pass 1 load, 1 compare, 1 addition.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "simd/arm/transpose.h"
#include "simd/kernels.h"
#include "simd/pattern_points.h"

namespace bsm {
namespace {

constexpr int32_t kPairsAtOnce = 64;  // that a lane of bytes counts
constexpr int32_t kLong = 640;        // descriptors of so many bits and more are long
constexpr int32_t kTile = 128;        // pixels at once for them
constexpr int32_t kGroups = kTile / kLanes;
constexpr int32_t kHighLevels = 7;  // bits of a count from 64 on

struct ShortScratch {
  uint8_t sad[kMaxPoints][kLanes];
  uint8_t weight[kLong][kLanes];
};

struct LongScratch {
  uint8_t sad[kMaxPoints][kTile];
  uint8_t within[kMaxPoints][kLanes];  // a bit for each pixel: bit g of byte i for pixel i of group g
  uint8_t octets[8][kGroups][kLanes];  // by byte of 64 pairs, then by group
  uint8_t high[kHighLevels][kLanes];
};

struct Scratch {
  uint16_t exact_sad[kMaxPoints];
  uint16_t histogram[kMaxSad + 1];
  PatternPoints points;
  const uint8_t* point[kMaxPoints];  // first plane of each point, at x = 0
  uint16_t pairs[BSM_MAX_BITS][2];   // bytes from the first vector of the points to those of p and q
  union {
    ShortScratch few;
    LongScratch many;
  };
};

// The pattern's points and pairs as the loops below take them.
void list_points(const MaskThresholdArgs& args, Scratch& scratch) {
  number_points(args.pattern, scratch.points);
  const uint8_t* const* rows = args.rows + args.pattern.radius;
  for (int32_t i = 0; i < scratch.points.count; ++i) {
    scratch.point[i] = rows[scratch.points.points[i].dy] + scratch.points.points[i].dx;
  }
  constexpr uint32_t kScale = kLanes / 8;  // the numbers of points are 8 apart
  for (int32_t i = 0; i < args.pattern.bits; ++i) {
    scratch.pairs[i][0] = static_cast<uint16_t>(kScale * (scratch.points.pairs[i] & 0xffff));
    scratch.pairs[i][1] = static_cast<uint16_t>(kScale * (scratch.points.pairs[i] >> 16));
  }
}

// SADs of sixteen pixels and their neighbours at all points, `row` bytes apart in sad.
template <int32_t kPlanes, ptrdiff_t kRow>
inline void window_sad(const MaskThresholdArgs& args, int32_t x, const Scratch& scratch, uint8_t* sad) {
  const uint8_t* own = args.rows[args.pattern.radius] + x;
  const ptrdiff_t stride = args.plane_stride;
  uint8x16_t center[kPlanes];
  for (int32_t i = 0; i < kPlanes; ++i) center[i] = vld1q_u8(own + i * stride);
  const int32_t count = scratch.points.count;
  for (int32_t i = 0; i < count; ++i, sad += kRow) {
    const uint8_t* at = scratch.point[i] + x;
    uint8x16_t sum = vabdq_u8(center[0], vld1q_u8(at));
    BSM_UNROLL
    for (int32_t plane = 1; plane < kPlanes; ++plane) {
      sum = vqaddq_u8(sum, vabdq_u8(center[plane], vld1q_u8(at + plane * stride)));
    }
    vst1q_u8(sad, sum);
  }
}

template <ptrdiff_t kRow>
inline void window_sad(const MaskThresholdArgs& args, int32_t x, const Scratch& scratch, uint8_t* sad) {
  return args.planes == 3 ? window_sad<3, kRow>(args, x, scratch, sad) : window_sad<1, kRow>(args, x, scratch, sad);
}

inline void pair_weights(Scratch& scratch, int32_t bits) {
  const uint8_t* sad = scratch.few.sad[0];
  const uint16_t* pair = scratch.pairs[0];
  uint8_t* weight = scratch.few.weight[0];
  uint8_t* const end = weight + bits * kLanes;
  for (; weight != end; weight += 8 * kLanes, pair += 16) {
    BSM_UNROLL
    for (int32_t i = 0; i < 8; ++i) {
      vst1q_u8(weight + i * kLanes, vmaxq_u8(vld1q_u8(sad + pair[2 * i]), vld1q_u8(sad + pair[2 * i + 1])));
    }
  }
}

// Where fewer than bits / 4 weights are within the threshold.
inline uint8x16_t too_few(const Scratch& scratch, int32_t bits, uint8x16_t threshold) {
  uint16x8_t low = vdupq_n_u16(0);
  uint16x8_t high = low;
  for (int32_t first = 0; first < bits; first += kPairsAtOnce) {
    uint8x16_t count = vdupq_n_u8(0);  // less the pairs
    const uint8_t* weights = scratch.few.weight[first];
    for (int32_t i = 0; i < kPairsAtOnce; i += 16, weights += 16 * kLanes) {
      BSM_UNROLL
      for (int32_t k = 0; k < 16; ++k) count = vaddq_u8(count, vcleq_u8(vld1q_u8(weights + k * kLanes), threshold));
    }
    const uint8x16_t pairs = vsubq_u8(vdupq_n_u8(0), count);
    low = vaddw_u8(low, vget_low_u8(pairs));
    high = vaddw_u8(high, vget_high_u8(pairs));
  }
  const uint16x8_t wanted = vdupq_n_u16(static_cast<uint16_t>(bits / 4));
  return vcombine_u8(vmovn_u16(vcltq_u16(low, wanted)), vmovn_u16(vcltq_u16(high, wanted)));
}

// Where a search for thresholds begins: with a step of 1 << bits when all thresholds lie below it. The bits that the last
// pixels needed are tried first.
inline int32_t larger_step(int32_t step) {
  return step <= 64 ? 4 * step : 256;
}

inline int32_t bits_of(uint8_t most) {
  int32_t bits = 3;
  while (most >> bits != 0) ++bits;
  return bits;
}

// T of sixteen pixels; 255 stands for anything from 255 up.
inline uint8x16_t find_threshold(const Scratch& scratch, int32_t bits, int32_t* top) {
  int32_t step = 1 << *top;
  while (step < 256 && most8(too_few(scratch, bits, vdupq_n_u8(static_cast<uint8_t>(step - 1)))) != 0) {
    step = larger_step(step);
  }
  uint8x16_t threshold = vdupq_n_u8(0);
  for (step /= 2; step != 0; step /= 2) {
    const uint8x16_t few = too_few(scratch, bits, vaddq_u8(threshold, vdupq_n_u8(static_cast<uint8_t>(step - 1))));
    threshold = vaddq_u8(threshold, vandq_u8(few, vdupq_n_u8(static_cast<uint8_t>(step))));
  }
  *top = bits_of(most8(threshold));
  return threshold;
}

BSM_NOINLINE void store_masks(const Scratch& scratch, int32_t bits, uint8x16_t threshold, int32_t pixels, uint8_t* out) {
  const ptrdiff_t bytes = bits / 8;
  for (ptrdiff_t byte = 0; byte < bytes; byte += 8) {
    uint8x16_t octets[8];
    BSM_UNROLL
    for (int32_t i = 0; i < 8; ++i) {
      uint8x16_t within[8];
      BSM_UNROLL
      for (int32_t k = 0; k < 8; ++k) within[k] = vcleq_u8(vld1q_u8(scratch.few.weight[8 * (byte + i) + k]), threshold);
      octets[i] = gather_bits(within);
    }
    store_octets(octets, pixels, out + byte, bytes);
  }
}

// The mask of a pixel whose threshold a byte does not hold.
void store_exact(const MaskThresholdArgs& args, int32_t x, Scratch& scratch) {
  const uint16_t* sad = scratch.exact_sad;
  const uint32_t threshold = exact_threshold(args, x, scratch.points, scratch.exact_sad, scratch.histogram);
  const uint32_t* pairs = scratch.points.pairs;
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
  const uint8_t* sad = scratch.many.sad[0];
  uint8_t* within = scratch.many.within[0];
  const int32_t count = scratch.points.count;
  for (int32_t i = 0; i < count; ++i, sad += kTile, within += kLanes) {
    uint8x16_t group[kGroups];
    BSM_UNROLL
    for (int32_t g = 0; g < kGroups; ++g) group[g] = vcleq_u8(vld1q_u8(sad + g * kLanes), threshold[g]);
    vst1q_u8(within, gather_bits(group));
  }
}

struct Counter {
  uint8x16_t level[6];  // bits 0..5 of 128 counts
};

// Adds the bits a and b to a level; returns the carry.
template <int32_t kLevel>
inline uint8x16_t add_bits(Counter& counter, uint8x16_t a, uint8x16_t b) {
  const uint8x16_t old = counter.level[kLevel];
  const uint8x16_t odd = veorq_u8(a, b);
  counter.level[kLevel] = veorq_u8(old, odd);
  return vbslq_u8(odd, old, a);
}

inline uint8x16_t pair_within(const uint8_t* within, const uint16_t* pair) {
  return vandq_u8(vld1q_u8(within + pair[0]), vld1q_u8(within + pair[1]));
}

// Counts the next 2 << kLevel pairs; returns the carry.
template <int32_t kLevel>
inline uint8x16_t add_pairs(Counter& counter, const uint8_t* within, const uint16_t* pairs) {
  if constexpr (kLevel == 0) {
    return add_bits<0>(counter, pair_within(within, pairs), pair_within(within, pairs + 2));
  } else {
    const uint8x16_t a = add_pairs<kLevel - 1>(counter, within, pairs);
    const uint8x16_t b = add_pairs<kLevel - 1>(counter, within, pairs + (2 << kLevel));
    return add_bits<kLevel>(counter, a, b);
  }
}

// A bit for each pixel: at least bits / 4 pairs are within.
uint8x16_t enough(Scratch& scratch, int32_t bits) {
  const uint8_t* within = scratch.many.within[0];
  Counter counter;
  BSM_UNROLL
  for (int32_t i = 0; i < 6; ++i) counter.level[i] = vdupq_n_u8(0);
  for (uint8_t(&level)[kLanes] : scratch.many.high) vst1q_u8(level, vdupq_n_u8(0));
  for (int32_t first = 0; first < bits; first += 64) {
    uint8x16_t carry = add_pairs<5>(counter, within, scratch.pairs[first]);
    for (uint8_t(&level)[kLanes] : scratch.many.high) {
      const uint8x16_t old = vld1q_u8(level);
      vst1q_u8(level, veorq_u8(old, carry));
      carry = vandq_u8(old, carry);
    }
  }
  // Compares with bits / 4 from the lowest bit up.
  const uint32_t wanted = static_cast<uint32_t>(bits) / 4;
  uint8x16_t result = vdupq_n_u8(255);
  BSM_UNROLL
  for (int32_t i = 0; i < 6; ++i) {
    result = (wanted >> i & 1u) != 0 ? vandq_u8(result, counter.level[i]) : vorrq_u8(result, counter.level[i]);
  }
  for (int32_t i = 0; i < kHighLevels; ++i) {
    const uint8x16_t level = vld1q_u8(scratch.many.high[i]);
    result = (wanted >> (6 + i) & 1u) != 0 ? vandq_u8(result, level) : vorrq_u8(result, level);
  }
  return result;
}

// True when all pixels of the groups have enough pairs within the threshold.
bool all_enough(Scratch& scratch, int32_t bits, int32_t groups, uint8_t tested) {
  uint8x16_t threshold[kGroups];
  for (uint8x16_t& t : threshold) t = vdupq_n_u8(tested);
  find_within(scratch, threshold);
  const uint8x16_t others = vdupq_n_u8(static_cast<uint8_t>(0xff << groups));
  return least8(vorrq_u8(enough(scratch, bits), others)) == 255;
}

// T of 128 pixels, as find_threshold. Groups from `groups` on do not count.
void find_thresholds(Scratch& scratch, int32_t bits, int32_t groups, int32_t* top, uint8x16_t (&threshold)[kGroups]) {
  int32_t step = 1 << *top;
  while (step < 256 && !all_enough(scratch, bits, groups, static_cast<uint8_t>(step - 1))) step = larger_step(step);
  for (uint8x16_t& t : threshold) t = vdupq_n_u8(0);
  for (step /= 2; step != 0; step /= 2) {
    const uint8x16_t below = vdupq_n_u8(static_cast<uint8_t>(step - 1));
    uint8x16_t tested[kGroups];
    for (int32_t g = 0; g < kGroups; ++g) tested[g] = vaddq_u8(threshold[g], below);
    find_within(scratch, tested);
    const uint8x16_t passed = enough(scratch, bits);
    for (int32_t g = 0; g < kGroups; ++g) {
      const uint8x16_t is_enough = vtstq_u8(passed, vdupq_n_u8(static_cast<uint8_t>(1 << g)));
      threshold[g] = vaddq_u8(threshold[g], vbicq_u8(vdupq_n_u8(static_cast<uint8_t>(step)), is_enough));
    }
  }
  uint8x16_t most = threshold[0];
  for (int32_t g = 1; g < groups; ++g) most = vmaxq_u8(most, threshold[g]);
  *top = bits_of(most8(most));
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
  const uint8_t* within = scratch.many.within[0];
  for (int32_t first = 0; first < bits; first += 64) {
    for (int32_t byte = 0; byte < 8; ++byte) {
      uint8x16_t words[8];
      BSM_UNROLL
      for (int32_t i = 0; i < 8; ++i) words[i] = pair_within(within, scratch.pairs[first + 8 * byte + i]);
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
  int32_t top = 5;
  for (int32_t x = 0; x < args.width; x += kLanes) {
    const int32_t pixels = args.width - x < kLanes ? args.width - x : kLanes;
    window_sad<kLanes>(args, x, scratch, scratch.few.sad[0]);
    pair_weights(scratch, bits);
    const uint8x16_t threshold = find_threshold(scratch, bits, &top);
    store_masks(scratch, bits, threshold, pixels, args.out + ptrdiff_t{x} * (bits / 8));
    store_beyond(args, x, pixels, threshold, scratch);
  }
}

void threshold_long(const MaskThresholdArgs& args, Scratch& scratch) {
  const int32_t bits = args.pattern.bits;
  int32_t top = 5;
  BSM_MEMSET(scratch.many.sad, 0, sizeof scratch.many.sad);  // of groups beyond the row
  for (int32_t x = 0; x < args.width; x += kTile) {
    const int32_t pixels = args.width - x < kTile ? args.width - x : kTile;
    const int32_t groups = (pixels + kLanes - 1) / kLanes;
    for (int32_t g = 0; g < groups; ++g) {
      window_sad<kTile>(args, x + g * kLanes, scratch, scratch.many.sad[0] + g * kLanes);
    }
    uint8x16_t threshold[kGroups];
    find_thresholds(scratch, bits, groups, &top, threshold);
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
