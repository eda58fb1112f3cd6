// model_sgm.cpp - the plain model up to the winners.
#include "model_sgm.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstdlib>
#include <initializer_list>

#include "core/pattern.h"
#include "simd/lab.h"

namespace bsm::test {
namespace {

constexpr int kMostMargin = 249;

using Bits = std::bitset<BSM_MAX_BITS>;

// One view with the descriptor (eq. 2, 3) and the mask (eq. 5-7) of every pixel.
struct Described {
  const ModelView& view;
  std::vector<Bits> bits, mask;
};

// Samples outside the image repeat its border.
const ModelColor& sample(const ModelView& view, int x, int y) {
  return view.color(std::clamp(x, 0, view.width - 1), std::clamp(y, 0, view.height - 1));
}

Bits descriptor(const ModelView& view, int x, int y, const Pattern& pattern) {
  Bits bits;
  for (int i = 0; i < pattern.bits; ++i) {
    const PixelPair& pair = pattern.pairs[i];
    bits[static_cast<size_t>(i)] = sample(view, x + pair.px, y + pair.py).luma > sample(view, x + pair.qx, y + pair.qy).luma;
  }
  return bits;
}

Bits mask(const ModelView& view, int x, int y, const Pattern& pattern) {
  const ModelColor& center = view.color(x, y);
  std::vector<int> w;
  for (int i = 0; i < pattern.bits; ++i) {
    const PixelPair& pair = pattern.pairs[i];
    w.push_back(std::max(model_sad(center, sample(view, x + pair.px, y + pair.py)),
                         model_sad(center, sample(view, x + pair.qx, y + pair.qy))));
  }
  std::vector<int> sorted = w;
  std::sort(sorted.begin(), sorted.end());
  const int threshold = sorted[static_cast<size_t>(pattern.bits / 4 - 1)];
  Bits bits;
  for (size_t i = 0; i < w.size(); ++i) bits[i] = w[i] <= threshold;
  return bits;
}

Described describe_view(const ModelView& view, const Pattern& pattern) {
  Described described{view, {}, {}};
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      described.bits.push_back(descriptor(view, x, y, pattern));
      described.mask.push_back(mask(view, x, y, pattern));
    }
  }
  return described;
}

// A number for every level of every pixel; kModelNone where the level is no candidate.
struct Volume {
  int levels;
  std::vector<int> values;

  int& at(size_t pixel, int level) { return values[pixel * static_cast<size_t>(levels) + static_cast<size_t>(level)]; }
  int at(size_t pixel, int level) const { return values[pixel * static_cast<size_t>(levels) + static_cast<size_t>(level)]; }
  bool has(size_t pixel, int level) const { return 0 <= level && level < levels && at(pixel, level) != kModelNone; }
  // The level of the least value, the lowest of several; kModelNone without candidates.
  int least(size_t pixel) const {
    int best = kModelNone;
    for (int level = 0; level < levels; ++level) {
      if (has(pixel, level) && (best == kModelNone || at(pixel, level) < at(pixel, best))) best = level;
    }
    return best;
  }
};

// Eq. 4, with a mask eq. 8, for the view `own`; toward = -1 when its disparities lead to smaller x in `other` (the left
// view), +1 for the right view.
Volume cost_volume(const Described& own, const Described& other, int toward, const bsm_config& config, bool masked) {
  const ModelView& view = own.view;
  Volume costs{config.num_disparities, {}};
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const size_t pixel = view.index(x, y);
      for (int level = 0; level < config.num_disparities; ++level) {
        const int matched = x + toward * (config.min_disparity + level);
        if (!view.contains(matched, y)) {
          costs.values.push_back(kModelNone);
          continue;
        }
        Bits different = own.bits[pixel] ^ other.bits[view.index(matched, y)];
        if (masked) different &= own.mask[pixel];
        costs.values.push_back(static_cast<int>(different.count()));
      }
    }
  }
  return costs;
}

// p * bits / 4096 rounded, divided at an edge without its remainder, at least 1.
int penalty(int p, const bsm_config& config, bool edge) {
  const int scaled = static_cast<int>(std::floor(p * config.bits / 4096.0 + 0.5));
  return std::max(1, edge ? scaled / config.edge_divisor : scaled);
}

// Adds L of the path that steps by (rx, ry) to the sums. A path begins with L = C, where the pixel before is outside the
// image or has no candidates. No sum of 8 paths reaches 16 bits: C is at most 1024, L at most C + 4096.
void add_path(const Volume& costs, const ModelView& view, int rx, int ry, const bsm_config& config, Volume* sums) {
  Volume path = costs;
  for (int j = 0; j < view.height; ++j) {
    for (int i = 0; i < view.width; ++i) {
      const int x = rx < 0 ? view.width - 1 - i : i, y = ry < 0 ? view.height - 1 - j : j;  // along the path
      if (!view.contains(x - rx, y - ry)) continue;
      const size_t pixel = view.index(x, y), before = view.index(x - rx, y - ry);
      const int least_level = path.least(before);
      if (least_level == kModelNone) continue;
      const int least = path.at(before, least_level);
      const bool edge = model_sad(view.color(x, y), view.color(x - rx, y - ry)) > config.edge_threshold;
      const int p1 = penalty(config.p1, config, edge), p2 = penalty(config.p2, config, edge);
      for (int level = 0; level < config.num_disparities; ++level) {
        if (!costs.has(pixel, level)) continue;
        int best = least + p2;
        if (path.has(before, level)) best = std::min(best, path.at(before, level));
        if (path.has(before, level - 1)) best = std::min(best, path.at(before, level - 1) + p1);
        if (path.has(before, level + 1)) best = std::min(best, path.at(before, level + 1) + p1);
        path.at(pixel, level) = costs.at(pixel, level) + best - least;
      }
    }
  }
  for (size_t i = 0; i < sums->values.size(); ++i) {
    if (sums->values[i] != kModelNone) sums->values[i] += path.values[i];
  }
}

struct Direction {
  int rx, ry;
};

Volume aggregated(const Volume& costs, const ModelView& view, const std::vector<Direction>& paths,
                  const bsm_config& config) {
  Volume sums = costs;
  for (int& sum : sums.values) sum = sum == kModelNone ? kModelNone : 0;
  for (const Direction& path : paths) add_path(costs, view, path.rx, path.ry, config, &sums);
  return sums;
}

std::vector<Direction> left_paths(int count) {
  std::vector<Direction> paths = {{1, 0}, {-1, 0}, {0, 1}};  // from the left, from the right, from above
  if (count >= 4) paths.push_back({1, 1});                   // from above-left
  if (count >= 5) paths.push_back({-1, 1});                  // from above-right
  if (count == 8) paths.insert(paths.end(), {{0, -1}, {1, -1}, {-1, -1}});
  return paths;
}

// Sixteenths that the equiangular fit adds to a level.
int fraction(const Volume& sums, size_t pixel, int level) {
  if (!sums.has(pixel, level - 1) || !sums.has(pixel, level + 1)) return 0;
  const int a = sums.at(pixel, level - 1) - sums.at(pixel, level);
  const int b = sums.at(pixel, level + 1) - sums.at(pixel, level);
  if (a == 0 && b == 0) return 0;
  return std::min(7, static_cast<int>(std::floor(8.0 * (a - b) / std::max(a, b) + 0.5)));
}

std::vector<int> winners(const Volume& sums, size_t pixels, bool subpixel) {
  std::vector<int> levels;
  for (size_t pixel = 0; pixel < pixels; ++pixel) {
    const int level = sums.least(pixel);
    levels.push_back(level == kModelNone ? kModelNone : 16 * level + (subpixel ? fraction(sums, pixel, level) : 0));
  }
  return levels;
}

// The right view's whole winners from the left view's sums: the least S(x + d, d).
std::vector<int> winners_from_left(const Volume& sums, const ModelView& view, const bsm_config& config) {
  std::vector<int> levels;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      int best = kModelNone, best_sum = 0;
      for (int level = 0; level < config.num_disparities; ++level) {
        const int matched = x + config.min_disparity + level;
        if (!view.contains(matched, y)) continue;
        const int sum = sums.at(view.index(matched, y), level);
        if (best == kModelNone || sum < best_sum) best = level, best_sum = sum;
      }
      levels.push_back(best == kModelNone ? kModelNone : 16 * best);
    }
  }
  return levels;
}

// How far the winner's sum is below every other that is two or more levels away, in 1/512 of the bits.
int margin(const Volume& sums, size_t pixel, const bsm_config& config) {
  const int winner = sums.least(pixel);
  if (winner == kModelNone) return 0;
  int margin = kMostMargin;
  for (int level = 0; level < config.num_disparities; ++level) {
    if (std::abs(level - winner) < 2 || !sums.has(pixel, level)) continue;
    margin = std::min(margin, (sums.at(pixel, level) - sums.at(pixel, winner)) * 512 / config.bits);
  }
  return margin;
}

ModelWinners aggregated_winners(const Described& left, const Described& right, const bsm_config& config) {
  const size_t pixels = left.view.colors.size();
  const bool subpixel = config.subpixel == 1;
  const Volume left_sums =
      aggregated(cost_volume(left, right, -1, config, true), left.view, left_paths(config.paths), config);
  ModelWinners result;
  result.left = winners(left_sums, pixels, subpixel);
  for (size_t pixel = 0; pixel < pixels; ++pixel) result.margin.push_back(margin(left_sums, pixel, config));
  if (config.right_costs == BSM_RIGHT_COSTS_OWN) {
    const Volume costs = cost_volume(right, left, 1, config, true);
    result.right = winners(aggregated(costs, right.view, {{1, 0}, {-1, 0}}, config), pixels, subpixel);
  } else {
    result.right = winners_from_left(left_sums, left.view, config);
  }
  return result;
}

}  // namespace

int model_sad(const ModelColor& x, const ModelColor& y) {
  return std::abs(x.l - y.l) + std::abs(x.a - y.a) + std::abs(x.b - y.b);
}

ModelView model_view(const ColorImage& image, bool gray) {
  ModelView view{image.width, image.height, {}};
  for (size_t i = 0; i < image.rgb.size(); i += 3) {
    const uint8_t g = image.rgb[i + 1], r = gray ? g : image.rgb[i], b = gray ? g : image.rgb[i + 2];
    const Lab lab = lab_from_rgb(r, g, b);
    view.colors.push_back({76 * r + 150 * g + 29 * b, lab.l, gray ? 0 : lab.a, gray ? 0 : lab.b});
  }
  return view;
}

ModelMatches model_matches(const bsm_config& config, const ModelView& left_view, const ModelView& right_view) {
  const bool sgm = config.method == BSM_METHOD_SGM;
  std::vector<PixelPair> pairs(static_cast<size_t>(config.bits));
  const Pattern pattern = sgm                 ? sgm_pattern(config.bits, pairs.data())
                          : config.sigma == 3 ? narrow_pattern(config.bits, pairs.data())
                                              : local_pattern(config.bits, pairs.data());
  const Described left = describe_view(left_view, pattern), right = describe_view(right_view, pattern);
  const size_t pixels = left_view.colors.size();
  ModelMatches matches;
  for (const bool masked : {false, true}) {
    ModelWinners& found = masked ? matches.masked : matches.cost;
    found.left = winners(cost_volume(left, right, -1, config, masked), pixels, false);
    found.right = winners(cost_volume(right, left, 1, config, masked), pixels, false);
  }
  if (sgm) matches.aggregated = aggregated_winners(left, right, config);
  return matches;
}

}  // namespace bsm::test
