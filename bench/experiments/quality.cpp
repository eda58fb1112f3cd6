// Experiments thresholds, gray and presets: the same maps at other thresholds, from luma alone, and by preset.
#include <string>

#include "bench/experiments/experiments.h"
#include "bench/report/svg_plot.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

const std::vector<double> kSweep = {0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0};
const std::vector<double> kReported = {0.5, 1.0, 2.0};  // 1.0 is kOne
constexpr size_t kOne = 1;

std::vector<Configuration> compared(bool gray = false) {
  std::vector<Configuration> list = {preset_configuration(BSM_PRESET_PAPER, gray), local_configuration(BSM_MAX_BITS, gray),
                                     local_configuration(256, gray)};
  list[0].name = describe(list[0].config) + ", the paper's refinement";
  for (const bsm_preset preset : {BSM_PRESET_FAST, BSM_PRESET_BALANCED, BSM_PRESET_BEST}) {
    list.push_back(preset_configuration(preset, gray));
    list.back().name = describe(list.back().config);
  }
  return list;
}

struct NamedGroup {
  std::string name;
  PairList pairs;
};

std::string names_of(const PairList& pairs) {
  std::string names;
  for (const Pair* pair : pairs) names += (names.empty() ? "" : ", ") + pair->name;
  return names;
}

std::vector<NamedGroup> groups(const Study& study, bool gray) {
  std::vector<NamedGroup> list = {{"benchmark", study.benchmark_list(gray)}};
  if (!study.scene_group(false, gray).empty()) list.push_back({"chosen scenes", study.scene_group(false, gray)});
  if (!study.scene_group(true, gray).empty()) list.push_back({"confirming scenes", study.scene_group(true, gray)});
  return list;
}

int pairs_of(const Study& study) {
  return static_cast<int>(study.benchmark().size() + study.scenes().size());
}

int threshold_steps(const Study& study) {
  return static_cast<int>(compared().size()) * pairs_of(study);
}

void run_thresholds(Study& study) {
  study.report().section(
      "thresholds", "Thresholds",
      "Bad pixels against the error that is still good: the mean over the regions of the benchmark's pairs "
      "and of the scenes. The benchmark's truths are whole pixels for tsukuba and fractions for the others.");
  const std::pair<const char*, PairList> sets[] = {{"benchmark", study.benchmark_list()}, {"scenes", study.scene_list()}};
  for (const auto& [name, pairs] : sets) {
    LinePlot plot{std::string("Bad pixels against the threshold, ") + name, "threshold (pixels)", "bad pixels (%)"};
    plot.from_zero = true;
    Table table;
    table.columns = {name};
    for (const double threshold : kSweep) table.columns.push_back(host::text("> %g", threshold));
    table.columns.push_back("mean error px");
    for (const Configuration& configuration : compared()) {
      const Average average = study.average(pairs, configuration.config, kSweep);
      Series series{configuration.name, kSweep, {}};
      std::vector<std::string> cells = {configuration.name};
      for (size_t t = 0; t < kSweep.size(); ++t) {
        series.y.push_back(average.mean(t));
        cells.push_back(fixed(average.mean(t)));
      }
      cells.push_back(fixed(average.mean_error(), 3));
      table.add(cells);
      plot.series.push_back(series);
    }
    study.report().plot(std::string("thresholds_") + name, draw_lines(plot));
    study.report().table(std::string("thresholds_") + name, "", table);
  }
}

int gray_steps(const Study& study) {
  return 2 * threshold_steps(study);
}

void run_gray(Study& study) {
  study.report().section(
      "gray", "Gray images",
      "The same pairs as luma of 8 bits, where no colour helps the mask and the weights. Mean over all regions "
      "of the group at threshold 1.0; presets weigh differences of luma more than those of colour.");
  Table table, details;
  table.columns = {"method"};
  details.columns = {"method", "group", "nonocc", "all", "disc", "> 0.5", "> 1", "> 2", "mean error px"};
  for (const NamedGroup& group : groups(study, false)) {
    for (const char* kind : {"colour", "gray", "worse by"}) table.columns.push_back(group.name + ", " + kind);
  }
  const std::vector<Configuration> color = compared(), gray = compared(true);
  for (size_t i = 0; i < color.size(); ++i) {
    std::vector<std::string> cells = {color[i].name};
    const std::vector<NamedGroup> color_groups = groups(study, false), gray_groups = groups(study, true);
    for (size_t g = 0; g < color_groups.size(); ++g) {
      const Average in_color = study.average(color_groups[g].pairs, color[i].config, kReported);
      const Average in_gray = study.average(gray_groups[g].pairs, gray[i].config, kReported);
      cells.push_back(fixed(in_color.mean(kOne)));
      cells.push_back(fixed(in_gray.mean(kOne)));
      cells.push_back(fixed(in_gray.mean(kOne) - in_color.mean(kOne)));
      std::vector<std::string> line = {color[i].name + ", gray", color_groups[g].name};
      for (int region = 0; region < kRegionCount; ++region) line.push_back(fixed(in_gray.region(kOne, region)));
      for (size_t t = 0; t < kReported.size(); ++t) line.push_back(fixed(in_gray.mean(t)));
      line.push_back(fixed(in_gray.mean_error(), 3));
      details.add(line);
    }
    table.add(cells);
  }
  study.report().table("gray", "", table);
  study.report().table("gray_details", "Gray in detail", details);
}

int preset_steps(const Study& study) {
  return static_cast<int>(all_presets().size()) * (pairs_of(study) + 1);
}

void run_presets(Study& study) {
  std::string words = "Parameters were chosen on the benchmark and on " + names_of(study.scene_group(false)) +
                      "; they are confirmed on " + names_of(study.scene_group(true)) +
                      ". Regions at threshold 1.0; > t is the "
                      "mean of the regions at threshold t; time in one thread on " +
                      study.time_pair().name + ".";
  study.report().section("presets", "Presets", words);
  Table table;
  table.columns = {"preset", "group", "nonocc", "all", "disc", "> 0.5", "> 1", "> 2", "mean error px", "ms", "arena KB"};
  ColumnPlot plot;
  plot.title = "Presets: bad pixels at threshold 1.0, mean of the regions";
  plot.y_label = "bad pixels (%)";
  for (const NamedGroup& group : groups(study, false)) plot.series.push_back({group.name, {}, {}});
  for (const Configuration& preset : all_presets()) {
    const Match timed = study.time(study.time_pair(), preset.config);
    plot.categories.push_back(preset.name);
    const std::vector<NamedGroup> list = groups(study, false);
    for (size_t g = 0; g < list.size(); ++g) {
      const Average average = study.average(list[g].pairs, preset.config, kReported);
      plot.series[g].y.push_back(average.mean(kOne));
      std::vector<std::string> cells = {preset.name, list[g].name};
      for (int region = 0; region < kRegionCount; ++region) cells.push_back(fixed(average.region(kOne, region)));
      for (size_t t = 0; t < kReported.size(); ++t) cells.push_back(fixed(average.mean(t)));
      cells.push_back(fixed(average.mean_error(), 3));
      cells.push_back(g == 0 ? fixed(timed.ms_min, 1) : "");
      cells.push_back(g == 0 ? fixed(static_cast<double>(timed.arena_bytes) / 1024.0, 0) : "");
      table.add(cells);
    }
  }
  study.report().plot("presets", draw_columns(plot));
  study.report().table("presets", "", table);
}

}  // namespace

const Experiment kThresholds = {"thresholds", "bad pixels at thresholds 0.5 to 2", threshold_steps, run_thresholds};
const Experiment kGray = {"gray", "colour against gray input", gray_steps, run_gray};
const Experiment kPresets = {"presets", "every preset on the chosen and the confirming pairs", preset_steps, run_presets};

}  // namespace bsm::bench
