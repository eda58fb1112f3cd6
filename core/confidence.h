// How far a disparity can be trusted, from three signs:
//   agreement: the share of the 5 x 5 pixels around it, two apart, whose valid winners lie within 24/16 of it (times 1000);
//   kept: its own valid winner lies within 16/16 of it (500);
//   margin, sgm alone: the least sum two or more levels away less the winner's, in 1/512 of the bits, at most 249 (times 2).
// The confidence is their sum times 255 / 1998. Pixels that the border band continues count as not valid. Without margins
// the highest value is 191.
#ifndef BSM_CORE_CONFIDENCE_H
#define BSM_CORE_CONFIDENCE_H

#include <stdint.h>

#include "core/context.h"

namespace bsm {

constexpr int32_t kConfidenceRadius = 4;  // of the neighbours that are asked, every second pixel

// sgm: margins of row y between the least sum and the least of those two or more levels away.
void measure_margins(const bsm_context& context, int32_t y);

// Confidence of row y of the left view's map; disparity holds the finished row.
void confidence_row(const bsm_context& context, int32_t y, const int16_t* disparity, uint8_t* out);

}  // namespace bsm

#endif  // BSM_CORE_CONFIDENCE_H
