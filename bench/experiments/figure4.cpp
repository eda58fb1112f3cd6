// Experiments figure4 and disparities: error and time against the descriptor length, time against the number of disparities.
#include <cmath>
#include <string>

#include "bench/experiments/experiments.h"
#include "bench/experiments/paper_values.h"
#include "bench/report/svg_plot.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

struct Method {
  const char* name;
  int32_t most_bits;
  bsm_config config;
};

std::vector<Method> methods() {
  return {{"local, the paper's refinement", BSM_MAX_BITS, preset_configuration(BSM_PRESET_PAPER).config},
          {"local", BSM_MAX_BITS, local_configuration(BSM_MAX_BITS).config},
          {"sgm", BSM_MAX_SGM_BITS, preset_configuration(BSM_PRESET_BALANCED).config}};
}

std::vector<int32_t> lengths(const Study& study, int32_t most) {
  std::vector<int32_t> list;
  for (int32_t bits = BSM_MIN_BITS; bits <= most; bits *= study.options().quick ? 4 : 2) list.push_back(bits);
  return list;
}

std::vector<int32_t> ranges(const Study& study) {
  return study.options().quick ? std::vector<int32_t>{16, 64, 128} : std::vector<int32_t>{16, 32, 64, 96, 128, 192, 256};
}

std::vector<Configuration> timed_configurations() {
  std::vector<Configuration> list = {local_configuration(1024), local_configuration(256),
                                     preset_configuration(BSM_PRESET_BALANCED)};
  list.back().name = describe(list.back().config);
  return list;
}

// Least-squares line through the points.
struct Line {
  double offset = 0.0, slope = 0.0, fit = 0.0;  // fit: the coefficient of determination
};

Line line_through(const Series& series) {
  const double n = static_cast<double>(series.x.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  for (size_t i = 0; i < series.x.size(); ++i) {
    x += series.x[i];
    y += series.y[i];
    xx += series.x[i] * series.x[i];
    xy += series.x[i] * series.y[i];
    yy += series.y[i] * series.y[i];
  }
  const double sxx = xx - x * x / n, sxy = xy - x * y / n, syy = yy - y * y / n;
  Line line;
  line.slope = sxx > 0.0 ? sxy / sxx : 0.0;
  line.offset = (y - line.slope * x) / n;
  line.fit = sxx > 0.0 && syy > 0.0 ? sxy * sxy / (sxx * syy) : 1.0;
  return line;
}

Table line_table(const std::vector<Series>& series, const std::string& unit, double per) {
  Table table;
  table.columns = {"method", "ms at 0", "ms per " + unit, "linear fit R2"};
  for (const Series& one : series) {
    const Line line = line_through(one);
    table.add({one.name, fixed(line.offset, 1), fixed(line.slope * per, 2), fixed(line.fit, 4)});
  }
  return table;
}

int figure4_steps(const Study& study) {
  int steps = 0;
  for (const Method& method : methods()) {
    steps += static_cast<int>(lengths(study, method.most_bits).size() * (study.benchmark().size() + 2));
  }
  return steps;
}

void run_figure4(Study& study) {
  const Pair& pair = study.time_pair();
  study.report().section(
      "figure4", "Figure 4: descriptor length",
      "Average of the benchmark's numbers at threshold 1.0, and time on " + pair.name +
          host::text(" in one thread, against the descriptor length n; one set of parameters for all n. The time is "
                     "that up to the checked map: refinement depends on how many pixels fail the check, not on n. The "
                     "pairs of length n are the first n of one table; that of sgm has %d pairs, where its "
                     "curves end.",
                     BSM_MAX_SGM_BITS));
  LinePlot errors{"Error against descriptor length", "descriptor length n (bits)", "average error (%)"};
  LinePlot times{"Time to the checked map against descriptor length, " + pair.name, "descriptor length n (bits)",
                 "time (ms)"};
  errors.log_x = true;
  times.from_zero = true;
  errors.references = {{"the paper, n = 4096: 5.42", kPaperAverage}, {"PatchMatch Stereo: 4.59", kPatchMatchAverage}};
  Table table;
  table.columns = {"method", "n", "average error %", "mean error px", "ms to the checked map", "ms refined", "arena KB"};
  for (const Method& method : methods()) {
    Series error{method.name, {}, {}}, time{method.name, {}, {}};
    for (const int32_t bits : lengths(study, method.most_bits)) {
      bsm_config config = method.config;
      config.bits = bits;
      const Average average = study.average(study.benchmark_list(), config, {1.0});
      const Match match = study.time(pair, config), checked = study.time(pair, at_stage(config, BSM_STAGE_CHECKED));
      error.x.push_back(bits);
      error.y.push_back(average.mean(0));
      time.x.push_back(bits);
      time.y.push_back(checked.ms_min);
      table.add({method.name, host::text("%d", static_cast<int>(bits)), fixed(average.mean(0)),
                 fixed(average.mean_error(), 3), fixed(checked.ms_min, 1), fixed(match.ms_min, 1),
                 fixed(static_cast<double>(match.arena_bytes) / 1024.0, 0)});
    }
    errors.series.push_back(error);
    times.series.push_back(time);
  }
  study.report().plot("figure4_error", draw_lines(errors));
  study.report().plot("figure4_time", draw_lines(times));
  study.report().table("figure4", "", table);
  study.report().table("figure4_lines", "Time to the checked map as a line over n",
                       line_table(times.series, "64 bits", 64.0));
}

int disparities_steps(const Study& study) {
  return static_cast<int>(2 * timed_configurations().size() * ranges(study).size());
}

void run_disparities(Study& study) {
  const Pair& pair = study.time_pair();
  study.report().section(
      "disparities", "Time against the number of disparities",
      "The paper states that time is linear in the number of disparities. Views of " + pair.name +
          ", one thread, up to the checked map: refinement takes longer the more pixels fail the check, "
          "and below the pair's own range most do. A candidate outside the image is not computed, so that "
          "ranges near the image's width cost less than the line.");
  LinePlot plot{"Time to the checked map against the number of disparities, " + pair.name, "disparities searched",
                "time (ms)"};
  plot.from_zero = true;
  Table table;
  table.columns = {"method", "disparities", "ms to the checked map", "ms refined", "arena KB"};
  for (const Configuration& method : timed_configurations()) {
    Series series{method.name, {}, {}};
    for (const int32_t disparities : ranges(study)) {
      const Match match = study.time(pair, method.config, disparities);
      const Match checked = study.time(pair, at_stage(method.config, BSM_STAGE_CHECKED), disparities);
      series.x.push_back(disparities);
      series.y.push_back(checked.ms_min);
      table.add({method.name, host::text("%d", static_cast<int>(disparities)), fixed(checked.ms_min, 1),
                 fixed(match.ms_min, 1), fixed(static_cast<double>(match.arena_bytes) / 1024.0, 0)});
    }
    plot.series.push_back(series);
  }
  study.report().plot("disparities", draw_lines(plot));
  study.report().table("disparities", "", table);
  study.report().table("disparities_lines", "Time to the checked map as a line over the disparities",
                       line_table(plot.series, "16 disparities", 16.0));
}

}  // namespace

const Experiment kFigure4 = {"figure4", "error and time against the descriptor length, both methods", figure4_steps,
                             run_figure4};
const Experiment kDisparities = {"disparities", "time against the number of disparities", disparities_steps,
                                 run_disparities};

}  // namespace bsm::bench
