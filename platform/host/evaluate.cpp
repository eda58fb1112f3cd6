// Measures a disparity map against ground truth.
#include "host/evaluate.h"

#include <cmath>

namespace bsm::host {
namespace {

constexpr double kCrossCheckTolerance = 1.0;

bool known(float disparity) {
  return std::isfinite(disparity);
}

}  // namespace

double Evaluation::percent(int64_t pixels) const {
  return counted > 0 ? 100.0 * static_cast<double>(pixels) / static_cast<double>(counted) : 0.0;
}

double Evaluation::mean_error() const {
  return counted > invalid ? error_sum / static_cast<double>(counted - invalid) : 0.0;
}

Evaluation evaluate(const DisparityMap& result, const DisparityMap& truth, const Mask& mask, double threshold) {
  Evaluation evaluation;
  for (size_t i = 0; i < truth.pixels.size(); ++i) {
    if (!known(truth.pixels[i]) || (!mask.empty() && mask[i] != 255)) continue;
    ++evaluation.counted;
    if (!known(result.pixels[i])) {
      ++evaluation.invalid;
      ++evaluation.bad;
      for (int64_t& bad : evaluation.bad_at) ++bad;
      continue;
    }
    const double error = std::fabs(static_cast<double>(result.pixels[i]) - static_cast<double>(truth.pixels[i]));
    evaluation.error_sum += error;
    if (error > threshold) ++evaluation.bad;
    for (int t = 0; t < kCommonThresholdCount; ++t) {
      if (error > kCommonThresholds[t]) ++evaluation.bad_at[t];
    }
  }
  return evaluation;
}

Mask cross_check(const DisparityMap& truth_left, const DisparityMap& truth_right) {
  Mask mask(truth_left.pixels.size(), 0);
  for (int32_t y = 0; y < truth_left.height; ++y) {
    const size_t row = static_cast<size_t>(y) * static_cast<size_t>(truth_left.width);
    for (int32_t x = 0; x < truth_left.width; ++x) {
      const size_t i = row + static_cast<size_t>(x);
      const double d = truth_left.pixels[i];
      if (!std::isfinite(d)) continue;
      const double right_x = std::floor(x - d + 0.5);
      if (right_x < 0.0 || right_x >= truth_left.width) continue;
      const float other = truth_right.pixels[row + static_cast<size_t>(right_x)];
      if (known(other) && std::fabs(static_cast<double>(other) - d) <= kCrossCheckTolerance) mask[i] = 255;
    }
  }
  return mask;
}

}  // namespace bsm::host
