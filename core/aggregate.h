// Semi-global aggregation of the masked costs: the paths along a row, the paths from the row before, winner-takes-all.
#ifndef BSM_CORE_AGGREGATE_H
#define BSM_CORE_AGGREGATE_H

#include <stdint.h>

#include "core/context.h"

namespace bsm {

// Costs of row y and its two paths along the row, of the left view into the rings of costs and sums. With own right costs
// also those of the right view, whose winners are final.
void aggregate_along_row(const bsm_context& context, int32_t y, uint8_t* job);

// Adds one path from the row before to the sums of pixels begin..end-1 of row y. Path 0 is straight, 1 and 2 come from the
// pixel to the left and to the right. step is 1 for paths from above, -1 for paths from below.
void aggregate_across_row(const bsm_context& context, int32_t path, int32_t step, int32_t y, int32_t begin, int32_t end,
                          uint8_t* job);

// Winners of pixels begin..end-1 of row y of the left view, from sums that no path is missing in.
void pick_left_winners(const bsm_context& context, int32_t y, int32_t begin, int32_t end, uint8_t* job);

// Winners of row y of a right view without costs of its own, from the left view's sums: the least S(x + d, d), the lowest
// level wins a tie.
void pick_right_winners(const bsm_context& context, int32_t y, uint8_t* job);

// The column from which a path's predecessor comes: x - path_dx.
int32_t path_dx(int32_t path);

}  // namespace bsm

#endif  // BSM_CORE_AGGREGATE_H
