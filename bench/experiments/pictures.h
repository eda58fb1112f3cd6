// Draws disparity maps and truths for the report.
#ifndef BSM_BENCH_EXPERIMENTS_PICTURES_H
#define BSM_BENCH_EXPERIMENTS_PICTURES_H

#include "bench/match_pair.h"
#include "bench/pair_set.h"
#include "host/image.h"

namespace bsm::bench {

// Violet = far, yellow = near, black = no disparity; the range that is searched for the pair fills the colours.
host::Image8 draw_match(const Pair& pair, const Match& match);
host::Image8 draw_truth(const Pair& pair);

}  // namespace bsm::bench

#endif  // BSM_BENCH_EXPERIMENTS_PICTURES_H
