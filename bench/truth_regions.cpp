// Finds the neighbourhood of disparity jumps.
#include "bench/truth_regions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bsm::bench {
namespace {

constexpr float kJump = 2.0f;
constexpr int32_t kReach = 4;  // a window of 9 x 9 pixels

bool jump(float a, float b) {
  return std::isfinite(a) && std::isfinite(b) && std::fabs(a - b) > kJump;
}

}  // namespace

host::Mask near_jumps(const host::DisparityMap& truth, const host::Mask& visible) {
  const int32_t width = truth.width, height = truth.height;
  host::Mask mask(truth.pixels.size(), 0);
  const auto index = [width](int32_t x, int32_t y) {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  };
  for (int32_t y = 0; y < height; ++y) {
    for (int32_t x = 0; x < width; ++x) {
      const float d = truth.pixels[index(x, y)];
      const bool edge = (x + 1 < width && jump(d, truth.pixels[index(x + 1, y)])) ||
                        (y + 1 < height && jump(d, truth.pixels[index(x, y + 1)]));
      if (!edge) continue;
      for (int32_t v = std::max(0, y - kReach); v <= std::min(height - 1, y + kReach); ++v) {
        for (int32_t u = std::max(0, x - kReach); u <= std::min(width - 1, x + kReach); ++u) mask[index(u, v)] = 255;
      }
    }
  }
  for (size_t i = 0; i < mask.size() && !visible.empty(); ++i) {
    if (visible[i] != 255) mask[i] = 0;
  }
  return mask;
}

}  // namespace bsm::bench
