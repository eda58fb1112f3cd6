// mask_threshold, MVE: sixteen neighbouring pixels in a vector.
// SADs saturate at 255; a pair's weight is the maximum of two of them. The threshold is searched bit by bit: a pass collects
// a bit of each pair, the sign of the halved difference of threshold and weight, and counts them eight at once by a table.
// Thresholds of 255 are found exactly, pixel by pixel. Bound, for sixteen pixels and a pair: 1 operation, 1 store, and 2
// loads, 4 operations a plane; for each pass 1 load, 2 operations.
#include "platform/compiler.h"

#if BSM_ARCH_MVE
#include "simd/arm/mask_pairs.h"
#include "simd/arm/mve.h"
#include "simd/arm/population.h"
#include "simd/build.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 16;
constexpr int32_t kPairsAtOnce = 64;  // that a byte counts

using Scratch = MaskScratch<kLanes>;

// SADs of sixteen pixels and a point of each.
template <int32_t kPlanes>
inline uint8x16_t sad(const uint8x16_t (&center)[kPlanes], const uint8_t* point, ptrdiff_t stride) {
  uint8x16_t sum = vabdq_u8(center[0], vldrbq_u8(point));
  BSM_UNROLL
  for (int32_t plane = 1; plane < kPlanes; ++plane) {
    point += stride;
    sum = vqaddq_u8(sum, vabdq_u8(center[plane], vldrbq_u8(point)));
  }
  return sum;
}

template <int32_t kPlanes>
void pair_weights(const MaskThresholdArgs& args, int32_t x, const Scratch& scratch) {
  const ptrdiff_t stride = args.plane_stride;
  const uint8_t* own = args.rows[args.pattern.radius] + x;
  uint8x16_t center[kPlanes];
  for (int32_t plane = 0; plane < kPlanes; ++plane) center[plane] = vldrbq_u8(own + plane * stride);
  uint8_t* weight = scratch.weight;
  for (const PairPoints* pair = scratch.points; pair != scratch.points + scratch.bits; ++pair, weight += kLanes) {
    vstrbq_u8(weight, vmaxq_u8(sad<kPlanes>(center, pair->p + x, stride), sad<kPlanes>(center, pair->q + x, stride)));
  }
}

// Of eight pairs, bit i is set where weight i is beyond the threshold.
inline uint8x16_t beyond(const uint8_t* weight, uint8x16_t threshold) {
  uint8x16_t bits = vdupq_n_u8(0);
  BSM_UNROLL
  for (int32_t i = 0; i < 8; ++i) bits = vsriq_n_u8(vhsubq_u8(threshold, vldrbq_u8(weight + i * kLanes)), bits, 1);
  return bits;
}

// All bits set where fewer than bits / 4 weights are within the threshold.
uint8x16_t too_few(const Scratch& scratch, uint8x16_t threshold, const uint8_t* population) {
  const int32_t bits = scratch.bits;
  const uint8_t* weight = scratch.weight;
  uint16x8_t even = vdupq_n_u16(0);  // weights beyond it, of every other pixel
  uint16x8_t odd = even;
  for (int32_t i = 0; i < bits; i += kPairsAtOnce) {
    uint8x16_t count = vdupq_n_u8(0);
    for (int32_t k = 0; k < kPairsAtOnce; k += 8, weight += 8 * kLanes) {
      count = vaddq_u8(count, vldrbq_gather_offset_u8(population, beyond(weight, threshold)));
    }
    even = vaddq_u16(even, vmovlbq_u8(count));
    odd = vaddq_u16(odd, vmovltq_u8(count));
  }
  // Beyond this number too few are within; the sign of what is left tells.
  const uint16x8_t most = vdupq_n_u16(static_cast<uint16_t>(bits - bits / 4));
  const int16x8_t few_even = vshrq_n_s16(vreinterpretq_s16_u16(vsubq_u16(most, even)), 15);
  const int16x8_t few_odd = vshrq_n_s16(vreinterpretq_s16_u16(vsubq_u16(most, odd)), 15);
  return vreinterpretq_u8_s8(vmovntq_s16(vreinterpretq_s8_s16(few_even), few_odd));
}

inline uint8_t most8(uint8x16_t a) {
  return vmaxvq_u8(0, a);
}

// T of sixteen pixels; 255 stands for anything from 255 up.
uint8x16_t find_threshold(const Scratch& scratch, const uint8_t* population, int32_t* top) {
  int32_t step = 1 << *top;
  while (step < 256) {
    if (most8(too_few(scratch, vdupq_n_u8(static_cast<uint8_t>(step - 1)), population)) == 0) break;
    step = larger_step(step);
  }
  uint8x16_t threshold = vdupq_n_u8(0);
  for (step /= 2; step != 0; step /= 2) {
    const uint8x16_t tried = vaddq_n_u8(threshold, static_cast<uint8_t>(step - 1));
    const uint8x16_t few = too_few(scratch, tried, population);
    threshold = vaddq_u8(threshold, vandq_u8(few, vdupq_n_u8(static_cast<uint8_t>(step))));
  }
  *top = bits_of(most8(threshold));
  return threshold;
}

void store_masks(const Scratch& scratch, uint8x16_t threshold, uint32_t pixels, uint8_t* out) {
  const ptrdiff_t bytes = scratch.bits / 8;
  const uint16x8_t offsets = places(2 * static_cast<uint32_t>(bytes));
  const mve_pred16_t evens = vctp16q((pixels + 1) / 2);
  const mve_pred16_t odds = vctp16q(pixels / 2);
  const uint8_t* weight = scratch.weight;
  for (ptrdiff_t byte = 0; byte < bytes; byte += 2, weight += 16 * kLanes) {
    const uint16x8_t low = vreinterpretq_u16_u8(vmvnq_u8(beyond(weight, threshold)));
    const uint16x8_t high = vreinterpretq_u16_u8(vmvnq_u8(beyond(weight + 8 * kLanes, threshold)));
    uint16_t* const to = reinterpret_cast<uint16_t*>(out + byte);
    vstrhq_scatter_offset_p_u16(to, offsets, vsliq_n_u16(low, high, 8), evens);
    vstrhq_scatter_offset_p_u16(to + bytes / 2, offsets, vsriq_n_u16(high, low, 8), odds);
  }
}

}  // namespace

uint64_t mask_threshold_mve_scratch(const KernelShape& shape) {
  return kPopulationBytes + Scratch::bytes(shape.bits);
}

void mask_threshold_mve(const MaskThresholdArgs& args) {
  const uint8_t* population = make_population(args.scratch);
  const Scratch scratch = list_pairs<kLanes>(args, static_cast<uint8_t*>(args.scratch) + kPopulationBytes);
  int32_t top = 4;
  for (int32_t x = 0; x < args.width; x += kLanes) {
    const int32_t pixels = args.width - x < kLanes ? args.width - x : kLanes;
    if (kHasColor && args.planes == 3) {
      pair_weights<3>(args, x, scratch);
    } else {
      pair_weights<1>(args, x, scratch);
    }
    const uint8x16_t threshold = find_threshold(scratch, population, &top);
    store_masks(scratch, threshold, static_cast<uint32_t>(pixels), args.out + ptrdiff_t{x} * (scratch.bits / 8));
    if (most8(threshold) != 0xff) continue;
    uint8_t thresholds[kLanes];
    vstrbq_u8(thresholds, threshold);
    for (int32_t i = 0; i < pixels; ++i) {
      if (thresholds[i] == 0xff) store_exact(args, x + i, scratch);
    }
  }
}

}  // namespace bsm
#endif
