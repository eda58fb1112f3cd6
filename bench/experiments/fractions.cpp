// Experiment fractions: how evenly the sub-pixel disparities fall between whole pixels.
#include <array>
#include <cmath>
#include <string>

#include "bench/experiments/experiments.h"
#include "bench/report/svg_plot.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

constexpr size_t kBins = BSM_DISPARITY_SCALE;
constexpr double kEven = 100.0 / static_cast<double>(kBins);

struct Curve {
  const char* name;
  bsm_stage stage;
};
constexpr Curve kCurves[] = {
    {"at winner-takes-all", BSM_STAGE_AGGREGATED}, {"after the check", BSM_STAGE_CHECKED}, {"refined", BSM_STAGE_REFINED}};

PairList all_pairs(const Study& study) {
  PairList pairs = study.benchmark_list();
  for (const Pair* pair : study.scene_list()) pairs.push_back(pair);
  return pairs;
}

// Percent of the valid pixels of known truth in each sixteenth of a pixel.
std::array<double, kBins> histogram(Study& study, const bsm_config& config) {
  std::array<double, kBins> counts{};
  double sum = 0.0;
  for (const Pair* pair : all_pairs(study)) {
    const Match& match = study.match(*pair, config);
    const int16_t invalid = bsm_invalid_disparity(&match.config);
    for (size_t i = 0; i < match.values.size(); ++i) {
      if (match.values[i] == invalid || !std::isfinite(pair->truth.pixels[i])) continue;
      counts[static_cast<size_t>(match.values[i] & (BSM_DISPARITY_SCALE - 1))] += 1.0;
      sum += 1.0;
    }
  }
  for (double& count : counts) count *= sum > 0.0 ? 100.0 / sum : 0.0;
  return counts;
}

int steps(const Study& study) {
  return static_cast<int>((sizeof(kCurves) / sizeof(kCurves[0]) + 1) * all_pairs(study).size());
}

void run(Study& study) {
  study.report().section(
      "fractions", "Sub-pixel fractions",
      "Share of the disparities of all pairs in each sixteenth of a pixel, preset balanced. Without a bias to "
      "whole pixels every sixteenth would hold about 6.25 %, but for surfaces that face the camera.");
  const bsm_config config = preset_configuration(BSM_PRESET_BALANCED).config;
  ColumnPlot plot;
  plot.title = "Fractions of the sub-pixel disparities";
  plot.x_label = "fraction (sixteenths of a pixel)";
  plot.y_label = "share of pixels (%)";
  plot.references = {{"even: 6.25 %", kEven}};
  for (size_t bin = 0; bin < kBins; ++bin) plot.categories.push_back(host::text("%zu", bin));
  Table table;
  table.columns = {"map"};
  table.columns.insert(table.columns.end(), plot.categories.begin(), plot.categories.end());
  for (const Curve& curve : kCurves) {
    const std::array<double, kBins> shares = histogram(study, at_stage(config, curve.stage));
    std::vector<std::string> cells = {curve.name};
    for (const double share : shares) cells.push_back(fixed(share));
    table.add(cells);
    plot.series.push_back({curve.name, {}, std::vector<double>(shares.begin(), shares.end())});
  }
  study.report().plot("fractions", draw_columns(plot));
  study.report().table("fractions", "Percent of the pixels in each sixteenth", table);

  bsm_config whole = config;
  whole.subpixel = 0;
  const std::vector<double> thresholds = {0.5, 0.75, 1.0};
  Table errors;
  errors.columns = {"disparities", "pairs", "> 0.5", "> 0.75", "> 1", "mean error px"};
  for (const bool fractions : {false, true}) {
    for (const bool benchmark : {true, false}) {
      const Average average =
          study.average(benchmark ? study.benchmark_list() : study.scene_list(), fractions ? config : whole, thresholds);
      std::vector<std::string> cells = {fractions ? "with fractions" : "whole pixels", benchmark ? "benchmark" : "scenes"};
      for (size_t t = 0; t < thresholds.size(); ++t) cells.push_back(fixed(average.mean(t)));
      cells.push_back(fixed(average.mean_error(), 3));
      errors.add(cells);
    }
  }
  study.report().table("fractions_errors", "What the fractions are worth", errors);
}

}  // namespace

const Experiment kFractions = {"fractions", "histogram of sub-pixel fractions and their worth",
                               [](const Study& study) { return steps(study) + static_cast<int>(all_pairs(study).size()); },
                               run};

}  // namespace bsm::bench
