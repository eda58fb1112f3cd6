// bsm_quality: matches a folder of pairs with ground truth and prints errors, times and memory.
#include <algorithm>
#include <cstdio>
#include <new>
#include <string>
#include <vector>

#include "bench/command_line.h"
#include "bench/match_pair.h"
#include "bench/pair_set.h"
#include "bench/score.h"
#include "bench/table.h"
#include "bsm/bsm.h"
#include "host/config_options.h"
#include "host/options.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

using host::text;

constexpr char kProgram[] = "bsm_quality";
constexpr char kUsage[] = "bsm_quality FOLDER [options]";
constexpr char kSummary[] =
    "Matches every pair of FOLDER and compares the maps with the ground truth, as the Middlebury benchmark does: a pixel\n"
    "counts where the region's mask is 255 and the truth is known; it is bad when |disparity - truth| is above the\n"
    "threshold or the disparity is invalid. A pair is a folder, one or two levels down, with left.ppm, right.ppm and\n"
    "disparity.pgm; nonocc.pgm, all.pgm and disc.pgm are its regions. Without masks: nonocc by cross-checking with\n"
    "disparity_right.pgm, all = known truth, disc = visible pixels near a jump of the truth. The number of disparities\n"
    "and the truth's scale come from a table by the folder's name; a pairs.txt in FOLDER adds to it;\n"
    "--disparities replaces it.";

// Always scored, after the thresholds that were asked for.
constexpr double kFixedThresholds[] = {0.5, 1.0, 2.0};
constexpr size_t kFixedCount = sizeof(kFixedThresholds) / sizeof(kFixedThresholds[0]);

struct Arguments {
  std::string folder;
  host::ConfigOptions config;
  PairSetOptions pairs;
  std::vector<std::string> threshold_words, group_words;
  std::vector<double> thresholds;
  std::vector<Group> groups;
  int32_t repeat = 1;
  bool own_disparities = false;
  bool csv = false;
};

struct Measured {
  std::string name;
  Score score;
  Match match;
};

bool parse_threshold(const std::string& word, double* threshold) {
  char* end = nullptr;
  *threshold = std::strtod(word.c_str(), &end);
  return *end == '\0' && *threshold >= 0.0 && *threshold <= 1e6;
}

bool check_arguments(const host::Options& options, Arguments* arguments, std::string* error) {
  for (const std::string& word : arguments->threshold_words) {
    double threshold = 0.0;
    if (!parse_threshold(word, &threshold)) {
      *error = "--threshold '" + word + "': not a number of pixels of at least 0";
      return false;
    }
    arguments->thresholds.push_back(threshold);
  }
  if (arguments->thresholds.empty()) arguments->thresholds.push_back(1.0);
  for (const std::string& word : arguments->group_words) {
    Group group;
    if (!parse_group(word, &group, error)) return false;
    arguments->groups.push_back(group);
  }
  arguments->own_disparities = options.given("--disparities");
  // Presets weigh gray images differently, so that the format comes first.
  arguments->config.config.format = arguments->pairs.gray ? BSM_FORMAT_GRAY8 : BSM_FORMAT_RGB24;
  if (!arguments->config.finish(error)) return false;
  size_t bytes = 0;
  const bsm_status status = bsm_memory_required(&arguments->config.config, &bytes);
  if (status < 0) *error = host::config_error(status);
  return status >= 0;
}

bool check_groups(const std::vector<Group>& groups, const std::vector<Pair>& pairs, std::string* error) {
  for (const Group& group : groups) {
    for (const std::string& name : group.pairs) {
      const bool found = std::any_of(pairs.begin(), pairs.end(), [&](const Pair& pair) { return pair.name == name; });
      if (found) continue;
      *error = "--group " + group.name + ": there is no pair " + name;
      return false;
    }
  }
  return true;
}

std::string kilobytes(size_t bytes) {
  return text("%.0f", static_cast<double>(bytes) / 1024.0);
}

// One threshold's row of a pair or an average; Scored is Score or Average.
template <typename Regions>
std::vector<std::string> error_cells(const Regions& regions, double mean) {
  std::vector<std::string> cells;
  for (int region = 0; region < kRegionCount; ++region) cells.push_back(regions(region));
  cells.push_back(fixed(mean));
  return cells;
}

std::vector<std::string> score_cells(const Score& score, size_t threshold) {
  return error_cells(
      [&](int region) {
        const size_t r = static_cast<size_t>(region);
        return score.has_region[r] ? fixed(score.bad[threshold][r]) : std::string("-");
      },
      score.mean(threshold));
}

std::vector<std::string> average_cells(const Average& average, size_t threshold) {
  return error_cells(
      [&](int region) { return average.has_region(region) ? fixed(average.region(threshold, region)) : std::string("-"); },
      average.mean(threshold));
}

// A row for every pair, one for the average of all, one for each group.
struct Summary {
  std::string name;
  Average average;
  double ms = 0.0;
  size_t arena = 0;
};

std::vector<Summary> summarize(const std::vector<Measured>& measured, const std::vector<Group>& groups) {
  std::vector<Group> all = {{"average", {}}};
  for (const Measured& pair : measured) all[0].pairs.push_back(pair.name);
  all.insert(all.end(), groups.begin(), groups.end());
  std::vector<Summary> summaries;
  for (const Group& group : all) {
    Summary summary;
    summary.name = group.name;
    for (const Measured& pair : measured) {
      if (std::find(group.pairs.begin(), group.pairs.end(), pair.name) == group.pairs.end()) continue;
      summary.average.add(pair.score);
      summary.ms += pair.match.ms_median;
      summary.arena = std::max(summary.arena, pair.match.arena_bytes);
    }
    summary.ms /= static_cast<double>(std::max<size_t>(1, summary.average.pairs()));
    summaries.push_back(summary);
  }
  return summaries;
}

void append(std::vector<std::string>* cells, std::vector<std::string> more) {
  cells->insert(cells->end(), more.begin(), more.end());
}

// The first threshold's table carries the rest: mean error, the fixed thresholds, time, memory.
Table full_table(const Arguments& arguments, const std::vector<Measured>& measured) {
  Table table;
  table.columns = {"pair", "nonocc", "all", "disc", "mean"};
  for (const double threshold : kFixedThresholds) table.columns.push_back(text("> %.1f", threshold));
  append(&table.columns, {"mean error", "ms", "arena KB"});
  const size_t first_fixed = arguments.thresholds.size();
  for (const Measured& pair : measured) {
    std::vector<std::string> cells = {pair.name};
    append(&cells, score_cells(pair.score, 0));
    for (size_t t = 0; t < kFixedCount; ++t) cells.push_back(fixed(pair.score.mean(first_fixed + t)));
    append(&cells, {fixed(pair.score.mean_error, 3), fixed(pair.match.ms_median, 1), kilobytes(pair.match.arena_bytes)});
    table.add(cells);
  }
  for (const Summary& summary : summarize(measured, arguments.groups)) {
    std::vector<std::string> cells = {summary.name};
    append(&cells, average_cells(summary.average, 0));
    for (size_t t = 0; t < kFixedCount; ++t) cells.push_back(fixed(summary.average.mean(first_fixed + t)));
    append(&cells, {fixed(summary.average.mean_error(), 3), fixed(summary.ms, 1), kilobytes(summary.arena)});
    table.add(cells);
  }
  return table;
}

Table short_table(const Arguments& arguments, const std::vector<Measured>& measured, size_t threshold) {
  Table table;
  table.columns = {"pair", "nonocc", "all", "disc", "mean"};
  for (const Measured& pair : measured) {
    std::vector<std::string> cells = {pair.name};
    append(&cells, score_cells(pair.score, threshold));
    table.add(cells);
  }
  for (const Summary& summary : summarize(measured, arguments.groups)) {
    std::vector<std::string> cells = {summary.name};
    append(&cells, average_cells(summary.average, threshold));
    table.add(cells);
  }
  return table;
}

// One line per pair or average and threshold.
Table csv_table(const Arguments& arguments, const std::vector<Measured>& measured) {
  Table table;
  table.columns = {"pair", "threshold", "nonocc", "all", "disc", "mean", "mean_error", "ms", "arena_bytes"};
  const size_t count = arguments.thresholds.size() + kFixedCount;
  const auto threshold_of = [&](size_t t) {
    const size_t asked = arguments.thresholds.size();
    return t < asked ? arguments.thresholds[t] : kFixedThresholds[t - asked];
  };
  const auto repeated = [&](size_t t) {
    for (size_t before = 0; before < t; ++before) {
      if (threshold_of(before) == threshold_of(t)) return true;
    }
    return false;
  };
  for (size_t t = 0; t < count; ++t) {
    if (repeated(t)) continue;
    const std::string threshold = text("%g", threshold_of(t));
    for (const Measured& pair : measured) {
      std::vector<std::string> cells = {pair.name, threshold};
      append(&cells, score_cells(pair.score, t));
      append(&cells, {fixed(pair.score.mean_error, 4), fixed(pair.match.ms_median, 3), text("%zu", pair.match.arena_bytes)});
      table.add(cells);
    }
    for (const Summary& summary : summarize(measured, arguments.groups)) {
      std::vector<std::string> cells = {summary.name, threshold};
      append(&cells, average_cells(summary.average, t));
      append(&cells, {fixed(summary.average.mean_error(), 4), fixed(summary.ms, 3), text("%zu", summary.arena)});
      table.add(cells);
    }
  }
  return table;
}

void print_text(const Arguments& arguments, const std::vector<Measured>& measured) {
  const bsm_config& config = measured.front().match.config;
  std::printf("preset %s: %s, %d bits, %s map%s%s, %d thread%s\n\n", arguments.config.preset(),
              host::method_name(config.method), static_cast<int>(config.bits), host::stage_name(config.stage),
              config.method == BSM_METHOD_SGM ? text(", %d paths", config.paths).c_str() : "",
              arguments.pairs.gray ? ", gray" : "", static_cast<int>(config.max_jobs), config.max_jobs == 1 ? "" : "s");
  std::printf(
      "Bad pixels in percent, error above %g; mean = of the regions; > t = the mean at threshold t; ms = median of %d;\n"
      "mean error in pixels over all known pixels; averages: of all numbers, of the times, the largest arena.\n\n",
      arguments.thresholds[0], static_cast<int>(arguments.repeat));
  std::fputs(to_text(full_table(arguments, measured)).c_str(), stdout);
  for (size_t t = 1; t < arguments.thresholds.size(); ++t) {
    std::printf("\nError above %g\n\n", arguments.thresholds[t]);
    std::fputs(to_text(short_table(arguments, measured, t)).c_str(), stdout);
  }
}

int run(Arguments* arguments) {
  std::string error;
  std::vector<Pair> pairs;
  if (!load_pairs(arguments->folder, arguments->pairs, &pairs, &error) || !check_groups(arguments->groups, pairs, &error)) {
    complain(kProgram, error);
    return kExitData;
  }
  std::vector<double> thresholds = arguments->thresholds;
  thresholds.insert(thresholds.end(), kFixedThresholds, kFixedThresholds + kFixedCount);
  std::vector<Measured> measured;
  for (const Pair& pair : pairs) {
    std::fprintf(stderr, "[%zu/%zu] %s\n", measured.size() + 1, pairs.size(), pair.name.c_str());
    bsm_config config = arguments->config.config;
    if (!arguments->own_disparities) config.num_disparities = pair.num_disparities;
    Measured result;
    result.name = pair.name;
    if (!match_pair(pair, config, arguments->repeat, &result.match, &error)) {
      complain(kProgram, error);
      return kExitData;
    }
    result.score = score_map(pair, result.match.map, thresholds);
    measured.push_back(std::move(result));
  }
  if (arguments->csv) {
    std::fputs(to_csv(csv_table(*arguments, measured)).c_str(), stdout);
  } else {
    print_text(*arguments, measured);
  }
  return kExitOk;
}

int main_program(int argc, char** argv) {
  Arguments arguments;
  host::Options options(kProgram, kUsage, kSummary);
  options.positional("FOLDER", &arguments.folder);
  arguments.config.add_search(&options);
  arguments.config.add_stage(&options);
  options.words("--threshold", "T", &arguments.threshold_words,
                "largest error that is not bad, in pixels; several times for several tables [1]");
  options.flag("--gray", &arguments.pairs.gray, "images as luma, 8 bits");
  options.words("--group", "NAME=A,B", &arguments.group_words, "averages over these pairs too; may be given several times");
  options.word("--pairs", "FILE", &arguments.pairs.pairs_file, "table of 'name disparities scale', before all others");
  options.integer("--repeat", "R", &arguments.repeat, 1, 1000000, "match each pair R times and report the median time");
  options.flag("--csv", &arguments.csv, "comma-separated values");
  int exit_code = kExitOk;
  if (!parse_command_line(argc, argv, &options, &exit_code)) return exit_code;
  std::string error;
  if (!check_arguments(options, &arguments, &error)) {
    complain(kProgram, error);
    return kExitUsage;
  }
  return run(&arguments);
}

}  // namespace
}  // namespace bsm::bench

int main(int argc, char** argv) {
  int exit_code = bsm::bench::kExitData;
  try {
    exit_code = bsm::bench::main_program(argc, argv);
  } catch (const std::bad_alloc&) {
    bsm::bench::complain(bsm::bench::kProgram, "out of memory");
  }
  return bsm::bench::finish_output(bsm::bench::kProgram, exit_code);
}
