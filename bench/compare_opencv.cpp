// compare_opencv: OpenCV's block matchers beside this library's configurations, time and error on the same pairs.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "bench/command_line.h"
#include "bench/configurations.h"
#include "bench/frame_run.h"
#include "bench/opencv_matcher.h"
#include "bench/pair_set.h"
#include "bench/report/svg_plot.h"
#include "bench/score.h"
#include "bench/statistics.h"
#include "bench/table.h"
#include "host/config_options.h"
#include "host/file_output.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

constexpr char kProgram[] = "compare_opencv";
constexpr char kUsage[] = "compare_opencv FOLDER [options]";
constexpr char kSummary[] =
    "Matches every pair of FOLDER (laid out as bsm_quality --help says) with OpenCV's StereoBM and StereoSGBM and with "
    "this\n"
    "library's configurations, all in one process and one thread, taking turns on each pair. Prints the median time and\n"
    "the average of the bad pixels (error above 1.0) in the regions nonocc, all and disc: 12 numbers on Middlebury v2.\n"
    "OpenCV gets gray views, extended to the left by the number of disparities, and its holes take the lower of the\n"
    "nearest disparities of their row; neither is in its time. This library's time is that of the whole way to its dense\n"
    "map.";

struct Arguments {
  std::string folder, svg, isa = "auto";
  PairSetOptions pairs;
  int32_t repeat = 7;
  bool gray = false, csv = false;
  uint32_t isa_mask = 0;
};

// One matcher on one pair: `match` returns false with a sentence.
struct Turn {
  std::function<bool(double* milliseconds, std::string* error)> match;
  std::function<host::DisparityMap()> map;
};

struct Matcher {
  std::string name;
  std::function<bool(const Pair& pair, const Pair& gray, Turn* turn, std::string* error)> open;
  Average errors;
  std::vector<double> milliseconds;  // of each pair, medians

  double mean_milliseconds() const {
    double sum = 0.0;
    for (const double ms : milliseconds) sum += ms;
    return sum / static_cast<double>(milliseconds.size());
  }
};

Matcher opencv_matcher(const std::string& name, OpencvMethod method) {
  Matcher matcher;
  matcher.name = opencv_name() + " " + name;
  matcher.open = [method](const Pair&, const Pair& gray, Turn* turn, std::string*) {
    const auto opencv = std::make_shared<OpencvMatcher>(gray, method);
    turn->match = [opencv](double* milliseconds, std::string*) {
      *milliseconds = opencv->match();
      return true;
    };
    turn->map = [opencv] { return opencv->map(); };
    return true;
  };
  return matcher;
}

Matcher library_matcher(const Configuration& configuration, const Arguments& arguments) {
  Matcher matcher;
  matcher.name = configuration.name;
  const bool use_gray = arguments.gray;
  const uint32_t isa_mask = arguments.isa_mask;
  matcher.open = [=](const Pair& pair, const Pair& gray, Turn* turn, std::string* error) {
    const Pair& views = use_gray ? gray : pair;
    bsm_config config = configuration.config;
    config.width = views.left.width;
    config.height = views.left.height;
    config.num_disparities = views.num_disparities;
    config.isa_mask = isa_mask;
    const auto run = std::make_shared<FrameRun>();
    if (!run->open(config, error)) return false;
    turn->match = [run, &views](double* milliseconds, std::string* problem) {
      return run->match(views.left, views.right, milliseconds, problem);
    };
    turn->map = [run] {
      const bsm_config& c = run->config();
      return host::disparity_map(run->disparity().data(), c.width, c.height, bsm_invalid_disparity(&c));
    };
    return true;
  };
  return matcher;
}

std::vector<Matcher> all_matchers(const Arguments& arguments) {
  std::vector<Matcher> matchers = {opencv_matcher("StereoBM", OpencvMethod::kBlock),
                                   opencv_matcher("StereoSGBM 3-way", OpencvMethod::kSgbm3Way),
                                   opencv_matcher("StereoSGBM 5-path", OpencvMethod::kSgbm5Path)};
  for (const Configuration& configuration :
       {preset_configuration(BSM_PRESET_FAST, arguments.gray), preset_configuration(BSM_PRESET_BALANCED, arguments.gray),
        local_configuration(256, arguments.gray), local_configuration(BSM_MAX_BITS, arguments.gray),
        preset_configuration(BSM_PRESET_PAPER, arguments.gray)}) {
    matchers.push_back(library_matcher(configuration, arguments));
  }
  return matchers;
}

// Every matcher on one pair, in turn.
bool measure_pair(const Pair& pair, int32_t repeat, std::vector<Matcher>* matchers, std::string* error) {
  Pair gray = pair;
  gray.left = to_gray(pair.left);
  gray.right = to_gray(pair.right);
  std::vector<Turn> turns(matchers->size());
  std::vector<std::vector<double>> milliseconds(matchers->size());
  for (size_t i = 0; i < turns.size(); ++i) {
    if (!(*matchers)[i].open(pair, gray, &turns[i], error)) return false;
  }
  for (int32_t round = -1; round < repeat; ++round) {  // the round before the first touches the memory and is not kept
    for (size_t i = 0; i < turns.size(); ++i) {
      double ms = 0.0;
      if (!turns[i].match(&ms, error)) return false;
      if (round >= 0) milliseconds[i].push_back(ms);
    }
  }
  for (size_t i = 0; i < turns.size(); ++i) {
    (*matchers)[i].milliseconds.push_back(median(milliseconds[i]));
    (*matchers)[i].errors.add(score_map(pair, turns[i].map(), {1.0}));
  }
  return true;
}

std::string error_cell(const Average& errors, int region) {
  return errors.has_region(region) ? fixed(errors.region(0, region)) : "";
}

Table table_of(const std::vector<Pair>& pairs, const std::vector<Matcher>& matchers) {
  Table table;
  table.columns = {"matcher", "average", "nonocc", "all", "disc", "mean ms"};
  for (const Pair& pair : pairs) table.columns.push_back("ms " + pair.name);
  for (const Matcher& matcher : matchers) {
    std::vector<std::string> cells = {matcher.name, fixed(matcher.errors.mean(0))};
    for (int region = 0; region < kRegionCount; ++region) cells.push_back(error_cell(matcher.errors, region));
    cells.push_back(fixed(matcher.mean_milliseconds(), 1));
    for (const double ms : matcher.milliseconds) cells.push_back(fixed(ms, 1));
    table.add(cells);
  }
  return table;
}

std::string plot_of(const std::vector<Matcher>& matchers) {
  LinePlot plot;
  plot.title = "Error against time, one thread";
  plot.x_label = "mean time of a pair (ms)";
  plot.y_label = "average of the bad pixels (%)";
  plot.log_x = true;
  for (double tick = 1.0; tick < 1e6; tick *= 2.0) plot.x_ticks.push_back(tick);
  plot.from_zero = true;
  for (const Matcher& matcher : matchers) {
    plot.series.push_back({matcher.name, {matcher.mean_milliseconds()}, {matcher.errors.mean(0)}});
  }
  return draw_lines(plot);
}

bool run(const Arguments& arguments, std::string* error) {
  std::vector<Pair> pairs;
  if (!load_pairs(arguments.folder, arguments.pairs, &pairs, error)) return false;
  std::vector<Matcher> matchers = all_matchers(arguments);
  for (size_t i = 0; i < pairs.size(); ++i) {
    std::fprintf(stderr, "[%zu/%zu] %s\n", i + 1, pairs.size(), pairs[i].name.c_str());
    if (!measure_pair(pairs[i], arguments.repeat, &matchers, error)) {
      *error = pairs[i].name + ": " + *error;
      return false;
    }
  }
  const Table table = table_of(pairs, matchers);
  if (arguments.csv) {
    std::fputs(to_csv(table).c_str(), stdout);
  } else {
    std::printf(
        "%zu pairs, one thread, medians of %d runs in turn; bad pixels in percent. This library: %s views, --isa %s.\n\n",
        pairs.size(), static_cast<int>(arguments.repeat), arguments.gray ? "gray" : "colour", arguments.isa.c_str());
    std::fputs(to_text(table).c_str(), stdout);
  }
  if (arguments.svg.empty()) return true;
  const std::string svg = plot_of(matchers);
  return host::write_file(arguments.svg, std::vector<uint8_t>(svg.begin(), svg.end()), error);
}

int main_program(int argc, char** argv) {
  Arguments arguments;
  host::Options options(kProgram, kUsage, kSummary);
  options.positional("FOLDER", &arguments.folder);
  options.integer("--repeat", "R", &arguments.repeat, 1, 1000, "runs of each matcher on each pair; the median is reported");
  options.word("--svg", "FILE", &arguments.svg, "a plot of error against time");
  options.flag("--gray", &arguments.gray, "gray views for this library too");
  options.word("--isa", "NAME", &arguments.isa, "this library's instructions: auto, scalar or a name from 'bsm info'");
  options.word("--pairs", "FILE", &arguments.pairs.pairs_file, "table of 'name disparities scale', before all others");
  options.flag("--csv", &arguments.csv, "comma-separated values");
  int exit_code = kExitOk;
  if (!parse_command_line(argc, argv, &options, &exit_code)) return exit_code;
  std::string error;
  if (!host::isa_mask_of(arguments.isa, &arguments.isa_mask, &error)) {
    complain(kProgram, error);
    return kExitUsage;
  }
  if (run(arguments, &error)) return kExitOk;
  complain(kProgram, error);
  return kExitData;
}

}  // namespace
}  // namespace bsm::bench

int main(int argc, char** argv) {
  int exit_code = bsm::bench::kExitData;
  try {
    exit_code = bsm::bench::main_program(argc, argv);
  } catch (const std::bad_alloc&) {
    bsm::bench::complain(bsm::bench::kProgram, "out of memory");
  } catch (const std::exception& failure) {  // OpenCV's own
    bsm::bench::complain(bsm::bench::kProgram, failure.what());
  }
  return bsm::bench::finish_output(bsm::bench::kProgram, exit_code);
}
