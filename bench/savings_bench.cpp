// Measures both forms of each saving in turn.
#include "bench/savings_bench.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>
#include <memory>
#include <vector>

#include "bench/pair_rows.h"
#include "bench/plain_forms.h"
#include "bench/statistics.h"
#include "bench/table.h"

namespace bsm::bench {
namespace {

// What a kernel wrote.
struct Output {
  const void* begin;
  size_t bytes;
};

size_t values(int32_t a, int32_t b) {
  return static_cast<size_t>(a) * static_cast<size_t>(b);
}

std::vector<Output> outputs(const MaskThresholdArgs& args) {
  return {{args.out, values(args.width, args.pattern.bits / 8)}};
}
std::vector<Output> outputs(const MatchHammingArgs& args) {
  return {{args.left_level, values(args.width, 2)}, {args.right_level, values(args.width, 2)}};
}
std::vector<Output> outputs(const AggregateAlongArgs& args) {
  std::vector<Output> pixels;
  for (int32_t x = 0; x < args.width; ++x)
    pixels.push_back({args.sum + values(x, args.stride), values(args.num_disparities, 2)});
  return pixels;
}
std::vector<Output> outputs(const MedianWeightedArgs& args) {
  return {{args.out, values(args.width, 2)}};
}

bool equal(const std::vector<Output>& a, const std::vector<Output>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Output& one, const Output& other) {
    return one.bytes == other.bytes && std::memcmp(one.begin, other.begin, one.bytes) == 0;
  });
}

template <class Args>
struct Form {
  void (*run)(const Args&);
  kernel_scratch_fn* scratch;
};

// One saving: all sampled rows by each form.
struct Saving {
  std::string name, kernel;
  std::function<void()> plain, saved;
  std::function<bool()> same;
  std::vector<double> plain_ns, saved_ns, times;  // of each round
};

template <class Args>
Saving saving(const PairRows& rows, const char* name, const char* kernel, Form<Args> plain, Form<Args> saved) {
  using Calls = std::vector<Call<Args>>;
  const auto calls_of = [&rows](const Form<Args>& form) {
    const auto calls = std::make_shared<Calls>();
    for (const int32_t y : rows.sampled()) calls->push_back(rows.call<Args>(y, form.scratch));
    return calls;
  };
  const auto run_all = [](void (*run)(const Args&), const std::shared_ptr<Calls>& calls) {
    return [run, calls] {
      for (const Call<Args>& call : *calls) run(call.args);
    };
  };
  const auto without = calls_of(plain), with = calls_of(saved);
  const auto same = [without, with] {
    return std::equal(without->begin(), without->end(), with->begin(), with->end(),
                      [](const Call<Args>& a, const Call<Args>& b) { return equal(outputs(a.args), outputs(b.args)); });
  };
  return Saving{name, kernel, run_all(plain.run, without), run_all(saved.run, with), same, {}, {}, {}};
}

std::vector<Saving> all_savings(const PairRows& rows) {
  using Mask = Form<MaskThresholdArgs>;
  using Match = Form<MatchHammingArgs>;
  const Mask mask{mask_threshold_scalar, mask_threshold_scalar_scratch};
  std::vector<Saving> list;
  list.push_back(saving<MaskThresholdArgs>(rows, "colours compared once a window offset, not by each pair",
                                           "mask_threshold_scalar", {mask_colors_by_pair, mask_colors_by_pair_scratch},
                                           mask));
#if BSM_ARCH_X86_64 && defined(BSM_BENCH_AVX2)
  if ((kIsaAvx2 & ~cpu_features()) == 0) {
    const Mask avx2{mask_threshold_avx2, mask_threshold_avx2_scratch};
    const Mask by_pair{mask_threshold_by_pair_avx2, mask_threshold_avx2_scratch};
    const Mask bisection{mask_by_bisection_avx2, mask_threshold_avx2_scratch};
    const Mask even{mask_by_even_steps_avx2, mask_threshold_avx2_scratch};
    list.push_back(
        saving(rows, "threshold compared once a window offset, not by each pair", "mask_threshold_avx2", by_pair, avx2));
    list.push_back(
        saving(rows, "T found by eight thresholds a pass, not by bisection", "mask_threshold_avx2", bisection, even));
    list.push_back(saving(rows, "steps of 8 and 1 while any T is open, not 32, 4 and 1", "mask_threshold_avx2", even, avx2));
  }
#endif
  const Match each_view{match_each_view, match_each_view_scratch};
  const Match all_bits{match_all_bits, match_all_bits_scratch};
  const Match match{match_hamming_scalar, match_hamming_scalar_scratch};
  list.push_back(saving(rows, "XOR of a candidate shared by both views", "match_hamming_scalar", each_view, all_bits));
  list.push_back(saving(rows, "counting ends once neither view can win", "match_hamming_scalar", all_bits, match));
  list.push_back(saving<AggregateAlongArgs>(rows, "least of the predecessor's levels found once a pixel",
                                            "aggregate_along_scalar",
                                            {aggregate_least_by_level, aggregate_least_by_level_scratch},
                                            {aggregate_along_scalar, aggregate_along_scalar_scratch}));
  list.push_back(saving<MedianWeightedArgs>(rows, "median sought only where the own level is none", "median_weighted_scalar",
                                            {median_by_sorting, median_by_sorting_scratch},
                                            {median_weighted_scalar, median_weighted_scalar_scratch}));
  return list;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

// Processor time, which other programs of a busy machine take no part in.
double nanoseconds_of(const std::function<void()>& run) {
  const std::clock_t begin = std::clock();
  run();
  return 1e9 / CLOCKS_PER_SEC * static_cast<double>(std::clock() - begin);
}

void measure(int32_t repeat, Saving* saving) {
  for (int32_t round = 0; round < repeat; ++round) {
    saving->plain_ns.push_back(nanoseconds_of(saving->plain));
    saving->saved_ns.push_back(nanoseconds_of(saving->saved));
    saving->times.push_back(saving->plain_ns.back() / saving->saved_ns.back());
  }
}

}  // namespace

bool run_savings_bench(const SavingsBench& bench, std::string* error) {
  PairRows rows;
  if (!rows.open(bench.left, bench.right, bench.bits, bench.disparities, error)) return false;
  Table table;
  table.columns = {"saving", "kernel", "plain ns/px", "ns/px", "x", "x 25 %", "x 75 %"};
  const double pixels = static_cast<double>(rows.sampled().size()) * rows.width();
  for (Saving& saving : all_savings(rows)) {
    saving.plain();
    saving.saved();
    if (!saving.same()) {
      *error = "'" + saving.name + "' changes what " + saving.kernel + " writes";
      return false;
    }
    measure(bench.repeat, &saving);
    table.add({saving.name, saving.kernel, fixed(median(saving.plain_ns) / pixels), fixed(median(saving.saved_ns) / pixels),
               fixed(median(saving.times)), fixed(quantile(saving.times, 0.25)), fixed(quantile(saving.times, 0.75))});
  }
  if (bench.csv) {
    std::fputs(to_csv(table).c_str(), stdout);
    return true;
  }
  std::printf(
      "%zu rows of %d pixels, %s, %d bits, disparities 0..%d; both forms wrote the same bytes. Processor time, medians of\n"
      "%d rounds, the two forms in turn; x: the plain form's time as a multiple, median and quartiles of the rounds' "
      "ratios.\n\n",
      rows.sampled().size(), static_cast<int>(rows.width()), rows.gray() ? "gray" : "colour", static_cast<int>(rows.bits()),
      static_cast<int>(rows.disparities() - 1), static_cast<int>(bench.repeat));
  std::fputs(to_text(table).c_str(), stdout);
  return true;
}

}  // namespace bsm::bench
