// Published numbers that the experiments print beside their own.
#ifndef BSM_BENCH_EXPERIMENTS_PAPER_VALUES_H
#define BSM_BENCH_EXPERIMENTS_PAPER_VALUES_H

#include <cstddef>

namespace bsm::bench {

// Bad pixels at threshold 1 (nonocc, all, disc), percent.
struct PublishedPair {
  const char* pair;
  double bad[3];
};

// A row of the paper's table 1; pairs without a name were not at hand.
struct PublishedRow {
  const char* name;
  double average;
  PublishedPair pairs[4];
};

constexpr PublishedRow kPublishedRows[] = {
    {"PatchMatch Stereo",
     4.59,
     {{"tsukuba", {2.09, 2.33, 9.31}},
      {"venus", {0.21, 0.39, 2.62}},
      {"teddy", {2.99, 8.16, 9.62}},
      {"cones", {2.47, 7.80, 7.11}}}},
    {"BSM (the paper)", 5.42, {}},
    {"CostFilter",
     5.55,
     {{"tsukuba", {1.51, 1.85, 7.61}},
      {"venus", {0.20, 0.39, 2.42}},
      {"teddy", {6.16, 11.8, 16.0}},
      {"cones", {2.71, 8.24, 7.66}}}},
    {"P-LinearS", 5.68, {}},
    {"GeoSup", 5.80, {}},
    {"ADCensus",
     3.97,
     {{"tsukuba", {1.07, 1.48, 5.73}},
      {"venus", {0.09, 0.25, 1.15}},
      {"teddy", {4.10, 6.22, 10.9}},
      {"cones", {2.42, 7.25, 6.95}}}},
};

// The paper's table 2: seconds for teddy on one core of the time.
struct PublishedTime {
  const char* name;
  const char* machine;
  double seconds;
};
constexpr PublishedTime kPublishedTimes[] = {
    {"BSM (the paper)", "2.67 GHz", 50.0},
    {"P-LinearS (the paper)", "2.13 GHz", 94.0},
};

constexpr double kPaperAverage = 5.42;
constexpr double kPatchMatchAverage = 4.59;

}  // namespace bsm::bench

#endif  // BSM_BENCH_EXPERIMENTS_PAPER_VALUES_H
