// median_weighted, scalar: edge-preserving smoothing of a dense map.
#include "simd/kernels.h"
#include "simd/scalar/sad.h"

namespace bsm {
namespace {

// Half of the window's pixels and the bonus of the pixel itself.
constexpr int32_t kMaxTaps = ((2 * kMaxMedianRadius + 1) * (2 * kMaxMedianRadius + 1) + 1) / 2 + 1;

// The window of one pixel: its levels and their weights.
struct Taps {
  uint16_t level[kMaxTaps];
  uint16_t weight[kMaxTaps];
  int32_t count;
};

void gather(const MedianWeightedArgs& args, int32_t x, Taps* taps) {
  const int32_t radius = args.radius;
  const uint8_t* center = args.lab[radius] + x;
  taps->level[0] = args.levels[radius][x];
  taps->weight[0] = static_cast<uint16_t>(args.checked[x] < kOccluded ? args.own_bonus : 0);
  taps->count = 1;
  for (int32_t dy = -radius; dy <= radius; ++dy) {
    const uint16_t* levels = args.levels[dy + radius];
    if (levels == nullptr) continue;
    const uint8_t* lab = args.lab[dy + radius];
    const uint8_t* steps = args.distance_steps + ptrdiff_t{dy < 0 ? -dy : dy} * (radius + 1);
    for (int32_t dx = -radius + ((dy + radius) & 1); dx <= radius; dx += 2) {
      const int32_t i = x + dx;
      if (i < 0 || i >= args.width) continue;
      const uint32_t color = sad(center, lab + i, args.plane_stride, args.planes);
      const uint32_t exponent = (((color < 255 ? color : 255) * args.color_scale) >> 8) + steps[dx < 0 ? -dx : dx];
      taps->level[taps->count] = levels[i];
      taps->weight[taps->count++] = args.weights[exponent < 127 ? exponent : 127];
    }
  }
}

struct Split {
  uint32_t below, at, above;  // weights of the levels below, at and above a level
};

Split split_weights(const Taps& taps, uint16_t level) {
  Split split{0, 0, 0};
  for (int32_t i = 0; i < taps.count; ++i) {
    uint32_t& side = taps.level[i] < level ? split.below : taps.level[i] == level ? split.at : split.above;
    side += taps.weight[i];
  }
  return split;
}

// The level itself when it splits the window evenly, else the least level up to which at least half of the weight lies.
uint16_t weighted_median(const Taps& taps, uint16_t level) {
  Split split = split_weights(taps, level);
  const uint32_t total = split.below + split.at + split.above;
  if (2 * split.below <= total && 2 * split.above <= total) return level;
  uint16_t median = 0xffff;
  for (int32_t i = 0; i < taps.count; ++i) {
    if (taps.level[i] >= median) continue;
    split = split_weights(taps, taps.level[i]);
    if (2 * (split.below + split.at) >= total) median = taps.level[i];
  }
  return median;
}

// True when the pixel and its eight neighbours, as far as they are in the image, hold one level.
bool is_flat(const MedianWeightedArgs& args, int32_t x) {
  const uint16_t level = args.levels[args.radius][x];
  for (int32_t dy = -1; dy <= 1; ++dy) {
    const uint16_t* levels = args.levels[args.radius + dy];
    for (int32_t i = x - 1; levels != nullptr && i <= x + 1; ++i) {
      if (i >= 0 && i < args.width && levels[i] != level) return false;
    }
  }
  return true;
}

}  // namespace

uint64_t median_weighted_scalar_scratch(const KernelShape&) {
  return sizeof(Taps);
}

void median_weighted_scalar(const MedianWeightedArgs& args) {
  Taps& taps = *static_cast<Taps*>(args.scratch);
  const uint16_t* levels = args.levels[args.radius];
  for (int32_t x = 0; x < args.width; ++x) {
    args.out[x] = levels[x];
    if (is_flat(args, x)) continue;
    gather(args, x, &taps);
    args.out[x] = weighted_median(taps, levels[x]);
  }
}

}  // namespace bsm
