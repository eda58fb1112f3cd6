// Left/right check (section 3.4): a pixel is valid when the other view's map points back at it.
#ifndef BSM_CORE_CONSISTENCY_H
#define BSM_CORE_CONSISTENCY_H

#include <stdint.h>

#include "core/plan.h"

namespace bsm {

// The winners of one row, `width` levels in 1/16 pixel each; level[kLeft][x] belongs to the right pixel
// x - min_disparity - its whole level.
struct Winners {
  const uint16_t* level[kViews];
  int32_t width;
  int32_t min_disparity;
};

// Writes the levels of `view` as they are.
void copy_levels(const Winners& winners, View view, uint16_t* out);

// The same, but where the pixel that a winner points at has a winner more than `tolerance` whole levels away: kOccluded when
// no winner of the other view points at the pixel, else kNoLevel.
void check_levels(const Winners& winners, View view, int32_t tolerance, uint16_t* out);

}  // namespace bsm

#endif  // BSM_CORE_CONSISTENCY_H
