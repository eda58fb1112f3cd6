// model_refine.cpp - the plain model after the sparse map, and all of it together.
#include "model_refine.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "core/weights.h"
#include "model_sgm.h"
#include "model_sparse.h"

namespace bsm::test {
namespace {

// The nearest valid pixel of a row on one side of x, or -1.
int neighbour(const ModelLevels& levels, const ModelView& view, int x, int y, int step) {
  for (x += step; view.contains(x, y); x += step) {
    if (model_valid(levels[view.index(x, y)])) return x;
  }
  return -1;
}

// The highest whole level that may fill an invalid pixel.
int cap(const ModelLevels& levels, const ModelView& view, int x, int y, const bsm_config& config) {
  const int none = config.num_disparities;
  if (!config.vote_cap || levels[view.index(x, y)] != kModelOccluded) return none;
  const int left = neighbour(levels, view, x, y, -1), right = neighbour(levels, view, x, y, 1);
  if (left < 0 || right < 0) return none;
  const int a = levels[view.index(left, y)], b = levels[view.index(right, y)];
  return std::abs(a - b) > 24 ? (std::min(a, b) + 24) / 16 : none;
}

int vote_weight(const ModelColor& a, const ModelColor& b, int dx, int dy, const bsm_config& config) {  // eq. 10
  const uint32_t scale = vote_color_scale(config.vote_color);
  const int color_steps = static_cast<int>((static_cast<uint32_t>(model_sad(a, b)) * scale + 512) >> 10);
  const int steps = color_steps + vote_distance_steps(std::abs(dx), std::abs(dy), config.vote_distance);
  return steps < VoteWeights::kCount ? kVoteWeights.weight[steps] : 0;
}

// The level of the largest sum up to `most`, the lowest of several; kModelNone without any.
int elected(const std::map<int, int64_t>& votes, int most) {
  int best = kModelNone;
  int64_t best_sum = 0;
  for (const auto& [level, sum] : votes) {
    if (level <= most && sum > best_sum) best = level, best_sum = sum;
  }
  return best;
}

ModelLevels voted(const ModelLevels& levels, const ModelView& view, const bsm_config& config) {  // eq. 9
  const int radius = config.vote_radius, step = config.vote_step;
  ModelLevels result;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      if (model_valid(levels[view.index(x, y)])) {
        result.push_back(16 * model_whole(levels[view.index(x, y)]));
        continue;
      }
      std::map<int, int64_t> votes;
      for (int dy = -radius; dy <= radius; dy += step) {
        for (int dx = -radius; dx <= radius; dx += step) {
          if (!view.contains(x + dx, y + dy) || !model_valid(levels[view.index(x + dx, y + dy)])) continue;
          votes[model_whole(levels[view.index(x + dx, y + dy)])] +=
              vote_weight(view.color(x, y), view.color(x + dx, y + dy), dx, dy, config);
        }
      }
      int best = elected(votes, cap(levels, view, x, y, config));
      if (best == kModelNone) best = elected(votes, config.num_disparities);
      result.push_back(best == kModelNone ? kModelNone : 16 * best);
    }
  }
  return result;
}

// Holes that no vote reached take whole levels.
ModelLevels filled(const ModelLevels& levels, const ModelLevels& sparse, const ModelView& view) {
  ModelLevels result = levels;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      if (model_valid(result[view.index(x, y)])) continue;
      const int left = neighbour(sparse, view, x, y, -1), right = neighbour(sparse, view, x, y, 1);
      if (left >= 0 && (right < 0 || x - left <= right - x)) {
        result[view.index(x, y)] = (sparse[view.index(left, y)] + 8) / 16 * 16;
      } else if (right >= 0) {
        result[view.index(x, y)] = (sparse[view.index(right, y)] + 8) / 16 * 16;
      } else {
        result[view.index(x, y)] = y > 0 ? result[view.index(x, y - 1)] : 0;
      }
    }
  }
  return result;
}

bool is_flat(const ModelLevels& levels, const ModelView& view, int x, int y) {
  for (int j = y - 1; j <= y + 1; ++j) {
    for (int i = x - 1; i <= x + 1; ++i) {
      if (view.contains(i, j) && levels[view.index(i, j)] != levels[view.index(x, y)]) return false;
    }
  }
  return true;
}

int smooth_weight(const ModelColor& a, const ModelColor& b, int dx, int dy, const bsm_config& config) {
  const int scale = static_cast<int>(smooth_color_scale(config.smooth_color));
  const int color_steps = std::min(model_sad(a, b), 255) * scale / 256;
  const int steps = color_steps + smooth_distance_steps(std::abs(dx), std::abs(dy), config.smooth_distance);
  return kSmoothWeights.weight[std::min(steps, 127)];
}

// One pass of the weighted median. A pixel with a level in the sparse map is trusted: its own level weighs more by two full
// weights, halved in each pass.
ModelLevels smoothed(const ModelLevels& levels, const ModelLevels& sparse, const ModelView& view, int pass,
                     const bsm_config& config) {
  const int radius = config.smooth_radius;
  ModelLevels result;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const int own = levels[view.index(x, y)];
      result.push_back(own);
      if (is_flat(levels, view, x, y)) continue;
      std::map<int, int> weights;
      if (model_valid(sparse[view.index(x, y)])) weights[own] += 512 >> pass;
      for (int dy = -radius; dy <= radius; ++dy) {
        for (int dx = -radius; dx <= radius; ++dx) {
          if ((dx + dy) % 2 != 0 || !view.contains(x + dx, y + dy)) continue;
          weights[levels[view.index(x + dx, y + dy)]] +=
              smooth_weight(view.color(x, y), view.color(x + dx, y + dy), dx, dy, config);
        }
      }
      int below = 0, above = 0, total = 0;
      for (const auto& [level, weight] : weights) {
        total += weight;
        if (level < own) below += weight;
        if (level > own) above += weight;
      }
      if (2 * below <= total && 2 * above <= total) continue;
      int sum = 0;
      for (const auto& [level, weight] : weights) {
        sum += weight;
        if (2 * sum < total) continue;
        result.back() = level;
        break;
      }
    }
  }
  return result;
}

ModelLevels median_of_9(const ModelLevels& levels, const ModelView& view) {
  ModelLevels result;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      std::vector<int> window;
      for (int j = y - 1; j <= y + 1; ++j) {
        for (int i = x - 1; i <= x + 1; ++i) {  // the border repeats
          window.push_back(levels[view.index(std::clamp(i, 0, view.width - 1), std::clamp(j, 0, view.height - 1))]);
        }
      }
      std::sort(window.begin(), window.end());
      result.push_back(window[4]);
    }
  }
  return result;
}

// The weighted mean of the 5x5 neighbours within one level, in the fixed point of fraction_smooth.
ModelLevels fractions_smoothed(const ModelLevels& levels, const std::vector<int>& weights, const ModelView& view) {
  ModelLevels result;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const int own = levels[view.index(x, y)];
      int e = 0, w = 0;
      for (int j = y - 2; j <= y + 2; ++j) {
        for (int i = x - 2; i <= x + 2; ++i) {
          if (!view.contains(i, j) || std::abs(levels[view.index(i, j)] - own) > 16) continue;
          e += weights[view.index(i, j)] * (levels[view.index(i, j)] - own);
          w += weights[view.index(i, j)];
        }
      }
      const int64_t reciprocal = std::min<int64_t>(32767, std::llround(32768.0 / w));
      result.push_back(own + static_cast<int>(std::floor(static_cast<double>(e * reciprocal + (1 << 14)) / (1 << 15))));
    }
  }
  return result;
}

// Fractions away from whole levels: by sixteenths below and above the nearest whole one, -8 to 7.
ModelLevels fractions_spread(ModelLevels levels) {
  constexpr int kSpread[] = {-8, -8, -8, -7, -6, -5, -4, -1, 0, 1, 4, 5, 6, 7, 8, 8};
  for (auto& level : levels) {
    const int whole = static_cast<int>(std::floor((level + 8) / 16.0));
    level = 16 * whole + kSpread[level - 16 * whole + 8];
  }
  return levels;
}

// Pixels whose level in the sparse map is within 12 sixteenths of the dense one get it back; all others weigh double in two
// passes of smoothing, between which the fractions are spread.
ModelLevels with_fractions(const ModelLevels& dense, const ModelLevels& sparse, const ModelView& view) {
  ModelLevels levels = dense;
  std::vector<int> weights(dense.size(), 2);
  for (size_t i = 0; i < dense.size(); ++i) {
    if (model_valid(sparse[i]) && std::abs(sparse[i] - dense[i]) <= 12) levels[i] = sparse[i], weights[i] = 1;
  }
  return fractions_smoothed(fractions_spread(fractions_smoothed(levels, weights, view)), weights, view);
}

// `sparse` is the checked map without speckles and with the border continued.
ModelLevels refined(const ModelLevels& sparse, const ModelView& view, const bsm_config& config) {
  ModelLevels levels = filled(voted(sparse, view, config), sparse, view);
  for (int pass = 0; pass < config.smooth_passes; ++pass) levels = smoothed(levels, sparse, view, pass, config);
  if (config.median) levels = median_of_9(levels, view);
  return config.method == BSM_METHOD_SGM && config.subpixel ? with_fractions(levels, sparse, view) : levels;
}

// Of 1998 points: 1000 for neighbours (every second one of 9 x 9 that lies in the image) whose own level is within 1.5
// levels of the final one, 500 for the pixel's own within 1 level, 2 * 249 for the margin (sgm).
std::vector<uint8_t> confidence(const ModelLevels& final_levels, const ModelSparse& own, const std::vector<int>& margin,
                                const ModelView& view) {
  std::vector<uint8_t> result;
  const auto agrees = [&](size_t pixel, int level, int most) {
    return own.measured[pixel] && model_valid(own.levels[pixel]) && std::abs(own.levels[pixel] - level) <= most;
  };
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const size_t pixel = view.index(x, y);
      const int level = final_levels[pixel];
      int agreeing = 0, asked = 0;
      for (int j = y - 4; j <= y + 4; j += 2) {
        for (int i = x - 4; i <= x + 4; i += 2) {
          if (!view.contains(i, j)) continue;
          ++asked;
          agreeing += agrees(view.index(i, j), level, 24);
        }
      }
      const int points =
          1000 * agreeing / asked + (agrees(pixel, level, 16) ? 500 : 0) + (margin.empty() ? 0 : 2 * margin[pixel]);
      result.push_back(static_cast<uint8_t>(model_valid(level) ? points * 255 / 1998 : 0));
    }
  }
  return result;
}

std::vector<int16_t> values(const ModelLevels& levels, const bsm_config& config) {
  std::vector<int16_t> result;
  for (const int level : levels) {
    result.push_back(
        static_cast<int16_t>(model_valid(level) ? 16 * config.min_disparity + level : 16 * config.min_disparity - 16));
  }
  return result;
}

}  // namespace

FullMaps run_full_model(const bsm_config& config, const ColorPair& pair) {
  const bool gray = config.format == BSM_FORMAT_GRAY8;
  const ModelView left = model_view(pair.left, gray), right = model_view(pair.right, gray);
  const ModelMatches matches = model_matches(config, left, right);
  const std::vector<int> no_margin;
  FullMaps maps;
  // `sparse` says where each final level comes from; without a continuation everything is measured.
  const auto write = [&](bsm_stage stage, const ModelLevels& l, const ModelLevels& r, const ModelSparse& sparse,
                         const std::vector<int>& margin) {
    maps.left[stage] = values(l, config);
    maps.right[stage] = values(r, config);
    maps.confidence[stage] = confidence(l, sparse, margin, left);
  };
  const auto measured = [](const ModelLevels& levels) {
    return ModelSparse{levels, std::vector<bool>(levels.size(), true)};
  };
  const bool sgm = config.method == BSM_METHOD_SGM;
  write(BSM_STAGE_COST, matches.cost.left, matches.cost.right, measured(matches.cost.left), no_margin);
  write(BSM_STAGE_MASKED, matches.masked.left, matches.masked.right, measured(matches.masked.left), no_margin);
  const ModelWinners& last = sgm ? matches.aggregated : matches.masked;
  if (sgm) write(BSM_STAGE_AGGREGATED, last.left, last.right, measured(last.left), last.margin);
  const ModelLevels left_checked = model_checked(last.left, last.right, left, -1, config);
  const ModelLevels right_checked = model_checked(last.right, last.left, right, 1, config);
  write(BSM_STAGE_CHECKED, left_checked, right_checked, measured(left_checked), last.margin);
  const ModelSparse left_sparse = model_continued(model_despeckled(left_checked, left, config), left, -1, config);
  const ModelSparse right_sparse = model_continued(model_despeckled(right_checked, right, config), right, 1, config);
  write(BSM_STAGE_REFINED, refined(left_sparse.levels, left, config), refined(right_sparse.levels, right, config),
        left_sparse, last.margin);
  return maps;
}

}  // namespace bsm::test
