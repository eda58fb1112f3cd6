// From the checked, sparse map to the dense one: border band, vote, holes, weighted median, 3x3 median. Each function writes
// one row of one view and reads the rows around it that its radius in the plan says.
#ifndef BSM_CORE_REFINE_H
#define BSM_CORE_REFINE_H

#include <stdint.h>

#include "core/context.h"

namespace bsm {

// Removes the speckles of checked row y.
void despeckle_row(const bsm_context& context, View view, int32_t y);

// Fits the surface at the border of checked row y.
void fit_row(const bsm_context& context, View view, int32_t y);

// Continues the surface of row y to the border.
void continue_row(const bsm_context& context, View view, int32_t y);

// Columns of row y that continue_row left alone.
struct Columns {
  int32_t begin, end;
};
Columns measured_columns(const bsm_context& context, View view, int32_t y);

// Fills the holes of row y by voting (eq. 9, 10); pixels without any vote stay holes.
void vote_row(const bsm_context& context, View view, int32_t y, uint8_t* job);

// Fills what the vote of row y left: from the nearest valid pixel of the row, else from the filled row above.
void fill_row(const bsm_context& context, View view, int32_t y);

// One pass of the weighted median of row y; the level of a pixel that was valid before the vote weighs 512 more in the first
// pass, half of that in each further one.
void smooth_row(const bsm_context& context, View view, int32_t pass, int32_t y, uint8_t* job);

// 3x3 median of row y of the dense map; then pixels left within 12/16 of their sub-pixel level before the vote get it back
// (weight 1 in the smoothing), others keep the whole level (weight 2).
void restore_row(const bsm_context& context, View view, int32_t y);

// The first pass of smoothing the fractions of row y.
void smooth_fraction_row(const bsm_context& context, View view, int32_t y, uint8_t* job);

// Writes row y of the configured stage as disparities, width values in 1/16 pixel.
void write_row(const bsm_context& context, View view, int32_t y, int16_t* out, uint8_t* job);

}  // namespace bsm

#endif  // BSM_CORE_REFINE_H
