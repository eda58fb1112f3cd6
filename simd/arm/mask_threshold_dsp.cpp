// mask_threshold, DSP: four neighbouring pixels in a register.
// SADs saturate at 255; a pair's weight is the maximum of two of them. The threshold is searched bit by bit: a pass counts
// the pairs beyond a threshold. Thresholds of 255 are found exactly, pixel by pixel. Bound, for four pixels and a pair: 2
// loads, 2 operations, and 2 loads, 8 operations a plane; for each pass 1 load, 3 operations.
#include "platform/compiler.h"

#if BSM_ARCH_DSP
#include "simd/arm/dsp.h"
#include "simd/arm/mask_pairs.h"
#include "simd/build.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 4;
constexpr int32_t kPairsAtOnce = 64;  // that a byte counts

using Scratch = MaskScratch<kLanes>;

// SADs of four pixels and a point of each.
template <int32_t kPlanes>
inline uint32_t sad(const uint32_t (&center)[kPlanes], const uint8_t* point, ptrdiff_t stride) {
  uint32_t sum = distance8(center[0], load32(point));
  BSM_UNROLL
  for (int32_t plane = 1; plane < kPlanes; ++plane) {
    point += stride;
    sum = __uqadd8(sum, distance8(center[plane], load32(point)));
  }
  return sum;
}

template <int32_t kPlanes>
void pair_weights(const MaskThresholdArgs& args, int32_t x, const Scratch& scratch) {
  const ptrdiff_t stride = args.plane_stride;
  const uint8_t* own = args.rows[args.pattern.radius] + x;
  uint32_t center[kPlanes];
  for (int32_t plane = 0; plane < kPlanes; ++plane) center[plane] = load32(own + plane * stride);
  uint32_t* weight = reinterpret_cast<uint32_t*>(scratch.weight);
  for (const PairPoints* pair = scratch.points; pair != scratch.points + scratch.bits; ++pair) {
    *weight++ = most8(sad<kPlanes>(center, pair->p + x, stride), sad<kPlanes>(center, pair->q + x, stride));
  }
}

// All bits set in the bytes where fewer than bits / 4 weights are within the threshold.
BSM_NOINLINE uint32_t too_few(const Scratch& scratch, uint32_t threshold) {
  const int32_t bits = scratch.bits;
  const uint32_t* weight = reinterpret_cast<const uint32_t*>(scratch.weight);
  uint32_t even = 0;  // weights beyond it, of pixels 0 and 2
  uint32_t odd = 0;   // and 1 and 3
  for (const uint32_t* const end = weight + bits; weight != end;) {
    uint32_t beyond = 0;
    for (const uint32_t* const part = weight + kPairsAtOnce; weight != part; weight += 8) {
      BSM_UNROLL
      for (int32_t i = 0; i < 8; ++i) beyond += (__uhsub8(threshold, weight[i]) & kByteSigns) >> 7;
    }
    even = add_even_bytes(even, beyond);
    odd = add_even_bytes(odd, beyond >> 8);
  }
  const uint32_t least = twice(static_cast<uint32_t>(bits - bits / 4 + 1));  // beyond it, so that too few are within
  __usub16(even, least);
  even = __sel(0x00ff00ff, 0);
  __usub16(odd, least);
  return even | __sel(0xff00ff00, 0);
}

uint32_t most_byte(uint32_t word) {
  uint32_t most = most8(word, word >> 16);
  most = most8(most, most >> 8);
  return most & 0xff;
}

// T of four pixels; 255 stands for anything from 255 up.
uint32_t find_threshold(const Scratch& scratch, int32_t* top) {
  int32_t step = 1 << *top;
  while (step < 256 && too_few(scratch, four_times(static_cast<uint32_t>(step - 1))) != 0) step = larger_step(step);
  uint32_t threshold = 0;
  for (step /= 2; step != 0; step /= 2) {
    const uint32_t few = too_few(scratch, threshold + four_times(static_cast<uint32_t>(step - 1)));
    threshold += few & four_times(static_cast<uint32_t>(step));
  }
  *top = bits_of(most_byte(threshold));
  return threshold;
}

void store_masks(const Scratch& scratch, uint32_t threshold, int32_t pixels, uint8_t* out) {
  const uint32_t* weight = reinterpret_cast<const uint32_t*>(scratch.weight);
  const ptrdiff_t bytes = scratch.bits / 8;
  for (uint8_t* const end = out + bytes; out != end; ++out, weight += 8) {
    uint32_t beyond = 0;
    BSM_UNROLL
    for (int32_t i = 0; i < 8; ++i) beyond = beyond >> 1 | (__uhsub8(threshold, weight[i]) & kByteSigns);
    uint32_t within = ~beyond;
    uint8_t* to = out;
    for (int32_t i = 0; i < pixels; ++i, within >>= 8, to += bytes) *to = static_cast<uint8_t>(within);
  }
}

}  // namespace

uint64_t mask_threshold_dsp_scratch(const KernelShape& shape) {
  return Scratch::bytes(shape.bits);
}

void mask_threshold_dsp(const MaskThresholdArgs& args) {
  const Scratch scratch = list_pairs<kLanes>(args, args.scratch);
  int32_t top = 4;
  for (int32_t x = 0; x < args.width; x += kLanes) {
    const int32_t pixels = args.width - x < kLanes ? args.width - x : kLanes;
    if (kHasColor && args.planes == 3) {
      pair_weights<3>(args, x, scratch);
    } else {
      pair_weights<1>(args, x, scratch);
    }
    uint32_t threshold = find_threshold(scratch, &top);
    store_masks(scratch, threshold, pixels, args.out + ptrdiff_t{x} * (scratch.bits / 8));
    for (int32_t i = 0; i < pixels; ++i, threshold >>= 8) {
      if ((threshold & 0xff) == 0xff) store_exact(args, x + i, scratch);
    }
  }
}

}  // namespace bsm
#endif
