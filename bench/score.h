// Scores of maps against ground truth: bad pixels by region and threshold, and their averages over groups of pairs.
#ifndef BSM_BENCH_SCORE_H
#define BSM_BENCH_SCORE_H

#include <array>
#include <string>
#include <vector>

#include "bench/pair_set.h"
#include "host/disparity_file.h"

namespace bsm::bench {

struct Score {
  std::array<bool, kRegionCount> has_region{};
  std::vector<double> thresholds;                     // in pixels
  std::vector<std::array<double, kRegionCount>> bad;  // percent, for each threshold
  double mean_error = 0.0;                            // in pixels, over the valid pixels of the region all

  // Mean over the regions that there are.
  double mean(size_t threshold) const;
};

// Bad: an error strictly above the threshold, on the unrounded disparity, or no disparity.
Score score_map(const Pair& pair, const host::DisparityMap& map, const std::vector<double>& thresholds);

// Averages of scores with the same thresholds: each region over the pairs that have it; the mean is that of all numbers of
// all pairs, as the benchmark's average error is the mean of 12.
class Average {
 public:
  void add(const Score& score);
  size_t pairs() const { return pairs_; }
  double region(size_t threshold, int region) const;
  bool has_region(int region) const { return counts_[static_cast<size_t>(region)] > 0; }
  double mean(size_t threshold) const;
  double mean_error() const { return pairs_ > 0 ? error_sum_ / static_cast<double>(pairs_) : 0.0; }

 private:
  size_t pairs_ = 0;
  std::array<size_t, kRegionCount> counts_{};
  std::vector<std::array<double, kRegionCount>> sums_;
  double error_sum_ = 0.0;
};

// A named list of pairs, averaged on its own.
struct Group {
  std::string name;
  std::vector<std::string> pairs;
};

// From "name=a,b,c".
bool parse_group(const std::string& argument, Group* group, std::string* error);

}  // namespace bsm::bench

#endif  // BSM_BENCH_SCORE_H
