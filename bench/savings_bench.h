// Times each saving of the kernels against the same computation without it, on rows of a real pair.
#ifndef BSM_BENCH_SAVINGS_BENCH_H
#define BSM_BENCH_SAVINGS_BENCH_H

#include <cstdint>
#include <string>

#include "host/config_options.h"

namespace bsm::bench {

struct SavingsBench {
  std::string left, right;     // image files
  host::ConfigOptions config;  // finished
  int32_t repeat = 31;
  std::string filter;  // savings whose "place: name" holds this
  bool list = false;   // print those alone; savings of whole maps are not among them, nor counted
  std::string count;   // "plain" or "saved": run that form alone and take no times, for an emulator that counts
  bool csv = false;
};

// Reads the pair, compares what both forms write, measures and prints. False with a sentence when a file stands in the way
// or a saving changes its output.
bool run_savings_bench(SavingsBench* bench, std::string* error);

}  // namespace bsm::bench

#endif  // BSM_BENCH_SAVINGS_BENCH_H
