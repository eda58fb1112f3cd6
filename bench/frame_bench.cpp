// Measures frames: one context for each stage that the map can come from, the contexts in turn. With several threads each
// stage has a second context for one thread, which takes its turn too.
#include "bench/frame_bench.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include "bench/frame_run.h"
#include "bench/statistics.h"
#include "bench/table.h"
#include "bsm/bsm.h"
#include "host/image.h"
#include "host/run_match.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

using host::text;

constexpr double kNoisy = 2.0;  // slowest run over fastest above which a note is printed

// A context whose map is that of one stage.
struct StageRun {
  FrameRun frames;
  std::vector<double> milliseconds;
  FrameRun alone;  // the same in one thread; opened where there are several
  std::vector<double> milliseconds_alone;

  bool open(bsm_config config, std::string* error) {
    if (!frames.open(config, error)) return false;
    const bool several = config.max_jobs > 1;
    config.max_jobs = 1;
    return !several || alone.open(config, error);
  }
  bool match(const host::Image8& left, const host::Image8& right, std::string* error) {
    if (!frames.match(left, right, &milliseconds.emplace_back(), error)) return false;
    return alone.context() == nullptr || alone.match(left, right, &milliseconds_alone.emplace_back(), error);
  }
  const bsm_config& config() const { return frames.config(); }
  double fastest() const { return *std::min_element(milliseconds.begin(), milliseconds.end()); }
  double slowest() const { return *std::max_element(milliseconds.begin(), milliseconds.end()); }
};

using Runs = std::vector<std::unique_ptr<StageRun>>;

// Contexts of the stages that the method has, the last of them refined.
bool open_runs(bsm_config config, Runs* runs, std::string* error) {
  for (const bsm_stage stage :
       {BSM_STAGE_COST, BSM_STAGE_MASKED, BSM_STAGE_AGGREGATED, BSM_STAGE_CHECKED, BSM_STAGE_REFINED}) {
    config.stage = stage;
    size_t bytes = 0;
    if (bsm_memory_required(&config, &bytes) == BSM_ERROR_STAGE) continue;
    runs->push_back(std::make_unique<StageRun>());
    if (!runs->back()->open(config, error)) return false;
  }
  return true;
}

bool measure(const host::Image8& left, const host::Image8& right, int32_t repeat, const Runs& runs, std::string* error) {
  for (int32_t i = -1; i < repeat; ++i) {
    for (const std::unique_ptr<StageRun>& run : runs) {
      if (!run->match(left, right, error)) return false;
      if (i >= 0) continue;  // the round before the first touches the memory and is not kept
      run->milliseconds.clear();
      run->milliseconds_alone.clear();
    }
  }
  return true;
}

// Whole frames at each length that the method takes, in turn.
bool open_lengths(bsm_config config, Runs* runs, std::string* error) {
  constexpr int32_t kLeast = 256;
  const int32_t most = config.method == BSM_METHOD_SGM ? BSM_MAX_SGM_BITS : BSM_MAX_BITS;
  for (config.bits = kLeast; config.bits <= most; config.bits *= 2) {
    runs->push_back(std::make_unique<StageRun>());
    if (!runs->back()->open(config, error)) return false;
  }
  return true;
}

// Million disparity evaluations a second.
double mde(const bsm_config& config, double milliseconds) {
  return 1e-3 * config.width * config.height * config.num_disparities / milliseconds;
}

std::string name_of(const StageRun& run) {
  return host::stage_name(run.config().stage);
}

// Median of the rounds' differences: both runs of a round meet the same machine.
double difference(const StageRun& run, const StageRun& before) {
  std::vector<double> differences;
  for (size_t i = 0; i < run.milliseconds.size(); ++i) {
    differences.push_back(run.milliseconds[i] - before.milliseconds[i]);
  }
  return median(differences);
}

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

// One thread's time over that of several: the median of the rounds' ratios.
double speedup(const StageRun& run) {
  std::vector<double> ratios;
  for (size_t i = 0; i < run.milliseconds.size(); ++i) ratios.push_back(run.milliseconds_alone[i] / run.milliseconds[i]);
  return median(ratios);
}

// Two more columns of a table with a row for each run, where the runs have several threads.
void compare_with_one_thread(const Runs& runs, Table* table) {
  if (runs.front()->milliseconds_alone.empty()) return;
  table->columns.insert(table->columns.end(), {"ms_one_thread", "speedup"});
  for (size_t i = 0; i < runs.size(); ++i) {
    std::vector<std::string>& cells = table->rows[i];
    cells.insert(cells.end(), {fixed(median(runs[i]->milliseconds_alone)), fixed(speedup(*runs[i]))});
  }
}

// A line about them, or none.
const char* explain_threads(const Runs& runs) {
  return runs.front()->milliseconds_alone.empty()
             ? ""
             : "\n'ms_one_thread' is a run in one thread, each in turn too; 'speedup' the median of the rounds' ratios.";
}

Table table_of_lengths(const Runs& runs) {
  Table table;
  table.columns = {"bits", "ms_median", "ms_min", "mde_per_s", "arena_bytes"};
  for (const std::unique_ptr<StageRun>& run : runs) {
    const double ms = median(run->milliseconds);
    table.add({std::to_string(run->config().bits), fixed(ms), fixed(run->fastest()), fixed(mde(run->config(), ms), 1),
               std::to_string(run->frames.arena_bytes())});
  }
  compare_with_one_thread(runs, &table);
  return table;
}

void print_csv(const FrameBench& bench, const Runs& runs) {
  Table table;
  table.columns = {"stage",       "ms_min", "ms_median", "ms_stage", "mde_per_s", "width",   "height",      "min_disparity",
                   "disparities", "preset", "method",    "bits",     "paths",     "threads", "arena_bytes", "kernels"};
  for (size_t i = 0; i < runs.size(); ++i) {
    const StageRun& run = *runs[i];
    const bsm_config& c = run.config();
    const double ms = median(run.milliseconds);
    table.add({name_of(run), fixed(run.fastest(), 3), fixed(ms, 3), fixed(i == 0 ? ms : difference(run, *runs[i - 1]), 3),
               fixed(mde(c, ms), 1), std::to_string(c.width), std::to_string(c.height), std::to_string(c.min_disparity),
               std::to_string(c.num_disparities), bench.config.preset(), host::method_name(c.method), std::to_string(c.bits),
               c.method == BSM_METHOD_SGM ? std::to_string(c.paths) : "", std::to_string(c.max_jobs),
               std::to_string(run.frames.arena_bytes()), joined(host::kernel_names(run.frames.context()))});
  }
  compare_with_one_thread(runs, &table);
  std::fputs(to_csv(table).c_str(), stdout);
}

// Sizes, settings, threads and kernels of a run.
void print_heading(const FrameBench& bench, const StageRun& run, const std::string& bits) {
  const bsm_config& c = run.config();
  std::printf("%d x %d pixels, %s, disparities %d..%d; preset %s: %s, %s bits%s\n", static_cast<int>(c.width),
              static_cast<int>(c.height), host::format_name(c.format), static_cast<int>(c.min_disparity),
              static_cast<int>(c.min_disparity + c.num_disparities - 1), bench.config.preset(), host::method_name(c.method),
              bits.c_str(), c.method == BSM_METHOD_SGM ? text(", %d paths", static_cast<int>(c.paths)).c_str() : "");
  std::printf("%d thread%s, arena %.0f KB, --isa %s; kernels:\n", static_cast<int>(c.max_jobs), c.max_jobs == 1 ? "" : "s",
              static_cast<double>(run.frames.arena_bytes()) / 1024.0, bench.config.isa.c_str());
  for (const std::string& name : host::kernel_names(run.frames.context())) std::printf("  %s\n", name.c_str());
}

void print_lengths(const FrameBench& bench, const Runs& runs) {
  print_heading(bench, *runs.back(), "256 and more");
  std::printf("\nWhole frames, medians of %d runs, the lengths in turn.%s\n\n", static_cast<int>(bench.repeat),
              explain_threads(runs));
  std::fputs(to_text(table_of_lengths(runs)).c_str(), stdout);
}

void print_text(const FrameBench& bench, const Runs& runs) {
  const StageRun& whole = *runs.back();
  const bsm_config& c = whole.config();
  const double ms = median(whole.milliseconds);
  print_heading(bench, whole, std::to_string(c.bits));
  std::printf("\nframe: %.2f ms (median of %d, least %.2f), %.0f MDE/s\n\n", ms, static_cast<int>(bench.repeat),
              whole.fastest(), mde(c, ms));
  std::printf(
      "Whole runs up to each stage, taken in turn. 'stage' is the median difference to the run of the stage before, no "
      "time\n"
      "taken inside a run: a step that one run does otherwise than the next counts in both, and may make it negative.%s\n\n",
      explain_threads(runs));
  Table table;
  table.columns = {"up to", "ms", "least", "stage", "max/min"};
  bool noisy = false;
  for (size_t i = 0; i < runs.size(); ++i) {
    const StageRun& run = *runs[i];
    const double run_ms = median(run.milliseconds);
    const double spread = run.slowest() / run.fastest();
    noisy = noisy || spread > kNoisy;
    table.add({name_of(run), fixed(run_ms), fixed(run.fastest()), fixed(i == 0 ? run_ms : difference(run, *runs[i - 1])),
               fixed(spread)});
  }
  compare_with_one_thread(runs, &table);
  std::fputs(to_text(table).c_str(), stdout);
  if (noisy) std::printf("\nNote: runs of a stage are more than %.0f times apart; the machine is busy.\n", kNoisy);
}

}  // namespace

bool run_frame_bench(FrameBench* bench, std::string* error) {
  host::Image8 left, right;
  if (!read_views(bench->left, bench->right, &left, &right, error)) return false;
  bench->config.set_format(left.channels == 3 ? BSM_FORMAT_RGB24 : BSM_FORMAT_GRAY8);
  bsm_config config = bench->config.config;
  config.width = left.width;
  config.height = left.height;
  Runs runs;
  if (!(bench->lengths ? open_lengths(config, &runs, error) : open_runs(config, &runs, error))) return false;
  if (!measure(left, right, bench->repeat, runs, error)) return false;
  if (bench->lengths && bench->csv) {
    std::fputs(to_csv(table_of_lengths(runs)).c_str(), stdout);
  } else if (bench->lengths) {
    print_lengths(*bench, runs);
  } else if (bench->csv) {
    print_csv(*bench, runs);
  } else {
    print_text(*bench, runs);
  }
  return true;
}

}  // namespace bsm::bench
