// Measures both forms of each saving in turn.
#include "bench/savings_bench.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <vector>

#include "bench/savings_list.h"
#include "bench/statistics.h"
#include "bench/table.h"

namespace bsm::bench {
namespace {

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

constexpr double kLeastNs = 1e6;  // of a measurement: the clock counts microseconds

// Processor time, which other programs of a busy machine take no part in, of one of `times` runs.
double nanoseconds_of(const std::function<void()>& run, int32_t times) {
  const std::clock_t begin = std::clock();
  for (int32_t i = 0; i < times; ++i) run();
  return 1e9 / CLOCKS_PER_SEC * static_cast<double>(std::clock() - begin) / times;
}

// Of each round.
struct Times {
  std::vector<double> plain_ns, saved_ns, ratio;
};

Times measure(int32_t repeat, const Saving& saving) {
  Times times;
  int32_t runs = 1;
  while (nanoseconds_of(saving.saved, runs) * runs < kLeastNs) runs *= 2;
  for (int32_t round = 0; round < repeat; ++round) {
    times.plain_ns.push_back(nanoseconds_of(saving.plain, runs));
    times.saved_ns.push_back(nanoseconds_of(saving.saved, runs));
    times.ratio.push_back(times.plain_ns.back() / times.saved_ns.back());
  }
  return times;
}

}  // namespace

namespace {

std::string title(const Saving& saving) {
  return saving.where + ": " + saving.name;
}

// Runs each form once. False with a sentence when they wrote different bytes.
bool agree(const Saving& saving, std::string* error) {
  saving.plain();
  saving.saved();
  if (saving.same()) return true;
  *error = "'" + saving.name + "' changes what " + saving.where + " writes";
  return false;
}

// What an emulator counts.
bool run_form(const SavingsBench& bench, const std::vector<Saving>& savings, std::string* error) {
  for (const Saving& saving : savings) {
    if (!agree(saving, error)) return false;
    for (int32_t i = 0; i < bench.repeat; ++i) (bench.count == "plain" ? saving.plain : saving.saved)();
  }
  return true;
}

}  // namespace

bool run_savings_bench(SavingsBench* bench, std::string* error) {
  host::Image8 left, right;
  if (!read_views(bench->left, bench->right, &left, &right, error)) return false;
  bench->config.set_format(left.channels == 3 ? BSM_FORMAT_RGB24 : BSM_FORMAT_GRAY8);
  bsm_config config = bench->config.config;
  config.width = left.width;
  config.height = left.height;
  PairRows rows;
  const bool untimed = bench->list || !bench->count.empty();
  if (!rows.open(left, right, config, !untimed, error)) return false;
  std::vector<Saving> savings = all_savings(rows);
  savings.erase(
      std::remove_if(savings.begin(), savings.end(),
                     [bench](const Saving& saving) { return title(saving).find(bench->filter) == std::string::npos; }),
      savings.end());
  if (bench->list) {
    for (const Saving& saving : savings) std::puts(title(saving).c_str());
    return true;
  }
  if (untimed) return run_form(*bench, savings, error);
  Table table;
  table.columns = {"saving", "in", "plain ns/px", "ns/px", "x", "x 25 %", "x 75 %"};
  const double pixels = static_cast<double>(rows.sampled().size()) * rows.width();
  for (const Saving& saving : savings) {
    if (!agree(saving, error)) return false;
    const Times times = measure(bench->repeat, saving);
    table.add({saving.name, saving.where, fixed(median(times.plain_ns) / pixels), fixed(median(times.saved_ns) / pixels),
               fixed(median(times.ratio)), fixed(quantile(times.ratio, 0.25)), fixed(quantile(times.ratio, 0.75))});
  }
  if (bench->csv) {
    std::fputs(to_csv(table).c_str(), stdout);
    return true;
  }
  std::printf(
      "%zu rows of %d pixels, %s, preset %s, %d bits, disparities %d..%d; both forms wrote the same bytes. Processor time,\n"
      "medians of %d rounds, the two forms in turn; x: the plain form's time as a multiple, median and quartiles of the\n"
      "rounds' ratios.\n\n",
      rows.sampled().size(), static_cast<int>(rows.width()), left.channels == 1 ? "gray" : "colour", bench->config.preset(),
      static_cast<int>(config.bits), static_cast<int>(config.min_disparity),
      static_cast<int>(config.min_disparity + config.num_disparities - 1), static_cast<int>(bench->repeat));
  std::fputs(to_text(table).c_str(), stdout);
  return true;
}

}  // namespace bsm::bench
