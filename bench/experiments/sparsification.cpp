// Computes sparsification curves.
#include "bench/experiments/sparsification.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bsm::bench {
namespace {

constexpr int kSteps = 100;
constexpr int kLastStep = kSteps - 1;  // something remains
constexpr double kThreshold = 1.0;

// Mean height between straight lines through the points; the last step goes on as it began.
double area_under(const std::vector<double>& curve) {
  double sum = 0.0;
  for (size_t i = 0; i < curve.size(); ++i) sum += (curve[i] + curve[std::min(i + 1, curve.size() - 1)]) / 2.0;
  return curve.empty() ? 0.0 : sum / static_cast<double>(curve.size());
}

}  // namespace

Sparsification sparsify(const Pair& pair, const host::DisparityMap& map, const std::vector<uint8_t>& confidence) {
  std::array<double, 256> pixels{}, bad{};
  double all_pixels = 0.0, all_bad = 0.0;
  for (size_t i = 0; i < confidence.size(); ++i) {
    if (!std::isfinite(pair.truth.pixels[i]) || (!pair.masks[kAll].empty() && pair.masks[kAll][i] != 255)) continue;
    const double error = std::fabs(static_cast<double>(map.pixels[i]) - static_cast<double>(pair.truth.pixels[i]));
    const double one_bad = std::isfinite(map.pixels[i]) && error <= kThreshold ? 0.0 : 1.0;
    pixels[confidence[i]] += 1.0;
    bad[confidence[i]] += one_bad;
    all_pixels += 1.0;
    all_bad += one_bad;
  }
  Sparsification curve;
  size_t level = 0;
  double below = 0.0, bad_below = 0.0;  // of the levels that are removed entirely
  for (int step = 0; step <= kLastStep; ++step) {
    const double removed = all_pixels * step / kSteps, remaining = all_pixels - removed;
    while (level < 255 && below + pixels[level] <= removed) {
      below += pixels[level];
      bad_below += bad[level];
      ++level;
    }
    const double share = pixels[level] > 0.0 ? std::min(1.0, (removed - below) / pixels[level]) : 0.0;
    const double bad_removed = bad_below + share * bad[level];
    curve.removed.push_back(100.0 * step / kSteps);
    curve.error.push_back(remaining > 0.0 ? 100.0 * (all_bad - bad_removed) / remaining : 0.0);
    curve.ideal.push_back(remaining > 0.0 ? 100.0 * std::max(0.0, all_bad - removed) / remaining : 0.0);
  }
  curve.area = area_under(curve.error);
  curve.ideal_area = area_under(curve.ideal);
  return curve;
}

Sparsification mean_of(const std::vector<Sparsification>& curves) {
  Sparsification mean = curves.front();
  const double count = static_cast<double>(curves.size());
  for (size_t i = 0; i < mean.removed.size(); ++i) {
    mean.error[i] = mean.ideal[i] = 0.0;
    for (const Sparsification& curve : curves) {
      mean.error[i] += curve.error[i] / count;
      mean.ideal[i] += curve.ideal[i] / count;
    }
  }
  mean.area = area_under(mean.error);
  mean.ideal_area = area_under(mean.ideal);
  return mean;
}

}  // namespace bsm::bench
