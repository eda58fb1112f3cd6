// Numbers the points of a pattern, and finds thresholds beyond a byte: for the mask kernels.
#ifndef BSM_SIMD_PATTERN_POINTS_H
#define BSM_SIMD_PATTERN_POINTS_H

#include "platform/compiler.h"
#include "simd/pattern_order.h"

namespace bsm {
namespace {

inline int32_t window_index(int32_t dx, int32_t dy, int32_t radius) {
  return (dy + radius) * (2 * radius + 1) + dx + radius;
}

// out.pairs has room for the pattern's pairs.
inline void number_points(const Pattern& pattern, PatternPoints& out) {
  const int32_t radius = pattern.radius;
  const int32_t side = 2 * radius + 1;
  BSM_MEMSET(out.number, 0, sizeof out.number);
  for (int32_t i = 0; i < pattern.bits; ++i) {
    const PixelPair& pair = pattern.pairs[i];
    const uint32_t p = static_cast<uint32_t>(window_index(pair.px, pair.py, radius));
    const uint32_t q = static_cast<uint32_t>(window_index(pair.qx, pair.qy, radius));
    out.number[p] = out.number[q] = 1;
    out.pairs[i] = p | q << 16;
  }
  out.count = 0;
  for (int32_t i = 0; i < side * side; ++i) {
    if (out.number[i] == 0) continue;
    out.number[i] = static_cast<uint16_t>(8 * out.count);
    out.points[out.count++] =
        PatternPoints::Point{static_cast<int8_t>(i % side - radius), static_cast<int8_t>(i / side - radius)};
  }
  for (int32_t i = 0; i < pattern.bits; ++i) {
    const uint32_t p = out.number[out.pairs[i] & 0xffff];
    const uint32_t q = out.number[out.pairs[i] >> 16];
    out.pairs[i] = p | q << 16;
  }
}

// T of one pixel from the SADs of its points, exactly: for thresholds that a byte does not hold. Fills sad and histogram.
inline uint32_t exact_threshold(const MaskThresholdArgs& args, int32_t x, const PatternPoints& points, uint16_t* sad,
                                uint16_t* histogram) {
  const uint8_t* const* rows = args.rows + args.pattern.radius;
  for (int32_t i = 0; i < points.count; ++i) {
    uint32_t sum = 0;
    for (int32_t plane = 0; plane < args.planes; ++plane) {
      const ptrdiff_t offset = plane * args.plane_stride + x;
      const int32_t difference = rows[0][offset] - rows[points.points[i].dy][offset + points.points[i].dx];
      sum += static_cast<uint32_t>(difference < 0 ? -difference : difference);
    }
    sad[i] = static_cast<uint16_t>(sum);
  }
  BSM_MEMSET(histogram, 0, sizeof(uint16_t) * (kMaxSad + 1));
  for (int32_t i = 0; i < args.pattern.bits; ++i) {
    const uint16_t p = sad[(points.pairs[i] & 0xffff) / 8];
    const uint16_t q = sad[(points.pairs[i] >> 16) / 8];
    ++histogram[p < q ? q : p];
  }
  uint32_t threshold = 0;
  int32_t counted = histogram[0];
  while (counted < args.pattern.bits / 4) counted += histogram[++threshold];
  return threshold;
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_PATTERN_POINTS_H
