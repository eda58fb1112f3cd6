// Matches a pair of a set with the library and keeps what the measurements ask for.
#ifndef BSM_BENCH_MATCH_PAIR_H
#define BSM_BENCH_MATCH_PAIR_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/pair_set.h"
#include "bsm/bsm.h"
#include "host/disparity_file.h"

namespace bsm::bench {

struct Match {
  bsm_config config{};              // as the context was opened
  std::vector<int16_t> values;      // 1/16 pixel, rows without padding
  std::vector<uint8_t> confidence;  // empty unless the library made one
  host::DisparityMap map;           // the same in pixels
  double ms_min = 0.0;              // of the matching alone
  double ms_median = 0.0;
  size_t arena_bytes = 0;
};

// Sizes and format are the pair's; the disparities are those of config. False with a sentence when the library refuses.
bool match_pair(const Pair& pair, const bsm_config& config, int32_t repeat, Match* match, std::string* error);

}  // namespace bsm::bench

#endif  // BSM_BENCH_MATCH_PAIR_H
