// One step of a scanline path for eight levels, shared by the aggregation kernels.
#ifndef BSM_SIMD_ARM_AGGREGATE_STEP_H
#define BSM_SIMD_ARM_AGGREGATE_STEP_H

#include "simd/arm/neon.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kAtOnce = 8;  // at once

// What holds for all levels of a pixel.
struct Step {
  uint16x8_t smallest, change, jump;  // least of the predecessor; P1; least plus P2
};

inline Step make_step(uint16_t smallest, Penalties penalties) {
  const uint16x8_t least = vdupq_n_u16(smallest);
  return Step{least, vdupq_n_u16(penalties.p1), vqaddq_u16(least, vdupq_n_u16(penalties.p2))};
}

// L of eight levels from their costs, the predecessor's values and those of the eight levels before and after them.
inline uint16x8_t next_path(const Step& step, uint16x8_t cost, uint16x8_t before, uint16x8_t same, uint16x8_t after) {
  const uint16x8_t below = vextq_u16(before, same, 7);
  const uint16x8_t above = vextq_u16(same, after, 1);
  const uint16x8_t changed = vqaddq_u16(vminq_u16(below, above), step.change);
  const uint16x8_t least = vminq_u16(vminq_u16(changed, same), step.jump);
  return vqaddq_u16(cost, vsubq_u16(least, step.smallest));
}

// All bits set in the lanes that lie from num_disparities on in the last eight levels of a pixel.
inline uint16x8_t beyond_last(int32_t num_disparities) {
  alignas(16) static constexpr uint16_t kLanes[kAtOnce] = {0, 1, 2, 3, 4, 5, 6, 7};
  return vcgtq_u16(vld1q_u16(kLanes), vdupq_n_u16(static_cast<uint16_t>((num_disparities - 1) % kAtOnce)));
}

// The levels of the last eight that exist from `value`, the others as they are at `to`.
inline void store_last(uint16_t* to, uint16x8_t value, uint16x8_t beyond) {
  vst1q_u16(to, vbslq_u16(beyond, vld1q_u16(to), value));
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_AGGREGATE_STEP_H
