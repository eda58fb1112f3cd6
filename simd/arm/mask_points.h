// What the mask kernels of M-profile processors share: the window offsets that a pattern uses, numbered row by row in as
// little memory as the pattern allows, and the mask of a pixel whose threshold a byte does not hold.
#ifndef BSM_SIMD_ARM_MASK_POINTS_H
#define BSM_SIMD_ARM_MASK_POINTS_H

#include "platform/compiler.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

// Points that a pattern can have at most.
inline uint64_t most_points(const KernelShape& shape) {
  const uint64_t side = 2 * static_cast<uint32_t>(shape.radius) + 1;
  const uint64_t ends = 2 * static_cast<uint64_t>(static_cast<uint32_t>(shape.bits));
  return ends < side * side ? ends : side * side;
}

// Scratch, in this order: a pointer to the first plane of each point at x = 0; the SADs of kLanes pixels at each point,
// among them at first the numbers of the window's offsets; the weights of the pairs; the byte offsets of the SADs of p and
// q.
template <int32_t kLanes>
struct MaskScratch {
  const uint8_t** point;
  uint8_t* sad;
  uint8_t* weight;
  uint16_t* pairs;
  int32_t count;  // of points

  static uint64_t sad_bytes(const KernelShape& shape) {
    const uint64_t side = 2 * static_cast<uint32_t>(shape.radius) + 1;
    const uint64_t numbers = (sizeof(uint16_t) * side * side + 15) / 16 * 16;
    const uint64_t sads = most_points(shape) * kLanes;
    return numbers < sads ? sads : numbers;
  }
  static uint64_t point_bytes(const KernelShape& shape) { return (sizeof(void*) * most_points(shape) + 15) / 16 * 16; }
  static uint64_t bytes(const KernelShape& shape) {
    return point_bytes(shape) + sad_bytes(shape) + static_cast<uint64_t>(shape.bits) * (kLanes + 2 * sizeof(uint16_t));
  }
};

template <int32_t kLanes>
MaskScratch<kLanes> list_points(const MaskThresholdArgs& args) {
  const Pattern& pattern = args.pattern;
  const int32_t radius = pattern.radius;
  const int32_t side = 2 * radius + 1;
  const KernelShape shape{args.width, pattern.bits, radius, args.planes, 1};
  uint8_t* const memory = static_cast<uint8_t*>(args.scratch);
  MaskScratch<kLanes> scratch{};
  scratch.point = static_cast<const uint8_t**>(args.scratch);
  scratch.sad = memory + MaskScratch<kLanes>::point_bytes(shape);
  scratch.weight = scratch.sad + MaskScratch<kLanes>::sad_bytes(shape);
  scratch.pairs = reinterpret_cast<uint16_t*>(scratch.weight + ptrdiff_t{pattern.bits} * kLanes);

  uint16_t* const number = reinterpret_cast<uint16_t*>(scratch.sad);
  uint16_t* const middle = number + radius * side + radius;
  BSM_MEMSET(number, 0, sizeof *number * static_cast<size_t>(side * side));
  for (int32_t i = 0; i < pattern.bits; ++i) {
    const PixelPair& pair = pattern.pairs[i];
    middle[pair.py * side + pair.px] = middle[pair.qy * side + pair.qx] = 1;
  }
  for (int32_t dy = 0; dy < side; ++dy) {
    for (int32_t dx = 0; dx < side; ++dx) {
      if (number[dy * side + dx] == 0) continue;
      number[dy * side + dx] = static_cast<uint16_t>(scratch.count * kLanes);
      scratch.point[scratch.count++] = args.rows[dy] + (dx - radius);
    }
  }
  for (int32_t i = 0; i < pattern.bits; ++i) {
    const PixelPair& pair = pattern.pairs[i];
    scratch.pairs[2 * i] = middle[pair.py * side + pair.px];
    scratch.pairs[2 * i + 1] = middle[pair.qy * side + pair.qx];
  }
  return scratch;
}

// The mask of pixel x with whole SADs, which take the place of the saturated ones.
template <int32_t kLanes>
BSM_NOINLINE void store_exact(const MaskThresholdArgs& args, int32_t x, const MaskScratch<kLanes>& scratch) {
  const int32_t bits = args.pattern.bits;
  const uint8_t* own = args.rows[args.pattern.radius] + x;
  uint16_t* const sad = reinterpret_cast<uint16_t*>(scratch.sad);
  for (int32_t i = 0; i < scratch.count; ++i) {
    uint32_t sum = 0;
    for (int32_t plane = 0; plane < args.planes; ++plane) {
      const int32_t difference = own[plane * args.plane_stride] - scratch.point[i][plane * args.plane_stride + x];
      sum += static_cast<uint32_t>(difference < 0 ? -difference : difference);
    }
    sad[i] = static_cast<uint16_t>(sum);
  }
  const auto within = [&scratch, sad](int32_t i, uint32_t threshold) {
    return sad[scratch.pairs[2 * i] / kLanes] <= threshold && sad[scratch.pairs[2 * i + 1] / kLanes] <= threshold;
  };
  uint32_t threshold = 0;
  for (uint32_t step = 512; step != 0; step /= 2) {
    int32_t counted = 0;
    for (int32_t i = 0; i < bits; ++i) counted += within(i, threshold + step - 1) ? 1 : 0;
    if (counted < bits / 4) threshold += step;
  }
  uint8_t* out = args.out + ptrdiff_t{x} * (bits / 8);
  for (int32_t i = 0; i < bits; i += 8) {
    uint32_t byte = 0;
    for (int32_t k = 7; k >= 0; --k) byte = 2 * byte + (within(i + k, threshold) ? 1u : 0u);
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

#endif  // BSM_SIMD_ARM_MASK_POINTS_H
