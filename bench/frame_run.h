// A context that matches whole frames, one timed run after another, so that several can take turns.
#ifndef BSM_BENCH_FRAME_RUN_H
#define BSM_BENCH_FRAME_RUN_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bsm/bsm.h"
#include "host/arena.h"
#include "host/image.h"
#include "host/thread_pool.h"

namespace bsm::bench {

class FrameRun {
 public:
  // Opens a context; false with a sentence when the library refuses or memory is short.
  bool open(const bsm_config& config, std::string* error);
  // Matches a pair of the configuration's size and format; false with a sentence.
  bool match(const host::Image8& left, const host::Image8& right, double* milliseconds, std::string* error);

  const bsm_config& config() const { return config_; }
  const bsm_context* context() const { return context_; }
  size_t arena_bytes() const { return arena_.size(); }
  // The map of the last match, rows without padding.
  const std::vector<int16_t>& disparity() const { return disparity_; }

 private:
  bsm_config config_{};
  host::Arena arena_;
  bsm_context* context_ = nullptr;
  std::vector<int16_t> disparity_;
  std::unique_ptr<host::ThreadPool> threads_;
};

// Two PPM or PGM files as a pair of one size, both gray or both colour.
bool read_views(const std::string& left_path, const std::string& right_path, host::Image8* left, host::Image8* right,
                std::string* error);

}  // namespace bsm::bench

#endif  // BSM_BENCH_FRAME_RUN_H
