// Regions that a ground truth implies where no masks came with it.
#ifndef BSM_BENCH_TRUTH_REGIONS_H
#define BSM_BENCH_TRUTH_REGIONS_H

#include "host/disparity_file.h"
#include "host/evaluate.h"

namespace bsm::bench {

// Pixels of `visible` near a jump of the truth: within half a window of neighbours whose known disparities differ by more
// than kJump pixels. `visible` is the non-occluded mask, or empty for all.
host::Mask near_jumps(const host::DisparityMap& truth, const host::Mask& visible);

}  // namespace bsm::bench

#endif  // BSM_BENCH_TRUTH_REGIONS_H
