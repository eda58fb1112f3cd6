// One step of a scanline path, shared by the scalar aggregation kernels.
#ifndef BSM_SIMD_SCALAR_AGGREGATE_H
#define BSM_SIMD_SCALAR_AGGREGATE_H

#include <stdint.h>

#include "simd/kernels.h"

namespace bsm {

static inline uint16_t saturate(uint32_t value) {
  return static_cast<uint16_t>(value < 0xffff ? value : 0xffff);
}

static inline uint32_t least(uint32_t a, uint32_t b) {
  return a < b ? a : b;
}

static inline uint16_t least_cost(const uint16_t* costs, int32_t count) {
  uint16_t smallest = kNoCost;
  for (int32_t i = 0; i < count; ++i) smallest = costs[i] < smallest ? costs[i] : smallest;
  return smallest;
}

// L(x, d) = C(x, d) + min(L(x - r, d), L(x - r, d +- 1) + P1, min_k L(x - r, k) + P2) - min_k L(x - r, k) for all levels.
// current may be previous. A predecessor without candidates adds nothing.
static inline void aggregate_step(const uint16_t* cost, const uint16_t* previous, Penalties penalties, int32_t count,
                                  uint16_t* current) {
  const uint32_t smallest = least_cost(previous, count);
  const uint32_t jump = saturate(smallest + penalties.p2);
  uint32_t below = kNoCost;  // L(x - r, d - 1)
  for (int32_t level = 0; level < count; ++level) {
    const uint32_t same = previous[level];
    const uint32_t above = level + 1 < count ? previous[level + 1] : kNoCost;
    const uint32_t change = saturate(least(below, above) + penalties.p1);
    current[level] = saturate(cost[level] + least(least(same, change), jump) - smallest);
    below = same;
  }
}

}  // namespace bsm

#endif  // BSM_SIMD_SCALAR_AGGREGATE_H
