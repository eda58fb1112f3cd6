// One step of a scanline path for a vector of levels, shared by the aggregation kernels. Lanes without a level hold kNoCost.
#ifndef BSM_SIMD_ARM_AGGREGATE_STEP_SVE_H
#define BSM_SIMD_ARM_AGGREGATE_STEP_SVE_H

#include "simd/arm/sve.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

// What holds for all levels of a pixel: least of the predecessor; P1; least plus P2.
struct Step {
  uint16_t smallest, change, jump;
};

inline Step make_step(uint16_t smallest, Penalties penalties) {
  const uint32_t jump = uint32_t{smallest} + penalties.p2;
  return Step{smallest, penalties.p1, static_cast<uint16_t>(jump < kNoCost ? jump : kNoCost)};
}

inline svuint16_t load_levels(svbool_t those, const uint16_t* from) {
  return svsel(those, svld1(those, from), svdup_u16(kNoCost));
}

// L of a vector of levels from their costs, the predecessor's values, its value at the level before them and its values at
// the vector of levels after them.
inline svuint16_t next_path(const Step& step, svuint16_t cost, uint16_t before, svuint16_t same, svuint16_t after) {
  const svbool_t all = svptrue_b16();
  const svuint16_t below = svinsr(same, before);
  const svuint16_t above = svext(same, after, 1);
  const svuint16_t changed = svqadd(svmin_x(all, below, above), svdup_u16(step.change));
  const svuint16_t least = svmin_x(all, svmin_x(all, changed, same), svdup_u16(step.jump));
  return svqadd(cost, svsub_x(all, least, svdup_u16(step.smallest)));
}

inline uint16_t last_lane(svuint16_t values) {
  return svlastb(svptrue_b16(), values);
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_AGGREGATE_STEP_SVE_H
