// How well a confidence map orders the pixels: the error that remains when the least confident are removed first.
#ifndef BSM_BENCH_EXPERIMENTS_SPARSIFICATION_H
#define BSM_BENCH_EXPERIMENTS_SPARSIFICATION_H

#include <cstdint>
#include <vector>

#include "bench/pair_set.h"

namespace bsm::bench {

struct Sparsification {
  std::vector<double> removed;  // percent of the pixels, from 0
  std::vector<double> error;    // percent of the remaining pixels that are bad
  std::vector<double> ideal;    // the same when bad pixels are removed first
  double area = 0.0;            // mean of error over removed, in percent
  double ideal_area = 0.0;
};

// Pixels of the region all; bad: an error above one pixel. Pixels of equal confidence are removed evenly.
Sparsification sparsify(const Pair& pair, const host::DisparityMap& map, const std::vector<uint8_t>& confidence);

// Curves of the same length, averaged.
Sparsification mean_of(const std::vector<Sparsification>& curves);

}  // namespace bsm::bench

#endif  // BSM_BENCH_EXPERIMENTS_SPARSIFICATION_H
