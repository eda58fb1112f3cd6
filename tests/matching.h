// matching.h - runs the library the way its users do: an arena between guard zones, whole frames, and rows pushed and
// pulled.
#ifndef BSM_TESTS_MATCHING_H
#define BSM_TESTS_MATCHING_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bsm/bsm.h"
#include "images.h"

namespace bsm::test {

// A value that no map holds, not even as an invalid pixel: shows pixels left unwritten.
inline constexpr int16_t kUnwritten = INT16_MAX;

// The outputs of one image, rows without gaps; right is empty without right_map, confidence without confidence.
struct Maps {
  int width = 0, height = 0;
  std::vector<int16_t> left, right;
  std::vector<uint8_t> confidence;
};

// Reports the first pixel in which two maps differ. True when they are equal.
bool check_same_map(const std::vector<int16_t>& a, const std::vector<int16_t>& b, int width, const char* what);
bool check_same_map(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b, int width, const char* what);
bool check_same(const Maps& a, const Maps& b);

// Memory for a context with guard zones on both sides and a chosen distance from 64-byte alignment. The destructor fails the
// case when a guard byte has changed.
class Arena {
 public:
  explicit Arena(size_t bytes, size_t misalignment = 0);
  ~Arena();
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;
  void* data() { return storage_.data() + offset_; }
  size_t size() const { return bytes_; }
  bool guards_intact() const;

 private:
  std::vector<uint8_t> storage_;
  size_t offset_ = 0, bytes_ = 0;
};

// One line that names everything in a configuration that differs from the defaults, for Scope.
std::string describe(const bsm_config& config);

// A frame that reads the pair and writes the maps, which are made as large as the configuration says and filled with
// kUnwritten.
bsm_frame frame_for(const bsm_config& config, const EncodedPair& pair, Maps& maps);

// Configuration for images of this size and format: the preset paper, and the defaults otherwise.
bsm_config config_for(int width, int height, bsm_format format = BSM_FORMAT_RGB24);

// Gives every field of costs, aggregation, check and refinement a random value that is allowed, small enough to be quick;
// the method is semi-global in half of the cases, with paths that the row API can carry unless `whole_frame`.
void randomize(Rng& rng, bsm_config& config, bool whole_frame = false);

// Such a configuration in any format, for up to three jobs.
bsm_config any_config(Rng& rng, int width, int height, bool whole_frame = false);

// Masks for bsm_config::isa_mask, each of which chooses other kernels here: 0 (scalar) first, the best kernels last.
std::vector<uint32_t> isa_masks();

// Name of the instruction set of the best kernels that this machine runs under such a mask, as in simd/kernels.def.
std::string best_isa(uint32_t isa_mask);

size_t arena_bytes(const bsm_config& config);

// How the jobs of a frame are run.
enum class Jobs {
  kNone,      // parallel_for = NULL
  kInOrder,   // one thread, 0, 1, 2, ...
  kReversed,  // one thread, last job first
  kShuffled,  // one thread, a fixed shuffle
  kThreads,   // one std::thread for each job
};
inline constexpr Jobs kAllJobs[] = {Jobs::kNone, Jobs::kInOrder, Jobs::kReversed, Jobs::kShuffled, Jobs::kThreads};
const char* jobs_name(Jobs jobs);
bsm_parallel_for parallel_for_of(Jobs jobs);

// Matches a frame in an exact-size arena. Fails the case when the library reports an error.
Maps match_frame(const bsm_config& config, const EncodedPair& pair, Jobs jobs = Jobs::kNone);

// The same through the row API.
Maps match_rows(const bsm_config& config, const EncodedPair& pair);

// Pushes and pulls `rows` rows (all of the pair's when negative) through an open context and checks the protocol on the way:
// each pull returns exactly what the delay promises. Ends with BSM_END.
Maps stream_rows(bsm_context* context, const bsm_config& config, const EncodedPair& pair, int rows = -1);

}  // namespace bsm::test

#endif  // BSM_TESTS_MATCHING_H
