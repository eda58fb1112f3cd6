// From input rows to costs and winners: colour, descriptors, masks, matching.
#ifndef BSM_CORE_MATCH_H
#define BSM_CORE_MATCH_H

#include <stdint.h>

#include "bsm/bsm.h"
#include "core/context.h"

namespace bsm {

// Where input rows come from: row y of a view is at plane[0] + (y - first_row) * stride[0]; its chroma row, where the format
// has one, at plane[1] + (y - first_row) / 2 * stride[1].
struct RowSource {
  bsm_image image[kViews];
  int32_t first_row;
};

// Input row y of both views into the rings of luma and CIELAB.
void enter_row(const bsm_context& context, const RowSource& source, int32_t y);

// Descriptors, masks and, without aggregation, the winners of row y; with it, the costs and the paths along the row.
void match_row(const bsm_context& context, int32_t y, uint8_t* job);

// Levels of row y of the views kept: their winners, checked when the stage asks for it, into the rings of levels.
void check_row(const bsm_context& context, int32_t y, uint8_t* job);

}  // namespace bsm

#endif  // BSM_CORE_MATCH_H
