// median_weighted, DSP: weights tap by tap, by tables; their sums by two taps in a register. From a pixel's own level the
// search goes from one level of its window to the next.
// Bound, per tap: 3 loads and 2 operations, and 1 load and 2 operations a plane, for the weight; 1 load and 4 operations for
// the sums; 2 loads and 5 operations for each step of the search.
#include "platform/compiler.h"

#if BSM_ARCH_DSP
#include "simd/arm/dsp.h"
#include "simd/build.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kMostSide = 2 * kMaxMedianRadius + 1;
constexpr int32_t kMostTaps = (kMostSide * kMostSide + 1) / 2 + 3;  // and the pixel's own bonus; ends with one that is none
constexpr int32_t kMostExponent = 127;

// The window of one pixel.
struct Scratch {
  uint16_t level[kMostTaps];
  uint16_t weight[kMostTaps];
  uint8_t steps[kMaxMedianRadius + 1][kMostSide];  // exponents by |dy| and radius + dx
  uint8_t color_steps[256];                        // exponents by colour difference, at most 127
  uint8_t weights[2 * kMostExponent + 1];          // by the sum of two exponents
};

uint32_t at_most(uint32_t value, uint32_t most) {
  return value < most ? value : most;
}

void prepare(const MedianWeightedArgs& args, Scratch& scratch) {
  for (uint32_t i = 0; i < sizeof scratch.weights; ++i) scratch.weights[i] = args.weights[at_most(i, kMostExponent)];
  for (uint32_t i = 0; i < sizeof scratch.color_steps; ++i) {
    scratch.color_steps[i] = static_cast<uint8_t>(at_most(i * args.color_scale >> 8, kMostExponent));
  }
  const uint8_t* steps = args.distance_steps;
  for (int32_t dy = 0; dy <= args.radius; ++dy, steps += args.radius + 1) {
    for (int32_t dx = 0; dx <= args.radius; ++dx) {
      scratch.steps[dy][args.radius + dx] = scratch.steps[dy][args.radius - dx] = steps[dx];
    }
  }
}

// Levels and weights of the window around x; returns how many, an even number.
template <int32_t kPlanes>
int32_t gather(const MedianWeightedArgs& args, int32_t x, Scratch& scratch) {
  const int32_t radius = args.radius;
  const ptrdiff_t stride = args.plane_stride;
  const uint8_t* own = args.lab[radius] + x;
  uint32_t center[kPlanes];
  for (int32_t plane = 0; plane < kPlanes; ++plane) center[plane] = own[plane * stride];
  uint16_t* level = scratch.level;
  uint16_t* weight = scratch.weight;
  *level++ = args.levels[radius][x];
  *weight++ = static_cast<uint16_t>(args.checked[x] < kOccluded ? args.own_bonus : 0);
  for (int32_t dy = -radius; dy <= radius; ++dy) {
    if (args.levels[dy + radius] == nullptr) continue;
    int32_t begin = x - radius + ((dy + radius) & 1);
    if (begin < 0) begin &= 1;
    const int32_t end = x + radius < args.width ? x + radius + 1 : args.width;
    const uint16_t* levels = args.levels[dy + radius];
    const uint8_t* lab = args.lab[dy + radius];
    const uint8_t* steps = scratch.steps[dy < 0 ? -dy : dy] + radius - x;
    for (int32_t i = begin; i < end; i += 2) {
      uint32_t sad = __usad8(center[0], lab[i]);
      for (int32_t plane = 1; plane < kPlanes; ++plane) sad = __usada8(center[plane], lab[plane * stride + i], sad);
      if (kPlanes > 1) sad = at_most(sad, 255);
      *weight++ = scratch.weights[scratch.color_steps[sad] + steps[i]];
      *level++ = levels[i];
    }
  }
  const int32_t count = static_cast<int32_t>(level - scratch.level);
  *level = 0;
  *weight = 0;
  return (count + 1) & ~1;
}

uint32_t add_halves(uint32_t halves) {
  return (halves & 0xffff) + (halves >> 16);
}

// Sum of the weights whose level, complemented by `flip`, lies below one.
uint32_t weight_below(const Scratch& scratch, int32_t count, uint32_t flip, uint32_t level) {
  const uint32_t than = twice(level);
  uint32_t below = 0;  // within 16 bits, as all weights of a window
  for (int32_t i = 0; i < count; i += 2) {
    __usub16(load32(scratch.level + i) ^ flip, than);
    below += __sel(0, load32(scratch.weight + i));
  }
  return add_halves(below);
}

// The highest of the levels, complemented by `flip`, below one that has any.
uint32_t next_below(const Scratch& scratch, int32_t count, uint32_t flip, uint32_t level) {
  const uint32_t than = twice(level);
  uint32_t next = 0;
  for (int32_t i = 0; i < count; i += 2) {
    const uint32_t word = load32(scratch.level + i) ^ flip;
    __usub16(word, than);
    const uint32_t lower = __sel(0, word);
    __usub16(next, lower);
    next = __sel(next, lower);
  }
  const uint32_t low = next & 0xffff;
  return low < next >> 16 ? next >> 16 : low;
}

uint16_t weighted_median(const Scratch& scratch, int32_t count) {
  const uint32_t own = twice(scratch.level[0]);
  uint32_t below = 0, above = 0, total = 0;
  for (int32_t i = 0; i < count; i += 2) {
    const uint32_t level = load32(scratch.level + i);
    const uint32_t weight = load32(scratch.weight + i);
    __usub16(level, own);
    below += __sel(0, weight);
    __usub16(own, level);
    above += __sel(0, weight);
    total += weight;
  }
  below = add_halves(below);
  above = add_halves(above);
  total = add_halves(total);
  const bool up = 2 * above > total;
  if (!up && 2 * below <= total) return scratch.level[0];
  // The search goes down; where the median is above, in complemented levels. There, the weight below a level may be half.
  const uint32_t flip = up ? 0xffffffff : 0;
  const uint32_t limit = total + (up ? 1 : 0);
  uint32_t current = (own ^ flip) & 0xffff;
  do {
    current = next_below(scratch, count, flip, current);
  } while (2 * weight_below(scratch, count, flip, current) >= limit);
  return static_cast<uint16_t>(current ^ flip);
}

// True when the pixel and its eight neighbours, as far as they are in the image, hold one level.
bool is_flat(const MedianWeightedArgs& args, int32_t x) {
  const uint32_t level = args.levels[args.radius][x];
  const int32_t left = x > 0 ? x - 1 : x;
  const int32_t right = x + 1 < args.width ? x + 1 : x;
  for (int32_t dy = -1; dy <= 1; ++dy) {
    const uint16_t* levels = args.levels[args.radius + dy];
    if (levels != nullptr && (levels[left] != level || levels[x] != level || levels[right] != level)) return false;
  }
  return true;
}

}  // namespace

uint64_t median_weighted_dsp_scratch(const KernelShape&) {
  return sizeof(Scratch);
}

void median_weighted_dsp(const MedianWeightedArgs& args) {
  Scratch& scratch = *static_cast<Scratch*>(args.scratch);
  prepare(args, scratch);
  const uint16_t* levels = args.levels[args.radius];
  for (int32_t x = 0; x < args.width; ++x) {
    args.out[x] = levels[x];
    if (is_flat(args, x)) continue;
    const int32_t count = kHasColor && args.planes == 3 ? gather<3>(args, x, scratch) : gather<1>(args, x, scratch);
    args.out[x] = weighted_median(scratch, count);
  }
}

}  // namespace bsm
#endif
