// One step of a scanline path for two levels, shared by the DSP aggregation kernels.
#ifndef BSM_SIMD_ARM_AGGREGATE_DSP_H
#define BSM_SIMD_ARM_AGGREGATE_DSP_H

#include "simd/arm/dsp.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr uint32_t kNone = 0xffffffff;  // two costs kNoCost

// What holds for all levels of a pixel, twice.
struct Step {
  uint32_t smallest, change, jump;  // least of the predecessor; P1; least plus P2
};

inline Step make_step(uint32_t smallest, Penalties penalties) {
  const uint32_t least = twice(smallest);
  return Step{least, twice(penalties.p1), __uqadd16(least, twice(penalties.p2))};
}

// The levels between two words: the upper of the first and the lower of the second.
inline uint32_t between(uint32_t first, uint32_t second) {
  return first >> 16 | second << 16;
}

// L of two levels from their costs, the predecessor's values and those one level below and above.
inline uint32_t next_path(const Step& step, uint32_t cost, uint32_t below, uint32_t same, uint32_t above) {
  const uint32_t changed = __uqadd16(least16(below, above), step.change);
  return __uqadd16(cost, __usub16(least16(least16(changed, same), step.jump), step.smallest));
}

// The last level of an odd number lies in the lower half of a word; the upper half belongs to no level.
inline uint32_t load_last(const uint16_t* from, bool odd) {
  return odd ? *from | kNone << 16 : load32(from);
}

inline void store_last(uint16_t* to, uint32_t word, bool odd) {
  if (odd) {
    *to = static_cast<uint16_t>(word);
  } else {
    BSM_MEMCPY(to, &word, sizeof word);
  }
}

inline void store32(uint16_t* to, uint32_t word) {
  BSM_MEMCPY(to, &word, sizeof word);
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_AGGREGATE_DSP_H
