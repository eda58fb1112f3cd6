// One step of a scanline path for eight levels, shared by the MVE aggregation kernels.
#ifndef BSM_SIMD_ARM_AGGREGATE_MVE_H
#define BSM_SIMD_ARM_AGGREGATE_MVE_H

#include "simd/arm/mve.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kAtOnce = 8;

// What holds for all levels of a pixel.
struct Step {
  uint16_t smallest, change;  // least of the predecessor; P1
  uint16x8_t jump;            // least plus P2
};

inline Step make_step(uint16_t smallest, Penalties penalties) {
  return Step{smallest, penalties.p1, vqaddq_n_u16(vdupq_n_u16(smallest), penalties.p2)};
}

// L of eight levels from their costs, the predecessor's values and those one level below and above.
inline uint16x8_t next_path(const Step& step, uint16x8_t cost, uint16x8_t below, uint16x8_t same, uint16x8_t above) {
  const uint16x8_t changed = vqaddq_n_u16(vminq_u16(below, above), step.change);
  const uint16x8_t least = vminq_u16(vminq_u16(changed, same), step.jump);
  return vqaddq_u16(cost, vsubq_n_u16(least, step.smallest));
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_AGGREGATE_MVE_H
