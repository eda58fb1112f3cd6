// model_sparse.cpp - the plain model from the winners to the sparse map.
#include "model_sparse.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace bsm::test {
namespace {

// The pixel of the other view that pixel x shows; toward as in the winners: -1 for the left view, +1 for the right.
int matched(int x, int level, int toward, const bsm_config& config) {
  return x + toward * (config.min_disparity + model_whole(level));
}

// The line through the first surface of a row, in the units of core/border.h.
struct Line {
  int first = -1;  // no surface
  int64_t position = 0, level = 0, spread = 0, slant = 0;
};

int64_t rounded(int64_t numerator, int64_t divisor) {
  return std::llround(static_cast<double>(numerator) / static_cast<double>(divisor));  // halves away from zero
}

// A valid pixel that agrees within 1.5 levels with at least 3 of the 4 pixels from it on, itself included.
bool begins_surface(const ModelLevels& row, size_t first) {
  int agreeing = 0;
  for (size_t i = first; i < std::min(first + 4, row.size()); ++i) {
    agreeing += model_valid(row[i]) && std::abs(row[i] - row[first]) <= 24;
  }
  return model_valid(row[first]) && agreeing >= 3;
}

// The surface spans 24 pixels or up to the first step of more than 1.5 levels between valid pixels.
Line fit(const ModelLevels& row, int reach) {
  size_t first = 0;
  const size_t end = std::min(row.size(), static_cast<size_t>(reach));
  while (first < end && !begins_surface(row, first)) ++first;
  if (first == end) return Line{};
  int64_t n = 0, sum_p = 0, sum_l = 0, sum_pp = 0, sum_pl = 0;
  int last = row[first];
  for (size_t i = first; i < std::min(first + 24, row.size()); ++i) {
    if (!model_valid(row[i])) continue;
    if (std::abs(row[i] - last) > 24) break;
    last = row[i];
    const int64_t p = static_cast<int64_t>(i - first), l = row[i] - row[first];
    n += 1, sum_p += p, sum_l += l, sum_pp += p * p, sum_pl += p * l;
  }
  // Means, and n times the sums of squares about them; rounded relative to the first pixel.
  return Line{static_cast<int>(first), 256 * static_cast<int64_t>(first) + rounded(256 * sum_p, n),
              256 * static_cast<int64_t>(row[first]) + rounded(256 * sum_l, n),
              rounded(64 * (n * sum_pp - sum_p * sum_p), n), rounded(64 * (n * sum_pl - sum_p * sum_l), n)};
}

// Writes the pixels in front of the surface of row y. The slope is shared by the rows up to 16 away whose mean level is
// within 2 levels; it is at most 1.5 sixteenths a pixel.
void continue_to_border(const std::vector<Line>& lines, size_t y, const bsm_config& config, ModelLevels* row) {
  const Line& own = lines[y];
  int64_t spread = 0, slant = 0;
  for (size_t j = y < 16 ? 0 : y - 16; j < lines.size() && j <= y + 16; ++j) {
    if (lines[j].first < 0 || std::abs(lines[j].level - own.level) > 2 * 16 * 256) continue;
    spread += lines[j].spread;
    slant += lines[j].slant;
  }
  const int64_t slope = spread == 0 ? 0 : std::clamp<int64_t>(slant * 65536 / spread, -3 * 65536 / 2, 3 * 65536 / 2);
  for (int p = 0; p < own.first; ++p) {
    const int64_t level = own.level * 65536 + slope * (p * 256 - own.position);  // in 2^-24 of 1/16 pixel
    const double nearest = std::floor(static_cast<double>(level) / (1 << 24) + 0.5);
    (*row)[static_cast<size_t>(p)] = std::clamp(static_cast<int>(nearest), 0, 16 * (config.num_disparities - 1));
  }
}

}  // namespace

ModelLevels model_checked(const ModelLevels& levels, const ModelLevels& others, const ModelView& view, int toward,
                          const bsm_config& config) {
  ModelLevels result(levels.size(), kModelOccluded);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const int other = others[view.index(x, y)];
      if (model_valid(other)) result[view.index(matched(x, other, -toward, config), y)] = kModelNone;
    }
  }
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const int level = levels[view.index(x, y)];
      if (!model_valid(level)) continue;
      const int back = others[view.index(matched(x, level, toward, config), y)];
      if (std::abs(model_whole(back) - model_whole(level)) <= config.lr_tolerance) result[view.index(x, y)] = level;
    }
  }
  return result;
}

// Valid pixels with too few supporters among every second one of the 9 x 9 pixels around them become holes.
ModelLevels model_despeckled(const ModelLevels& levels, const ModelView& view, const bsm_config& config) {
  ModelLevels result = levels;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const int own = levels[view.index(x, y)];
      int asked = 0, supporting = 0;
      for (int j = y - 4; j <= y + 4; j += 2) {
        for (int i = x - 4; i <= x + 4; i += 2) {
          if (!view.contains(i, j)) continue;
          const int level = levels[view.index(i, j)];
          ++asked;
          supporting += model_valid(level) && std::abs(level - own) <= 24;
        }
      }
      if (model_valid(own) && 100 * supporting < config.speckle * asked) result[view.index(x, y)] = kModelNone;
    }
  }
  return result;
}

// The border lies where the other view's image ends: left for a left view whose disparities are mostly positive. A surface
// begins within the largest disparity, of either sign, and 16 pixels.
ModelSparse model_continued(const ModelLevels& levels, const ModelView& view, int toward, const bsm_config& config) {
  ModelSparse result{levels, std::vector<bool>(levels.size(), true)};
  if (!config.border) return result;
  const int smallest = config.min_disparity, largest = smallest + config.num_disparities - 1;
  const bool at_left = (smallest + largest + 1 > 0) == (toward < 0);
  std::vector<ModelLevels> rows;
  std::vector<Line> lines;
  for (int y = 0; y < view.height; ++y) {
    ModelLevels row(levels.begin() + y * view.width, levels.begin() + (y + 1) * view.width);
    if (!at_left) std::reverse(row.begin(), row.end());
    lines.push_back(fit(row, std::max(largest, -smallest) + 16));
    rows.push_back(row);
  }
  for (int y = 0; y < view.height; ++y) {
    const size_t j = static_cast<size_t>(y);
    continue_to_border(lines, j, config, &rows[j]);
    for (int p = 0; p < lines[j].first; ++p) {
      const size_t pixel = view.index(at_left ? p : view.width - 1 - p, y);
      result.levels[pixel] = rows[j][static_cast<size_t>(p)];
      result.measured[pixel] = false;
    }
  }
  return result;
}

}  // namespace bsm::test
