// The 3x3 median that ends the refinement.
#ifndef BSM_CORE_MEDIAN_H
#define BSM_CORE_MEDIAN_H

#include <stdint.h>

namespace bsm {

// Median of each pixel's 3x3 neighbourhood, the border replicated; rows are the one above, the pixel's and the one below.
void median_3x3(const uint16_t* const rows[3], int32_t width, uint16_t* out);

}  // namespace bsm

#endif  // BSM_CORE_MEDIAN_H
