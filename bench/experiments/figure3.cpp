// Experiment figure3: errors when both views have different exposures or lightings.
#include <algorithm>
#include <cmath>
#include <string>

#include "bench/experiments/experiments.h"
#include "bench/experiments/radiometry.h"
#include "bench/opencv_matcher.h"
#include "bench/report/svg_plot.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

constexpr int kCells = kConditions * kConditions;
constexpr int kStudies = 3;  // exposures, exposures without noise, lightings

struct Matcher {
  std::string name;
  bool opencv = false;  // StereoSGBM instead of this library
  bsm_config config{};
};

std::vector<Matcher> matchers(const Study& study) {
  const int32_t bits = study.options().quick ? 1024 : BSM_MAX_BITS;
  const Configuration local = local_configuration(bits);
  std::vector<Matcher> list = {{local.name, false, local.config}};
  for (const bsm_preset preset : {BSM_PRESET_LOCAL, BSM_PRESET_FAST, BSM_PRESET_BALANCED}) {
    const bsm_config config = preset_configuration(preset).config;
    list.push_back({describe(config), false, config});
  }
  if (opencv_available()) list.push_back({"StereoSGBM", true, {}});
  return list;
}

// Percent of bad pixels, [left condition][right condition].
using Matrix = std::vector<std::vector<double>>;

// What one matcher does: over the non-occluded pixels, and over those of them that neither view clips.
struct Measured {
  Matrix all = Matrix(kConditions, std::vector<double>(kConditions, 0.0));
  Matrix unclipped = all;
};

// Both views of a scene under every condition.
struct Conditions {
  host::Image8 left[kConditions], right[kConditions];
};

enum class Change { kExposure, kExposureWithoutNoise, kLighting };

Conditions changed(const Pair& pair, Change change, uint32_t scene) {
  Conditions views;
  for (int i = 0; i < kConditions; ++i) {
    const uint32_t seed = 1000 * scene + 10 * static_cast<uint32_t>(i);
    const bool noisy = change == Change::kExposure;
    views.left[i] = change == Change::kLighting ? light(pair.left, i) : expose(pair.left, i, seed + 1, noisy);
    views.right[i] = change == Change::kLighting ? light(pair.right, i) : expose(pair.right, i, seed + 2, noisy);
  }
  return views;
}

bool clipped(const host::Image8& image, int32_t x, int32_t y) {
  const uint8_t* pixel = image.row(y) + static_cast<size_t>(x) * static_cast<size_t>(image.channels);
  return std::any_of(pixel, pixel + image.channels, [](uint8_t sample) { return sample == 255; });
}

// The pixels of the mask whose samples are below the largest level in both views.
host::Mask without_clipped(const Pair& pair, host::Mask mask) {
  mask.resize(pair.truth.pixels.size(), 255);
  size_t i = 0;
  for (int32_t y = 0; y < pair.truth.height; ++y) {
    for (int32_t x = 0; x < pair.truth.width; ++x, ++i) {
      if (!std::isfinite(pair.truth.pixels[i])) continue;
      const int32_t other = x - static_cast<int32_t>(std::lround(pair.truth.pixels[i]));
      if (clipped(pair.left, x, y) || other < 0 || clipped(pair.right, other, y)) mask[i] = 0;
    }
  }
  return mask;
}

host::DisparityMap run_matcher(Study& study, const Pair& pair, const Matcher& matcher) {
  if (!matcher.opencv) return study.match_once(pair, matcher.config).map;
  study.progress().step("figure3: " + pair.name + ", StereoSGBM");
  OpencvMatcher opencv(pair, OpencvMethod::kSgbm3Way);
  opencv.match();
  return opencv.map();
}

// Errors of all combinations, averaged over the scenes, for each matcher.
std::vector<Measured> measure(Study& study, Change change) {
  const std::vector<Matcher> list = matchers(study);
  std::vector<Measured> results(list.size());
  const double scenes = static_cast<double>(study.scenes().size());
  uint32_t number = 0;
  for (const Pair& scene : study.scenes()) {
    const Conditions views = changed(scene, change, ++number);
    const host::Mask visible = scene.masks[scene.has_region[kNonOccluded] ? kNonOccluded : kAll];
    Pair pair = scene;
    for (size_t i = 0; i < kConditions; ++i) {
      for (size_t j = 0; j < kConditions; ++j) {
        pair.left = views.left[i];
        pair.right = views.right[j];
        const host::Mask unclipped = without_clipped(pair, visible);
        for (size_t m = 0; m < list.size(); ++m) {
          const host::DisparityMap map = run_matcher(study, pair, list[m]);
          results[m].all[i][j] += host::evaluate(map, pair.truth, visible, 1.0).bad_percent() / scenes;
          results[m].unclipped[i][j] += host::evaluate(map, pair.truth, unclipped, 1.0).bad_percent() / scenes;
        }
      }
    }
  }
  return results;
}

// Means over the cells whose conditions are equal, or different.
struct Summary {
  double equal = 0.0, different = 0.0;
  double worse_alone = 0.0;  // each different cell as bad as its worse condition is with itself
  double ratio() const { return equal > 0.0 ? different / equal : 0.0; }
};

Summary summarize(const Matrix& matrix) {
  Summary summary;
  for (size_t i = 0; i < kConditions; ++i) {
    for (size_t j = 0; j < kConditions; ++j) {
      if (i == j) {
        summary.equal += matrix[i][i] / kConditions;
      } else {
        summary.different += matrix[i][j] / (kCells - kConditions);
        summary.worse_alone += std::max(matrix[i][i], matrix[j][j]) / (kCells - kConditions);
      }
    }
  }
  return summary;
}

MatrixPlot matrix_plot(const std::string& what, const char* const (&names)[kConditions]) {
  MatrixPlot plot;
  plot.title = "Simulated " + what + ": bad pixels (%), non-occluded, mean of the scenes";
  plot.row_label = "left view";
  plot.column_label = "right view";
  plot.names.assign(names, names + kConditions);
  return plot;
}

void report_study(Study& study, const std::string& file, const std::string& what, const char* const (&names)[kConditions],
                  const std::vector<Measured>& results) {
  const std::vector<Matcher> list = matchers(study);
  Table cells, summary;
  cells.columns = {"matcher", "left", "right", "bad %", "unclipped bad %"};
  summary.columns = {
      what + ", simulated",           "equal in both views",     "different", "ratio", "worse view's own error",
      "different / worse view's own", "unclipped pixels: equal", "different", "ratio"};
  MatrixPlot plot = matrix_plot(what, names);
  for (size_t m = 0; m < list.size(); ++m) {
    for (size_t i = 0; i < kConditions; ++i) {
      for (size_t j = 0; j < kConditions; ++j) {
        cells.add({list[m].name, names[i], names[j], fixed(results[m].all[i][j]), fixed(results[m].unclipped[i][j])});
      }
    }
    const Summary all = summarize(results[m].all), unclipped = summarize(results[m].unclipped);
    summary.add({list[m].name, fixed(all.equal), fixed(all.different), fixed(all.ratio()), fixed(all.worse_alone),
                 fixed(all.worse_alone > 0.0 ? all.different / all.worse_alone : 0.0), fixed(unclipped.equal),
                 fixed(unclipped.different), fixed(unclipped.ratio())});
    plot.panels.push_back({list[m].name, results[m].all});
  }
  study.report().plot("figure3_" + file, draw_matrices(plot));
  study.report().data("figure3_" + file, cells);
  study.report().table("figure3_" + file + "_summary", "", summary);
}

int steps(const Study& study) {
  return static_cast<int>(kStudies * kCells * study.scenes().size() * matchers(study).size());
}

void run(Study& study) {
  std::string words =
      "Simulated: the scenes come in one exposure and one lighting here. Exposure: gains of exactly 1/4, 1 and 4 in linear "
      "light, Gaussian noise of standard deviation 2 levels, clipping, 8 bits. Lighting: gains in linear light that are "
      "even, fall from 1.5 at the left edge to 0.5 at the right, or have a bright spot of 2 off centre over 0.6; clipping, "
      "8 bits. Each view has its own condition.";
  words += opencv_available() ? " " + opencv_name() + " StereoSGBM: 3-way, 3 x 3 blocks, holes filled."
                              : " StereoSGBM is absent: OpenCV was not found when this was built.";
  study.report().section("figure3", "Figure 3: radiometric differences", words);
  study.report().note(
      "What limits: a view that clips, or whose signal sinks into the noise, has lost what could be compared, and no "
      "partner brings it back. \"Worse view's own error\" gives each mixed cell the error of its worse condition with "
      "itself: a matcher at 1.00 of it pays for the lost signal alone, not for the difference. \"Unclipped pixels\" "
      "counts those below level 255 in both views.");
  report_study(study, "exposures", "exposures", kExposureNames, measure(study, Change::kExposure));
  report_study(study, "exposures_without_noise", "exposures without noise", kExposureNames,
               measure(study, Change::kExposureWithoutNoise));
  report_study(study, "lightings", "lightings", kLightingNames, measure(study, Change::kLighting));
}

}  // namespace

const Experiment kFigure3 = {"figure3", "simulated exposures and lightings, 3 x 3 matrices", steps, run};

}  // namespace bsm::bench
