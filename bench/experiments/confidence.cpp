// Experiment confidence: the error that remains when the least confident pixels are removed first.
#include <string>

#include "bench/experiments/experiments.h"
#include "bench/experiments/sparsification.h"
#include "bench/report/svg_plot.h"

namespace bsm::bench {
namespace {

PairList all_pairs(const Study& study) {
  PairList pairs = study.benchmark_list();
  for (const Pair* pair : study.scene_list()) pairs.push_back(pair);
  return pairs;
}

bool supported() {
  bsm_config config = preset_configuration(BSM_PRESET_BALANCED).config;
  return ask_for_confidence(&config);
}

int steps(const Study& study) {
  return supported() ? static_cast<int>(all_pairs(study).size()) : 0;
}

host::Image8 picture_of(const Match& match) {
  return {match.config.width, match.config.height, 1, match.confidence};
}

void run(Study& study) {
  study.report().section(
      "confidence", "Confidence",
      "Pixels are removed by rising confidence, preset balanced; the curve is the share of bad pixels (above "
      "1.0, region all) among those that remain, mean of all pairs. The ideal order removes every bad pixel "
      "first. The area is the mean height of a curve: lower is better.");
  bsm_config config = preset_configuration(BSM_PRESET_BALANCED).config;
  if (!ask_for_confidence(&config)) {
    study.report().note("This build of the library makes no confidence map.");
    return;
  }
  std::vector<Sparsification> curves;
  std::vector<Picture> pictures;
  Table table;
  table.columns = {"pair", "error % of all", "half removed", "area", "ideal order's area"};
  const auto add_row = [&table](const std::string& name, const Sparsification& curve) {
    table.add({name, fixed(curve.error.front()), fixed(curve.error[curve.error.size() / 2]), fixed(curve.area, 3),
               fixed(curve.ideal_area, 3)});
  };
  for (const Pair* pair : all_pairs(study)) {
    const Match& match = study.match(*pair, config);
    if (match.confidence.empty()) {
      study.report().note("The confidence map did not arrive.");
      return;
    }
    curves.push_back(sparsify(*pair, match.map, match.confidence));
    add_row(pair->name, curves.back());
    pictures.push_back({"confidence_" + pair->name, picture_of(match), pair->name + ": confidence, white is certain"});
  }
  const Sparsification mean = mean_of(curves);
  add_row("mean", mean);
  LinePlot plot{"Sparsification, mean of all pairs", "removed pixels (%)", "bad among the rest (%)"};
  plot.from_zero = true;
  const std::vector<double> even(mean.removed.size(), mean.error.front());
  plot.series = {{"by confidence, area " + fixed(mean.area), mean.removed, mean.error, false, false},
                 {"ideal order, area " + fixed(mean.ideal_area), mean.removed, mean.ideal, true, false},
                 {"random order, area " + fixed(mean.error.front()), mean.removed, even, true, false}};
  study.report().plot("confidence", draw_lines(plot));
  study.report().table("confidence", "", table);
  study.report().pictures(pictures);
}

}  // namespace

const Experiment kConfidence = {"confidence", "sparsification curve of the confidence map", steps, run};

}  // namespace bsm::bench
