// mask_threshold, SVE: a vector of neighbouring pixels at once, 64 at most.
// The SADs of the window's points saturate at 255. A pass tries eight thresholds: bit j of a byte says that the SAD is
// within threshold j, a pair is one AND, and carry-save adders count; two passes find most thresholds, and those from 255 on
// are found exactly, pixel by pixel. Bound, per pair, pass and vector: 6 operations, 2 loads.
#include "platform/compiler.h"

#if BSM_ARCH_SVE
#include "simd/arm/transpose_sve.h"
#include "simd/kernels.h"
#include "simd/pattern_points.h"

namespace bsm {
namespace {

constexpr int32_t kTile = 64;       // pixels, the scratch's rows: longer vectors stay partly empty
constexpr int32_t kHighLevels = 7;  // bits of a count from 64 on
constexpr int32_t kScale = kTile / 8;

struct Scratch {
  uint8_t sad[kMaxPoints * kTile];     // by point, then by pixel
  uint8_t within[kMaxPoints * kTile];  // the same, bit j: the SAD is within threshold j
  uint8_t high[kHighLevels][kTile];
  uint8_t threshold[kTile];
  uint16_t exact_sad[kMaxPoints];
  uint16_t histogram[kMaxSad + 1];
  const PatternPoints* points;
};

template <int32_t kPlanes>
void window_sad(const MaskThresholdArgs& args, int32_t x, svbool_t pixels, Scratch& scratch) {
  const uint8_t* const* rows = args.rows + args.pattern.radius;
  const ptrdiff_t stride = args.plane_stride;
  const svuint8_t l = svld1(pixels, rows[0] + x);
  const svuint8_t a = kPlanes == 3 ? svld1(pixels, rows[0] + x + stride) : l;
  const svuint8_t b = kPlanes == 3 ? svld1(pixels, rows[0] + x + 2 * stride) : l;
  for (int32_t i = 0; i < scratch.points->count; ++i) {
    const uint8_t* at = rows[scratch.points->points[i].dy] + x + scratch.points->points[i].dx;
    svuint8_t sad = svabd_x(pixels, l, svld1(pixels, at));
    if (kPlanes == 3) {
      sad = svqadd(sad, svabd_x(pixels, a, svld1(pixels, at + stride)));
      sad = svqadd(sad, svabd_x(pixels, b, svld1(pixels, at + 2 * stride)));
    }
    svst1(pixels, scratch.sad + i * kTile, sad);
  }
}

// Adds the bits a and b to a level; returns the carry.
BSM_INLINE svuint8_t add_bits(svuint8_t& level, svuint8_t a, svuint8_t b) {
  const svbool_t all = svptrue_b8();
  const svuint8_t odd = sveor_x(all, a, b);
  const svuint8_t carry = sveor_x(all, a, svand_x(all, odd, sveor_x(all, a, level)));
  level = sveor_x(all, level, odd);
  return carry;
}

BSM_INLINE svuint8_t pair_within(const Scratch& scratch, uint32_t pair, svbool_t pixels) {
  const uint8_t* within = scratch.within;
  const svuint8_t p = svld1(pixels, within + kScale * ptrdiff_t{pair & 0xffff});
  const svuint8_t q = svld1(pixels, within + kScale * ptrdiff_t{pair >> 16});
  return svand_x(pixels, p, q);
}

// Four pairs to the levels 0 and 1; returns the carry.
BSM_INLINE svuint8_t add_four(const Scratch& scratch, const uint32_t* pairs, svbool_t pixels, svuint8_t& ones,
                              svuint8_t& twos) {
  const svuint8_t a = add_bits(ones, pair_within(scratch, pairs[0], pixels), pair_within(scratch, pairs[1], pixels));
  const svuint8_t b = add_bits(ones, pair_within(scratch, pairs[2], pixels), pair_within(scratch, pairs[3], pixels));
  return add_bits(twos, a, b);
}

// Bit j of a pixel's byte: at least bits / 4 pairs are within threshold j.
BSM_NOINLINE svuint8_t enough(Scratch& scratch, int32_t bits, svbool_t pixels) {
  const svbool_t all = svptrue_b8();
  const svuint8_t zero = svdup_u8(0);
  const int32_t groups = bits / 64;
  int32_t levels = 1;
  while (groups >> levels != 0) ++levels;
  for (int32_t i = 0; i < levels; ++i) svst1(pixels, scratch.high[i], zero);
  svuint8_t ones = zero;
  svuint8_t twos = zero;
  svuint8_t fours = zero;
  svuint8_t eights = zero;
  svuint8_t sixteens = zero;
  svuint8_t thirtytwos = zero;
  const uint32_t* pairs = scratch.points->pairs;
  for (int32_t group = 0; group < groups; ++group) {
    svuint8_t half = zero;
    for (int32_t i = 0; i < 2; ++i) {
      svuint8_t quarter = zero;
      for (int32_t k = 0; k < 2; ++k, pairs += 16) {
        const svuint8_t a =
            add_bits(fours, add_four(scratch, pairs, pixels, ones, twos), add_four(scratch, pairs + 4, pixels, ones, twos));
        const svuint8_t b = add_bits(fours, add_four(scratch, pairs + 8, pixels, ones, twos),
                                     add_four(scratch, pairs + 12, pixels, ones, twos));
        const svuint8_t carry = add_bits(eights, a, b);
        quarter = k == 0 ? carry : add_bits(sixteens, quarter, carry);
      }
      half = i == 0 ? quarter : add_bits(thirtytwos, half, quarter);
    }
    for (int32_t i = 0; i < levels; ++i) {
      const svuint8_t old = svld1(pixels, scratch.high[i]);
      svst1(pixels, scratch.high[i], sveor_x(all, old, half));
      half = svand_x(all, old, half);
    }
  }
  // Compares with bits / 4 from bit 4 up: the lower bits are zero, 16 divides it.
  const uint32_t wanted = static_cast<uint32_t>(bits) / 4;
  svuint8_t result = svdup_u8(0xff);
  const auto compare = [&](uint32_t bit, svuint8_t level) {
    result = (wanted >> bit & 1u) != 0 ? svand_x(all, result, level) : svorr_x(all, result, level);
  };
  compare(4, sixteens);
  compare(5, thirtytwos);
  for (int32_t i = 0; i < levels; ++i) {
    compare(static_cast<uint32_t>(6 + i), svld1(pixels, scratch.high[i]));
  }
  return result;
}

// One pass with thresholds 1 << kShift apart: threshold j is (j + 1 << kShift) - 1 above `low`. T lies within low..high,
// both included, before and after.
template <int32_t kShift>
inline void narrow(Scratch& scratch, int32_t bits, svbool_t pixels, svuint8_t& low, svuint8_t& high) {
  constexpr uint8_t kStep = 1 << kShift;
  for (int32_t i = 0; i < scratch.points->count; ++i) {
    svuint8_t above = svqsub(svld1(pixels, scratch.sad + i * kTile), low);
    if (kShift != 0) above = svlsr_x(pixels, above, static_cast<uint8_t>(kShift));
    svst1(pixels, scratch.within + i * kTile, svlsl_x(pixels, svdup_u8(0xff), above));
  }
  const svuint8_t passed = svcnt_x(pixels, enough(scratch, bits, pixels));
  low = svqadd(low, svlsl_x(pixels, svsub_x(pixels, svdup_u8(8), passed), static_cast<uint8_t>(kShift)));
  const svuint8_t top = svmin_x(pixels, high, svqadd(low, static_cast<uint8_t>(kStep - 1)));
  high = svsel(svcmpeq(pixels, passed, uint8_t{0}), high, top);
}

// T of the pixels; 255 stands for anything from 255 up. Two passes find T below 64, where most are; each 64 more take one
// more.
inline svuint8_t find_threshold(Scratch& scratch, int32_t bits, svbool_t pixels) {
  svuint8_t low = svdup_u8(0);
  svuint8_t high = svdup_u8(255);
  for (;;) {
    const uint8_t width = svmaxv(pixels, svsub_x(pixels, high, low));
    if (width == 0) return low;
    if (width <= 7) {
      narrow<0>(scratch, bits, pixels, low, high);
    } else {
      narrow<3>(scratch, bits, pixels, low, high);
    }
  }
}

// Bits of eight pairs: both points' SADs are within the threshold.
inline svuint8_t eight_within(const Scratch& scratch, const uint32_t* pairs, svbool_t pixels, svuint8_t threshold) {
  const uint8_t* sad = scratch.sad;
  svuint8_t bits = svdup_u8(0);
  BSM_UNROLL
  for (int32_t i = 0; i < 8; ++i) {
    const svuint8_t p = svld1(pixels, sad + kScale * ptrdiff_t{pairs[i] & 0xffff});
    const svuint8_t q = svld1(pixels, sad + kScale * ptrdiff_t{pairs[i] >> 16});
    bits = svorr_m(svcmple(pixels, svmax_x(pixels, p, q), threshold), bits, static_cast<uint8_t>(1 << i));
  }
  return bits;
}

void store_masks(const Scratch& scratch, int32_t bits, svbool_t lanes, int32_t pixels, svuint8_t threshold, uint8_t* out) {
  const ptrdiff_t bytes = bits / 8;
  const int32_t half = lanes16();  // pixels of the lower half of a vector
  for (int32_t first = 0; first < bits; first += 64, out += 8) {
    const uint32_t* pairs = scratch.points->pairs + first;
    const svuint8_t b0 = eight_within(scratch, pairs, lanes, threshold);
    const svuint8_t b1 = eight_within(scratch, pairs + 8, lanes, threshold);
    const svuint8_t b2 = eight_within(scratch, pairs + 16, lanes, threshold);
    const svuint8_t b3 = eight_within(scratch, pairs + 24, lanes, threshold);
    const svuint8_t b4 = eight_within(scratch, pairs + 32, lanes, threshold);
    const svuint8_t b5 = eight_within(scratch, pairs + 40, lanes, threshold);
    const svuint8_t b6 = eight_within(scratch, pairs + 48, lanes, threshold);
    const svuint8_t b7 = eight_within(scratch, pairs + 56, lanes, threshold);
    store_quarters(svreinterpret_u16(svzip1(b0, b1)), svreinterpret_u16(svzip1(b2, b3)), svreinterpret_u16(svzip1(b4, b5)),
                   svreinterpret_u16(svzip1(b6, b7)), pixels, out, bytes);
    if (pixels <= half) continue;
    store_quarters(svreinterpret_u16(svzip2(b0, b1)), svreinterpret_u16(svzip2(b2, b3)), svreinterpret_u16(svzip2(b4, b5)),
                   svreinterpret_u16(svzip2(b6, b7)), pixels - half, out + half * bytes, bytes);
  }
}

// The mask of a pixel whose threshold a byte does not hold.
void store_exact(const MaskThresholdArgs& args, int32_t x, Scratch& scratch) {
  const uint16_t* sad = scratch.exact_sad;
  const uint32_t threshold = exact_threshold(args, x, *scratch.points, scratch.exact_sad, scratch.histogram);
  uint8_t* out = args.out + ptrdiff_t{x} * (args.pattern.bits / 8);
  for (int32_t i = 0; i < args.pattern.bits; ++i) {
    const uint32_t pair = scratch.points->pairs[i];
    const bool within = sad[(pair & 0xffff) / 8] <= threshold && sad[(pair >> 16) / 8] <= threshold;
    const uint32_t byte = i % 8 == 0 ? 0u : out[i / 8];
    out[i / 8] = static_cast<uint8_t>(byte | (within ? 1u : 0u) << i % 8);
  }
}

}  // namespace

uint64_t mask_threshold_sve_scratch(const KernelShape&) {
  return sizeof(Scratch);
}

void mask_threshold_sve(const MaskThresholdArgs& args) {
  Scratch& scratch = *static_cast<Scratch*>(args.scratch);
  const int32_t bits = args.pattern.bits;
  const int32_t tile = lanes8() < kTile ? lanes8() : kTile;
  scratch.points = &args.pattern.order->points;
  for (int32_t x = 0; x < args.width; x += tile) {
    const int32_t pixels = args.width - x < tile ? args.width - x : tile;
    const svbool_t lanes = svwhilelt_b8(int32_t{0}, pixels);
    if (args.planes == 3) {
      window_sad<3>(args, x, lanes, scratch);
    } else {
      window_sad<1>(args, x, lanes, scratch);
    }
    const svuint8_t threshold = find_threshold(scratch, bits, lanes);
    store_masks(scratch, bits, lanes, pixels, threshold, args.out + ptrdiff_t{x} * (bits / 8));
    const svbool_t beyond = svcmpeq(lanes, threshold, uint8_t{255});
    if (!svptest_any(lanes, beyond)) continue;
    svst1(lanes, scratch.threshold, threshold);
    for (int32_t i = 0; i < pixels; ++i) {
      if (scratch.threshold[i] == 255) store_exact(args, x + i, scratch);
    }
  }
}

}  // namespace bsm
#endif
