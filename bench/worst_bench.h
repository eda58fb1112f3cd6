// Times frames of views that have nothing to match beside a given pair.
#ifndef BSM_BENCH_WORST_BENCH_H
#define BSM_BENCH_WORST_BENCH_H

#include <cstdint>
#include <string>

namespace bsm::bench {

struct WorstBench {
  std::string left, right;  // image files
  std::string isa = "auto";
  uint32_t isa_mask = 0;
  int32_t disparities = 64;
  int32_t repeat = 5;
  bool csv = false;
};

// Reads the pair, measures and prints. False with a sentence when a file or the machine stands in the way.
bool run_worst_bench(const WorstBench& bench, std::string* error);

}  // namespace bsm::bench

#endif  // BSM_BENCH_WORST_BENCH_H
