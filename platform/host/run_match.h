// Matches two images held in memory with the library: arena, threads, whole frame or row by row, times.
#ifndef BSM_HOST_RUN_MATCH_H
#define BSM_HOST_RUN_MATCH_H

#include <cstdint>
#include <string>
#include <vector>

#include "bsm/bsm.h"
#include "host/image.h"

namespace bsm::host {

struct MatchRequest {
  const Image8* left = nullptr;  // the same size, both gray or both colour; see prepare_pair
  const Image8* right = nullptr;
  bsm_config config{};  // width, height and format are taken from the images; max_jobs is the number of threads
  bool rows = false;    // bsm_push_row and bsm_pull_row in this thread instead of bsm_process
  int32_t repeat = 1;   // how often the pair is matched, each time the same
};

struct MatchResult {
  bsm_config config{};                   // as the context was opened
  std::vector<int16_t> disparity;        // 1/16 pixel, rows without padding
  std::vector<int16_t> right_disparity;  // empty unless config.right_map
  std::vector<uint8_t> confidence;       // empty unless config.confidence
  size_t arena_bytes = 0;
  std::vector<std::string> kernels;  // as kernel_names
  std::vector<double> milliseconds;  // of each repetition, the matching alone

  double fastest() const;
  double median() const;
};

// Makes both images gray or both colour. False when their sizes differ; *error calls them by the names.
bool prepare_pair(Image8* left, const std::string& left_name, Image8* right, const std::string& right_name,
                  std::string* error);

// False with *status when the library refuses; BSM_ERROR_ARENA when the memory cannot be had.
bool run_match(const MatchRequest& request, MatchResult* result, bsm_status* status);

// Names of the kernels that a context runs, in the order of bsm_kernel.
std::vector<std::string> kernel_names(const bsm_context* context);

}  // namespace bsm::host

#endif  // BSM_HOST_RUN_MATCH_H
