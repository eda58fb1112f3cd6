// Measures a disparity map against ground truth as the Middlebury benchmark does.
#ifndef BSM_HOST_EVALUATE_H
#define BSM_HOST_EVALUATE_H

#include <cstdint>
#include <vector>

#include "host/disparity_file.h"

namespace bsm::host {

// Which pixels count: rows without padding, 255 = counts, anything else = does not. Empty = every pixel.
using Mask = std::vector<uint8_t>;

// Thresholds that are always counted beside the one asked for, in pixels.
constexpr double kCommonThresholds[] = {0.5, 1.0, 2.0, 4.0};
constexpr int kCommonThresholdCount = 4;

struct Evaluation {
  int64_t counted = 0;                         // pixels where the mask is 255 and the truth is known
  int64_t bad = 0;                             // of those: error strictly above the threshold, or invalid
  int64_t invalid = 0;                         // of those: without a disparity
  int64_t bad_at[kCommonThresholdCount] = {};  // bad at kCommonThresholds
  double error_sum = 0.0;                      // sum of |d - truth| over the counted pixels that are valid

  // Percentage of the counted pixels; 0 when none counts.
  double percent(int64_t pixels) const;
  double bad_percent() const { return percent(bad); }
  // Mean of |d - truth| over the counted, valid pixels; 0 when there are none.
  double mean_error() const;
};

// The maps have the same size, and so has the mask when it is not empty.
Evaluation evaluate(const DisparityMap& result, const DisparityMap& truth, const Mask& mask, double threshold);

// The left pixels that the right view shows too: those with known truth d whose right pixel, x - d rounded to nearest, lies
// in the image and has a known truth within one pixel of d. The maps have the same size.
Mask cross_check(const DisparityMap& truth_left, const DisparityMap& truth_right);

}  // namespace bsm::host

#endif  // BSM_HOST_EVALUATE_H
