// Speckle filter: small patches that no neighbour supports are no surface.
#ifndef BSM_CORE_SPECKLE_H
#define BSM_CORE_SPECKLE_H

#include <stdint.h>

namespace bsm {

constexpr int32_t kSpeckleRadius = 4;  // of the neighbours that are asked, every second pixel

// One row of a checked map; rows are those y - kSpeckleRadius .. y + kSpeckleRadius, nullptr outside the image. Valid pixels
// that fewer than `percent` of the asked pixels inside the image support (valid and within 1.5 levels, itself among them)
// become kNoLevel.
void remove_speckles(const uint16_t* const* rows, int32_t width, int32_t percent, uint16_t* out);

}  // namespace bsm

#endif  // BSM_CORE_SPECKLE_H
