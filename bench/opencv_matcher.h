// OpenCV's block matchers on the same pairs, where OpenCV was found when this was built.
#ifndef BSM_BENCH_OPENCV_MATCHER_H
#define BSM_BENCH_OPENCV_MATCHER_H

#include <memory>
#include <string>

#include "bench/pair_set.h"
#include "host/disparity_file.h"

namespace bsm::bench {

bool opencv_available();

// "OpenCV" and its version, for reports.
std::string opencv_name();

// Block: StereoBM, 9 x 9 blocks; gray views alone. Sgbm: StereoSGBM, 3 x 3 blocks, P1 = 8 x 9 and P2 = 32 x 9 per channel,
// 3-way or 5-path. Both views' maps are checked within one pixel; filters and thresholds are those of least error.
enum class OpencvMethod { kBlock, kSgbm3Way, kSgbm5Path };

// A matcher and the views of a pair, which are extended to the left by the number of disparities so that the whole width is
// searched. Everything runs in one thread.
class OpencvMatcher {
 public:
  OpencvMatcher(const Pair& pair, OpencvMethod method);
  ~OpencvMatcher();
  OpencvMatcher(const OpencvMatcher&) = delete;
  OpencvMatcher& operator=(const OpencvMatcher&) = delete;

  // Matches once; returns the milliseconds of OpenCV's own work: neither extending the views nor filling holes counts.
  double match();
  // The map of the last match. Holes take the lower of the nearest disparities of their row: a dense map.
  host::DisparityMap map() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace bsm::bench

#endif  // BSM_BENCH_OPENCV_MATCHER_H
