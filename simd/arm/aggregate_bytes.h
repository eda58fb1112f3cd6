// One step of a scanline path for sixteen levels in bytes. No candidate is 255; a value of a candidate has to stay below.
#ifndef BSM_SIMD_ARM_AGGREGATE_BYTES_H
#define BSM_SIMD_ARM_AGGREGATE_BYTES_H

#include "simd/arm/neon.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

// A path is at most the largest cost plus P2, and no sum of the step is more than P2 above a path.
inline bool fits_bytes(int32_t most_cost, const Penalties (&penalties)[2]) {
  const int32_t p2 = penalties[0].p2 < penalties[1].p2 ? penalties[1].p2 : penalties[0].p2;
  return most_cost + 2 * p2 <= 254;
}

// What holds for all levels of a pixel.
struct ByteStep {
  uint8x16_t smallest, change, jump;  // least of the predecessor; P1; least plus P2
};

// The penalties in all lanes.
struct ByteSteps {
  alignas(16) uint8_t lanes[2][2][16];  // by edge: P1, P2

  explicit ByteSteps(const Penalties (&penalties)[2]) {
    for (int32_t edge = 0; edge < 2; ++edge) {
      BSM_MEMSET(lanes[edge][0], penalties[edge].p1, 16);
      BSM_MEMSET(lanes[edge][1], penalties[edge].p2, 16);
    }
  }

  ByteStep next(uint8x16_t path, uint8_t edge) const {
    const uint8x16_t least = vdupq_n_u8(least8(path));
    return ByteStep{least, vld1q_u8(lanes[edge][0]), vqaddq_u8(least, vld1q_u8(lanes[edge][1]))};
  }
};

// L of sixteen levels from their costs, the predecessor's values and those of the levels before and after them.
inline uint8x16_t next_path(const ByteStep& step, uint8x16_t cost, uint8x16_t before, uint8x16_t same, uint8x16_t after) {
  const uint8x16_t below = vextq_u8(before, same, 15);
  const uint8x16_t above = vextq_u8(same, after, 1);
  const uint8x16_t changed = vqaddq_u8(vminq_u8(below, above), step.change);
  const uint8x16_t least = vminq_u8(vminq_u8(changed, same), step.jump);
  return vqaddq_u8(cost, vsubq_u8(least, step.smallest));
}

// Sixteen costs below 255 or kNoCost.
inline uint8x16_t load_costs(const uint16_t* cost) {
  return low_bytes(vld1q_u16(cost), vld1q_u16(cost + 8));
}

// Sums of two paths of a pixel, kVectors vectors each, those of the one in memory; `beyond` as in beyond_last. Levels
// without a candidate get 510.
template <int32_t kVectors>
inline void add_bytes(const uint8x16_t (&path)[kVectors], const uint8_t* other, uint16x8_t beyond, uint16_t* sum) {
  uint8x16_t added[kVectors];
  BSM_UNROLL
  for (int32_t i = 0; i < kVectors; ++i) added[i] = vld1q_u8(other + 16 * i);
  BSM_UNROLL
  for (int32_t i = 0; i < kVectors; ++i, sum += 16) {
    const uint16x8_t high = vaddl_u8(vget_high_u8(path[i]), vget_high_u8(added[i]));
    vst1q_u16(sum, vaddl_u8(vget_low_u8(path[i]), vget_low_u8(added[i])));
    vst1q_u16(sum + 8, i == kVectors - 1 ? vbslq_u16(beyond, vld1q_u16(sum + 8), high) : high);
  }
}

// kNoCost for the sums of levels without a candidate.
template <int32_t kVectors>
BSM_NOINLINE void mark_missing(uint16x8_t beyond, uint16_t* sum) {
  for (int32_t i = 0; i < 2 * kVectors; ++i, sum += 8) {
    const uint16x8_t value = vld1q_u16(sum);
    const uint16x8_t missing = vceqq_u16(value, vdupq_n_u16(510));
    vst1q_u16(sum, vorrq_u16(value, i == 2 * kVectors - 1 ? vbicq_u16(missing, beyond) : missing));
  }
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_AGGREGATE_BYTES_H
