// model.cpp - the plain model, one function for each equation or decision.
#include "model.h"

#include <algorithm>
#include <cstdlib>
#include <map>

#include "core/pattern.h"
#include "core/weights.h"
#include "simd/lab.h"

namespace bsm::test {
namespace {

constexpr int kNone = -1;  // a pixel without a disparity

struct Color {
  int luma, l, a, b;
};

// One view, with everything that the matching needs of each pixel.
struct View {
  int width, height;
  std::vector<Color> colors;
  std::vector<std::vector<uint8_t>> bits;  // eq. 2, 3: 0 or 1
  std::vector<std::vector<uint8_t>> mask;  // eq. 5-7: 0 or 1

  size_t index(int x, int y) const { return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x); }
  // Samples outside the image repeat its border.
  const Color& color(int x, int y) const { return colors[index(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1))]; }
};

// Disparity levels of a map: 0 .. num_disparities - 1, or kNone.
using Levels = std::vector<int>;

int sad(const Color& x, const Color& y) {
  return std::abs(x.l - y.l) + std::abs(x.a - y.a) + std::abs(x.b - y.b);
}  // eq. 5

std::vector<Color> colors_of(const ColorImage& image, bool gray) {
  std::vector<Color> colors;
  for (size_t i = 0; i < image.rgb.size(); i += 3) {
    const uint8_t r = gray ? image.rgb[i + 1] : image.rgb[i], g = image.rgb[i + 1], b = gray ? g : image.rgb[i + 2];
    const Lab lab = lab_from_rgb(r, g, b);
    const int luma = image.luma.empty() ? 76 * r + 150 * g + 29 * b : 255 * image.luma[i / 3];
    colors.push_back({luma, lab.l, gray ? 0 : lab.a, gray ? 0 : lab.b});
  }
  return colors;
}

std::vector<uint8_t> descriptor(const View& view, int x, int y, const Pattern& pattern) {
  std::vector<uint8_t> bits;
  for (int i = 0; i < pattern.bits; ++i) {
    const PixelPair& pair = pattern.pairs[i];
    bits.push_back(view.color(x + pair.px, y + pair.py).luma > view.color(x + pair.qx, y + pair.qy).luma);
  }
  return bits;
}

std::vector<uint8_t> mask(const View& view, int x, int y, const Pattern& pattern) {
  std::vector<int> w;
  for (int i = 0; i < pattern.bits; ++i) {
    const PixelPair& pair = pattern.pairs[i];
    const Color& center = view.color(x, y);
    w.push_back(
        std::max(sad(center, view.color(x + pair.px, y + pair.py)), sad(center, view.color(x + pair.qx, y + pair.qy))));
  }
  std::vector<int> sorted = w;
  std::sort(sorted.begin(), sorted.end());
  const int threshold = sorted[static_cast<size_t>(pattern.bits / 4 - 1)];
  std::vector<uint8_t> bits;
  for (const int value : w) bits.push_back(value <= threshold);
  return bits;
}

View make_view(const ColorImage& image, bool gray, const Pattern& pattern) {
  View view{image.width, image.height, colors_of(image, gray), {}, {}};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      view.bits.push_back(descriptor(view, x, y, pattern));
      view.mask.push_back(mask(view, x, y, pattern));
    }
  }
  return view;
}

// Eq. 4 without a mask, eq. 8 with one.
int hamming(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b, const std::vector<uint8_t>* mask) {
  int cost = 0;
  for (size_t i = 0; i < a.size(); ++i) cost += (a[i] != b[i]) & (mask ? (*mask)[i] : 1);
  return cost;
}

// Eq. 1 for the view `from`; toward = -1 when its disparities lead to smaller x in `to` (the left view), +1 for the right.
Levels winners(const View& from, const View& to, int toward, const bsm_config& config, bool masked) {
  Levels levels;
  for (int y = 0; y < from.height; ++y) {
    for (int x = 0; x < from.width; ++x) {
      int best = kNone, best_cost = 0;
      for (int level = 0; level < config.num_disparities; ++level) {
        const int other = x + toward * (config.min_disparity + level);
        if (other < 0 || other >= to.width) continue;
        const size_t pixel = from.index(x, y);
        const int cost = hamming(from.bits[pixel], to.bits[to.index(other, y)], masked ? &from.mask[pixel] : nullptr);
        if (best == kNone || cost < best_cost) best = level, best_cost = cost;
      }
      levels.push_back(best);
    }
  }
  return levels;
}

Levels checked(const Levels& levels, const Levels& other, const View& view, int toward, const bsm_config& config) {
  Levels result = levels;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const int level = levels[view.index(x, y)];
      if (level == kNone) continue;
      const int answer = other[view.index(x + toward * (config.min_disparity + level), y)];
      if (answer == kNone || std::abs(answer - level) > config.lr_tolerance) result[view.index(x, y)] = kNone;
    }
  }
  return result;
}

int vote_weight(const Color& a, const Color& b, int dx, int dy, const bsm_config& config) {  // eq. 10
  const int color_steps =
      static_cast<int>((static_cast<uint32_t>(sad(a, b)) * vote_color_scale(config.vote_color) + 512) >> 10);
  const int steps = color_steps + vote_distance_steps(dx, dy, config.vote_distance);
  return steps < VoteWeights::kCount ? kVoteWeights.weight[steps] : 0;
}

Levels voted(const Levels& levels, const View& view, const bsm_config& config) {  // eq. 9
  Levels result = levels;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      if (levels[view.index(x, y)] != kNone) continue;
      std::map<int, int64_t> votes;
      for (int j = std::max(0, y - config.vote_radius); j <= std::min(view.height - 1, y + config.vote_radius); ++j) {
        for (int i = std::max(0, x - config.vote_radius); i <= std::min(view.width - 1, x + config.vote_radius); ++i) {
          const int level = levels[view.index(i, j)];
          if (level == kNone) continue;
          votes[level] += vote_weight(view.color(x, y), view.color(i, j), std::abs(i - x), std::abs(j - y), config);
        }
      }
      int best = kNone;
      int64_t most = 0;
      for (const auto& [level, sum] : votes) {
        if (sum > most) best = level, most = sum;
      }
      result[view.index(x, y)] = best;
    }
  }
  return result;
}

// A pixel without a vote takes the nearest valid disparity of its row in the checked map, the left one of two as near; in a
// row without any it takes the result of the row above; in a first row without any it takes the smallest disparity.
Levels filled(const Levels& levels, const Levels& valid, const View& view) {
  Levels result = levels;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      if (levels[view.index(x, y)] != kNone) continue;
      int found = kNone;
      for (int distance = 1; distance < view.width && found == kNone; ++distance) {
        if (x + distance < view.width) found = valid[view.index(x + distance, y)];
        if (x - distance >= 0 && valid[view.index(x - distance, y)] != kNone) found = valid[view.index(x - distance, y)];
      }
      if (found == kNone) found = y > 0 ? result[view.index(x, y - 1)] : 0;
      result[view.index(x, y)] = found;
    }
  }
  return result;
}

Levels median3x3(const Levels& levels, const View& view) {
  Levels result;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      std::vector<int> window;
      for (int j = y - 1; j <= y + 1; ++j) {
        for (int i = x - 1; i <= x + 1; ++i) {
          window.push_back(levels[view.index(std::clamp(i, 0, view.width - 1), std::clamp(j, 0, view.height - 1))]);
        }
      }
      std::sort(window.begin(), window.end());
      result.push_back(window[4]);
    }
  }
  return result;
}

std::vector<int16_t> values(const Levels& levels, const bsm_config& config) {
  std::vector<int16_t> result;
  for (const int level : levels) {  // kNone becomes (min_disparity - 1) * 16
    result.push_back(static_cast<int16_t>((config.min_disparity + level) * BSM_DISPARITY_SCALE));
  }
  return result;
}

}  // namespace

ModelMaps run_model(const bsm_config& config, const ColorPair& pair) {
  const bool gray = config.format == BSM_FORMAT_GRAY8;
  std::vector<PixelPair> pairs(static_cast<size_t>(config.bits));
  const Pattern pattern = local_pattern(config.bits, pairs.data());
  const View left = make_view(pair.left, gray, pattern), right = make_view(pair.right, gray, pattern);
  const auto refined = [&config](const Levels& levels, const View& view) {
    const Levels dense = filled(voted(levels, view, config), levels, view);
    return config.median ? median3x3(dense, view) : dense;
  };
  ModelMaps maps;
  maps.left[BSM_STAGE_COST] = values(winners(left, right, -1, config, false), config);
  maps.right[BSM_STAGE_COST] = values(winners(right, left, 1, config, false), config);
  const Levels left_levels = winners(left, right, -1, config, true), right_levels = winners(right, left, 1, config, true);
  maps.left[BSM_STAGE_MASKED] = values(left_levels, config);
  maps.right[BSM_STAGE_MASKED] = values(right_levels, config);
  const Levels left_checked = checked(left_levels, right_levels, left, -1, config);
  const Levels right_checked = checked(right_levels, left_levels, right, 1, config);
  maps.left[BSM_STAGE_CHECKED] = values(left_checked, config);
  maps.right[BSM_STAGE_CHECKED] = values(right_checked, config);
  maps.left[BSM_STAGE_REFINED] = values(refined(left_checked, left), config);
  maps.right[BSM_STAGE_REFINED] = values(refined(right_checked, right), config);
  return maps;
}

}  // namespace bsm::test
