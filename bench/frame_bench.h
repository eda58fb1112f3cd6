// Times whole frames, and the stages of a frame as differences of whole runs.
#ifndef BSM_BENCH_FRAME_BENCH_H
#define BSM_BENCH_FRAME_BENCH_H

#include <cstdint>
#include <string>

#include "host/config_options.h"

namespace bsm::bench {

struct FrameBench {
  std::string left, right;     // image files
  host::ConfigOptions config;  // finished
  int32_t repeat = 9;
  bool lengths = false;  // whole frames at several descriptor lengths instead of the stages of one
  bool csv = false;
};

// Reads the pair, measures and prints. False with a sentence when a file or the machine stands in the way.
bool run_frame_bench(FrameBench* bench, std::string* error);

}  // namespace bsm::bench

#endif  // BSM_BENCH_FRAME_BENCH_H
