// What surrounds a hole of a row: fills for holes that no vote reached, and bounds on what may fill an occlusion.
#ifndef BSM_CORE_HOLES_H
#define BSM_CORE_HOLES_H

#include <stdint.h>

namespace bsm {

// Fills the pixels of `voted` that hold kNoLevel: with the whole level of the nearest valid pixel of the checked row (the
// left one of two equally near), else with the pixel above in the filled row before, else (above = nullptr) with level 0.
void fill_holes(const uint16_t* checked, const uint16_t* above, int32_t width, uint16_t* voted);

// For each pixel the highest whole level that may fill it. An occlusion between two surfaces belongs to the farther one:
// where the pixel is kOccluded and the nearest valid pixels on both sides differ by more than 1.5 levels, the lower of the
// two plus 1.5; elsewhere no bound (0xffff).
void cap_occlusions(const uint16_t* checked, int32_t width, uint16_t* cap);

}  // namespace bsm

#endif  // BSM_CORE_HOLES_H
