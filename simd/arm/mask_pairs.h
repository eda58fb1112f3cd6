// What the mask kernels of M-profile processors share: where the points of the pairs lie, and the mask of a pixel whose
// threshold a byte does not hold. SADs are made for each pair anew: their memory counts, and loads are as cheap.
#ifndef BSM_SIMD_ARM_MASK_PAIRS_H
#define BSM_SIMD_ARM_MASK_PAIRS_H

#include "platform/compiler.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

// The first planes of a pair's points at x = 0.
struct PairPoints {
  const uint8_t* p;
  const uint8_t* q;
};

// In the scratch: the points of all pairs, then kLanes weights of each.
template <int32_t kLanes>
struct MaskScratch {
  PairPoints* points;
  uint8_t* weight;
  int32_t bits;

  static uint64_t bytes(int32_t bits) { return static_cast<uint64_t>(bits) * (sizeof(PairPoints) + kLanes); }
};

template <int32_t kLanes>
MaskScratch<kLanes> list_pairs(const MaskThresholdArgs& args, void* memory) {
  const Pattern& pattern = args.pattern;
  const uint8_t* const* rows = args.rows + pattern.radius;
  PairPoints* const points = static_cast<PairPoints*>(memory);
  for (int32_t i = 0; i < pattern.bits; ++i) {
    const PixelPair& pair = pattern.pairs[i];
    points[i] = PairPoints{rows[pair.py] + pair.px, rows[pair.qy] + pair.qx};
  }
  return MaskScratch<kLanes>{points, reinterpret_cast<uint8_t*>(points + pattern.bits), pattern.bits};
}

// SAD of pixel x and a point.
inline uint32_t whole_sad(const MaskThresholdArgs& args, int32_t x, const uint8_t* point) {
  uint32_t sum = 0;
  for (int32_t plane = 0; plane < args.planes; ++plane) {
    const ptrdiff_t at = plane * args.plane_stride + x;
    const int32_t difference = args.rows[args.pattern.radius][at] - point[at];
    sum += static_cast<uint32_t>(difference < 0 ? -difference : difference);
  }
  return sum;
}

// The mask of pixel x with whole weights, which take the place of the saturated ones.
template <int32_t kLanes>
BSM_COLD void store_exact(const MaskThresholdArgs& args, int32_t x, const MaskScratch<kLanes>& scratch) {
  uint16_t* const weight = reinterpret_cast<uint16_t*>(scratch.weight);
  for (int32_t i = 0; i < scratch.bits; ++i) {
    const uint32_t p = whole_sad(args, x, scratch.points[i].p);
    const uint32_t q = whole_sad(args, x, scratch.points[i].q);
    weight[i] = static_cast<uint16_t>(p < q ? q : p);
  }
  uint32_t threshold = 0;
  for (uint32_t step = 512; step != 0; step /= 2) {
    int32_t counted = 0;
    for (int32_t i = 0; i < scratch.bits; ++i) counted += weight[i] < threshold + step ? 1 : 0;
    if (counted < scratch.bits / 4) threshold += step;
  }
  uint8_t* out = args.out + ptrdiff_t{x} * (scratch.bits / 8);
  for (int32_t i = 0; i < scratch.bits; i += 8) {
    uint32_t byte = 0;
    for (int32_t k = 7; k >= 0; --k) byte = 2 * byte + (weight[i + k] <= threshold ? 1u : 0u);
    *out++ = static_cast<uint8_t>(byte);
  }
}

// Where a search for thresholds begins: with a step of 1 << bits when all thresholds lie below it. The bits that the last
// pixels needed are tried first.
inline int32_t larger_step(int32_t step) {
  return step <= 64 ? 4 * step : 256;
}

inline int32_t bits_of(uint32_t most) {
  int32_t bits = 2;
  while (most >> bits != 0) ++bits;
  return bits;
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_MASK_PAIRS_H
