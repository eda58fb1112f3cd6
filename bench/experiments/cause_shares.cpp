// Classifies pixels and counts.
#include "bench/experiments/cause_shares.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "bench/truth_regions.h"

namespace bsm::bench {
namespace {

constexpr double kThreshold = 1.0;    // pixels
constexpr int kTextureless2 = 16;     // squared levels
constexpr int32_t kRepeatReach = 3;   // windows of 7 x 7 pixels are compared
constexpr int32_t kLeastShift = 3;    // closer places look alike on any smooth surface
constexpr int kRepeatLevels = 4;      // mean difference that still looks the same
constexpr int32_t kSlopeReach = 4;    // half length of the piece that a slope is taken from
constexpr double kSlope = 0.1;        // pixels of disparity per pixel
constexpr float kSurfaceJump = 2.0f;  // a larger difference is no slope

class Classifier {
 public:
  explicit Classifier(const Pair& pair)
      : pair_(pair), luma_(to_gray(pair.left)), jumps_(near_jumps(pair.truth, host::Mask())) {}

  Cause cause(int32_t x, int32_t y) const {
    const size_t i = index(x, y);
    const double d = pair_.truth.pixels[i];
    if (static_cast<double>(x) - d < 0.0) return kBorder;
    if (pair_.has_region[kNonOccluded] && pair_.masks[kNonOccluded][i] != 255) return kOccluded;
    if (jumps_[i] == 255 ||
        (pair_.official_regions && pair_.masks[kDiscontinuous].size() > i && pair_.masks[kDiscontinuous][i] == 255)) {
      return kDiscontinuity;
    }
    if (textureless(x, y)) return kTextureless;
    if (repeated(x, y)) return kRepeated;
    return slanted(x, y) ? kSlanted : kOther;
  }

 private:
  size_t index(int32_t x, int32_t y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(luma_.width) + static_cast<size_t>(x);
  }
  int luma(int32_t x, int32_t y) const {
    return luma_.pixels[index(std::clamp(x, 0, luma_.width - 1), std::clamp(y, 0, luma_.height - 1))];
  }

  bool textureless(int32_t x, int32_t y) const {
    int sum = 0;
    for (int32_t v = y - 1; v <= y + 1; ++v) {
      for (int32_t u = x - 1; u <= x + 1; ++u) {
        const int difference = luma(u + 1, v) - luma(u, v);
        sum += difference * difference;
      }
    }
    return sum < 9 * kTextureless2;
  }

  bool repeated(int32_t x, int32_t y) const {
    for (int32_t shift = kLeastShift; shift < pair_.num_disparities; ++shift) {
      for (const int32_t other : {x - shift, x + shift}) {
        if (other >= kRepeatReach && other < luma_.width - kRepeatReach && alike(x, other, y)) return true;
      }
    }
    return false;
  }

  bool alike(int32_t a, int32_t b, int32_t y) const {
    constexpr int kSide = 2 * kRepeatReach + 1;
    constexpr int kLimit = kRepeatLevels * kSide * kSide;
    int sum = 0;
    for (int32_t v = y - kRepeatReach; v <= y + kRepeatReach; ++v) {
      for (int32_t u = -kRepeatReach; u <= kRepeatReach; ++u) sum += std::abs(luma(a + u, v) - luma(b + u, v));
      if (sum > kLimit) return false;
    }
    return true;
  }

  // The steeper of the slopes along the row and the column.
  bool slanted(int32_t x, int32_t y) const {
    return std::max(slope(x - kSlopeReach, y, x + kSlopeReach, y), slope(x, y - kSlopeReach, x, y + kSlopeReach)) >= kSlope;
  }

  double slope(int32_t x1, int32_t y1, int32_t x2, int32_t y2) const {
    if (x1 < 0 || y1 < 0 || x2 >= luma_.width || y2 >= luma_.height) return 0.0;
    const float a = pair_.truth.pixels[index(x1, y1)], b = pair_.truth.pixels[index(x2, y2)];
    if (!std::isfinite(a) || !std::isfinite(b) || std::fabs(a - b) > kSurfaceJump) return 0.0;
    return std::fabs(static_cast<double>(a) - static_cast<double>(b)) / (2.0 * kSlopeReach);
  }

  const Pair& pair_;
  host::Image8 luma_;
  host::Mask jumps_;
};

bool counts(const Pair& pair, size_t i) {
  return std::isfinite(pair.truth.pixels[i]) && (pair.masks[kAll].empty() || pair.masks[kAll][i] == 255);
}

bool is_bad(const Pair& pair, const host::DisparityMap& map, size_t i) {
  return !std::isfinite(map.pixels[i]) ||
         std::fabs(static_cast<double>(map.pixels[i]) - static_cast<double>(pair.truth.pixels[i])) > kThreshold;
}

double percent(int64_t part, int64_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

}  // namespace

std::vector<uint8_t> classify(const Pair& pair) {
  const Classifier classifier(pair);
  std::vector<uint8_t> classes(pair.truth.pixels.size(), kOther);
  size_t i = 0;
  for (int32_t y = 0; y < pair.truth.height; ++y) {
    for (int32_t x = 0; x < pair.truth.width; ++x, ++i) {
      if (counts(pair, i)) classes[i] = static_cast<uint8_t>(classifier.cause(x, y));
    }
  }
  return classes;
}

double CauseShares::bad_percent(size_t cause) const {
  return percent(bad_in[cause], counted);
}

double CauseShares::share_percent(size_t cause) const {
  int64_t bad = 0;
  for (const int64_t pixels : bad_in) bad += pixels;
  return percent(bad_in[cause], bad);
}

void CauseShares::add(const CauseShares& other) {
  counted += other.counted;
  for (size_t cause = 0; cause < kCauseCount; ++cause) {
    pixels_in[cause] += other.pixels_in[cause];
    bad_in[cause] += other.bad_in[cause];
  }
}

CauseShares count_causes(const Pair& pair, const std::vector<uint8_t>& classes, const host::DisparityMap& map) {
  CauseShares shares;
  for (size_t i = 0; i < classes.size(); ++i) {
    if (!counts(pair, i)) continue;
    ++shares.counted;
    ++shares.pixels_in[classes[i]];
    if (is_bad(pair, map, i)) ++shares.bad_in[classes[i]];
  }
  return shares;
}

host::Image8 draw_causes(const Pair& pair, const std::vector<uint8_t>& classes, const host::DisparityMap& map) {
  const host::Image8 luma = to_gray(pair.left);
  host::Image8 picture{luma.width, luma.height, 3, {}};
  picture.pixels.reserve(3 * luma.pixels.size());
  for (size_t i = 0; i < classes.size(); ++i) {
    const uint8_t gray = static_cast<uint8_t>(60 + luma.pixels[i] / 2);
    host::Color color{gray, gray, gray};
    if (!std::isfinite(pair.truth.pixels[i])) color = {24, 24, 28};
    if (counts(pair, i) && is_bad(pair, map, i)) color = kCauseColors[classes[i]];
    picture.pixels.insert(picture.pixels.end(), {color.r, color.g, color.b});
  }
  return picture;
}

}  // namespace bsm::bench
