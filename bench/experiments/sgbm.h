// OpenCV's semi-global block matching on the same pairs, where OpenCV was found when this was built.
#ifndef BSM_BENCH_EXPERIMENTS_SGBM_H
#define BSM_BENCH_EXPERIMENTS_SGBM_H

#include <string>

#include "bench/pair_set.h"
#include "host/disparity_file.h"

namespace bsm::bench {

bool sgbm_available();

// Name and version, for reports.
std::string sgbm_name();

// StereoSGBM, 3-way, 3 x 3 blocks, P1 = 8 x 3 x 9, P2 = 32 x 3 x 9, in one thread. The views are extended to the left so
// that the whole width is searched, and holes take the lower of the nearest disparities of their row: a dense map.
host::DisparityMap sgbm_match(const Pair& pair);

}  // namespace bsm::bench

#endif  // BSM_BENCH_EXPERIMENTS_SGBM_H
