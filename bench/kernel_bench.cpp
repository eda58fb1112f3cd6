// Measures kernels: the kernels of a stage take turns, so that a change of the machine's clock meets all of them alike.
#include "bench/kernel_bench.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>

#include "bench/kernel_bounds.h"
#include "bench/kernel_inputs.h"
#include "bench/statistics.h"
#include "bench/table.h"
#include "host/text.h"
#include "platform/compiler.h"
#include "simd/kernels.h"

#if BSM_ARCH_X86 && defined(_MSC_VER)
#include <intrin.h>
#elif BSM_ARCH_X86
#include <x86intrin.h>
#endif

namespace bsm::bench {
namespace {

using host::text;

constexpr double kSampleNanoseconds = 2e5;  // a sample calls its kernel until this is over
constexpr double kNoisy = 2.0;              // largest sample over smallest above which a row is marked

// The x86 time stamp counter: it runs at one rate, whatever the core's clock.
#if BSM_ARCH_X86
constexpr bool kHasReference = true;
uint64_t reference_cycles() {
  return __rdtsc();
}
#else
constexpr bool kHasReference = false;
uint64_t reference_cycles() {
  return 0;
}
#endif

// A chain of operations, each waiting for the one before and taking one cycle on every core: its time is the core's clock.
#if defined(__GNUC__) && defined(__OPTIMIZE__)
constexpr bool kHasCoreClock = true;
constexpr int32_t kChainRounds = 4000;
constexpr int32_t kChainLength = 16;
void run_chain() {
  uintptr_t value = 1;
  uintptr_t other = 2;
  __asm__ volatile("" : "+r"(other));
  for (int32_t i = 0; i < kChainRounds; ++i) {
    BSM_UNROLL
    for (int32_t k = 0; k < kChainLength; ++k) {
      value ^= other;
      __asm__ volatile("" : "+r"(value));
    }
  }
}
#else
constexpr bool kHasCoreClock = false;
constexpr int32_t kChainRounds = 1;
constexpr int32_t kChainLength = 1;
void run_chain() {}
#endif

// What a stage's work is counted in.
enum class Unit { kPixel, kPixelDisparity };

// Work of one call.
struct Work {
  Unit unit;
  double units;
  double bits;  // that a full evaluation makes or counts; 0: none
};

// Candidates of a row: pixel x meets x, x - 1 .. within the row.
double candidates(const KernelBench& bench) {
  const double shown = std::min(bench.width, bench.disparities);
  return bench.width * shown - shown * (shown - 1) / 2;
}

// Bits: a descriptor or mask has n; a candidate counts n bits under its view's mask, match_hamming those of both views.
template <class Args>
Work work_of(const KernelBench& bench, const Args*) {
  return {Unit::kPixel, 1.0 * bench.width, 0.0};
}
Work work_of(const KernelBench& bench, const DescriptorCompareArgs*) {
  return {Unit::kPixel, 1.0 * bench.width, 1.0 * bench.width * bench.bits};
}
Work work_of(const KernelBench& bench, const MaskThresholdArgs*) {
  return {Unit::kPixel, 1.0 * bench.width, 1.0 * bench.width * bench.bits};
}
Work work_of(const KernelBench& bench, const MatchHammingArgs*) {
  return {Unit::kPixelDisparity, candidates(bench), 2.0 * candidates(bench) * bench.bits};
}
Work work_of(const KernelBench& bench, const CostHammingArgs*) {
  return {Unit::kPixelDisparity, candidates(bench), candidates(bench) * bench.bits};
}
Work volume_work(const KernelBench& bench) {
  return {Unit::kPixelDisparity, 1.0 * bench.width * bench.disparities, 0.0};
}
Work work_of(const KernelBench& bench, const AggregateAlongArgs*) {
  return volume_work(bench);
}
Work work_of(const KernelBench& bench, const AggregateAcrossArgs*) {
  return volume_work(bench);
}
Work work_of(const KernelBench& bench, const WinnerSumsArgs*) {
  return volume_work(bench);
}

// One kernel and its samples.
struct Entry {
  std::string name, isa;
  Work work{};
  double bound = 0.0;  // cycles of a call; 0: none is known
  std::function<void()> run;
  std::shared_ptr<Inputs> inputs;
  int64_t calls = 1;                         // of a sample
  std::vector<double> nanoseconds, counted;  // of a call, for each sample
  double spread() const {
    const auto range = std::minmax_element(nanoseconds.begin(), nanoseconds.end());
    return *range.second / *range.first;
  }
};

// A stage's kernels in the order of the list, scalar first, and what gives them arguments; made when their turn comes, so
// that the buffers of one stage exist at a time.
struct Listed {
  std::string stage, name, isa;
  std::function<Entry(const KernelBench&)> make;
};

template <class Args>
Listed list_kernel(const char* stage, const char* isa, int32_t block, void (*kernel)(const Args&),
                   kernel_scratch_fn* scratch) {
  const std::string name = std::string(stage) + "_" + isa;
  return {stage, name, isa, [=](const KernelBench& bench) {
            Entry entry;
            entry.inputs = std::make_shared<Inputs>(bench.width, bench.bits, bench.disparities, block);
            const auto args = std::make_shared<Args>();
            prepare(*entry.inputs, scratch, args.get());
            entry.name = name;
            entry.isa = isa;
            entry.work = work_of(bench, args.get());
            if (const Core* core = core_of(isa)) entry.bound = bound_cycles(*core, *args);
            entry.run = [kernel, args] { kernel(*args); };
            return entry;
          }};
}

// Kernels that this machine can run.
std::vector<Listed> runnable_kernels() {
  const uint32_t features = cpu_features();
  std::vector<Listed> kernels;
#define BSM_KERNEL(stage, operation, isa, required, block)                                           \
  if (((required) & ~features) == 0) {                                                               \
    kernels.push_back(list_kernel(#stage "_" #operation, #isa, (block), stage##_##operation##_##isa, \
                                  stage##_##operation##_##isa##_scratch));                           \
  }
#include "simd/kernels.def"
#undef BSM_KERNEL
  return kernels;
}

bool wanted(const KernelBench& bench, const Listed& kernel) {
  return (bench.isa == "all" || bench.isa == kernel.isa) && kernel.name.find(bench.filter) != std::string::npos;
}

struct Sample {
  double nanoseconds, counted;
};

template <class Run>
Sample time_calls(int64_t calls, const Run& run) {
  const auto begin = std::chrono::steady_clock::now();
  const uint64_t first = reference_cycles();
  for (int64_t i = 0; i < calls; ++i) run();
  const uint64_t last = reference_cycles();
  const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - begin;
  const double count = static_cast<double>(calls);
  return {elapsed.count() / count, static_cast<double>(last - first) / count};
}

// Samples of the stage's kernels in turn; one untimed call before each brings its data back into the caches. *clock gets the
// nanoseconds of a core cycle in each round.
void sample_stage(int32_t repeat, std::vector<Entry>* entries, std::vector<double>* clock) {
  for (Entry& entry : *entries) {
    entry.run();
    double once = time_calls(1, entry.run).nanoseconds;
    for (int32_t i = 0; i < 4; ++i) once = std::min(once, time_calls(1, entry.run).nanoseconds);
    entry.calls = std::max<int64_t>(1, static_cast<int64_t>(kSampleNanoseconds / std::max(1.0, once)));
  }
  for (int32_t i = 0; i < repeat; ++i) {
    clock->push_back(time_calls(1, run_chain).nanoseconds / (1.0 * kChainRounds * kChainLength));
    for (Entry& entry : *entries) {
      entry.run();
      const Sample sample = time_calls(entry.calls, entry.run);
      entry.nanoseconds.push_back(sample.nanoseconds);
      entry.counted.push_back(sample.counted);
    }
  }
}

std::string digits(double value) {
  return fixed(value, value < 1.0 ? 4 : value < 100.0 ? 2 : 0);
}

// `scalar` are the nanoseconds of the stage's scalar kernel, `cycle` those of a core cycle.
std::vector<std::string> cells_of(const Entry& entry, double scalar, double cycle) {
  const double nanoseconds = median(entry.nanoseconds);
  const double cycles = nanoseconds / cycle;
  const double rate = entry.work.bits / cycles;
  std::vector<std::string> cells = {entry.name, entry.work.unit == Unit::kPixel ? "px" : "px*disp"};
  cells.push_back(digits(nanoseconds / entry.work.units));
  cells.push_back(kHasReference ? digits(median(entry.counted) / entry.work.units) : "");
  cells.push_back(kHasCoreClock ? digits(cycles / entry.work.units) : "");
  cells.push_back(kHasCoreClock && entry.work.bits > 0 ? fixed(rate, rate < 10 ? 2 : 1) : "");
  cells.push_back(fixed(scalar / nanoseconds, 2));
  cells.push_back(kHasCoreClock && entry.bound > 0 ? digits(entry.bound / entry.work.units) : "");
  cells.push_back(kHasCoreClock && entry.bound > 0 ? fixed(100 * entry.bound / cycles, 0) : "");
  cells.push_back(fixed(entry.spread(), 2));
  return cells;
}

void print_text(const KernelBench& bench, const Table& table, double cycle, size_t noisy) {
  std::printf(
      "Kernels on rows of %d pixels, %d bits, %d disparities; medians of %d samples, the kernels of a stage in turn.\n",
      static_cast<int>(bench.width), static_cast<int>(bench.bits), static_cast<int>(bench.disparities),
      static_cast<int>(bench.repeat));
  if (kHasCoreClock) std::printf("Core clock from a chain of dependent operations: %.2f GHz.\n", 1 / cycle);
  std::printf(
      "ns, ref (cycles of the x86 time stamp counter) and cycles (of the core) are per pixel, or per pixel and disparity:\n"
      "candidates for match and cost, all levels for aggregate and winner. bits/cycle: bits made, or counted under masks\n"
      "(match: of both views), in a core cycle, as if nothing were skipped; x scalar: times as fast as scalar; bound: "
      "cycles\n"
      "at least on the core that kernel_bounds.cpp names (x86: Ice Lake to Sapphire Rapids), by its count of operations; a "
      "wider\n"
      "core may pass 100 %%; max/min: of the samples.\n\n");
  std::fputs(to_text(table).c_str(), stdout);
  if (noisy > 0) {
    std::printf("\nNote: %zu of %zu kernels have samples more than %.0f times apart; the machine is busy.\n", noisy,
                table.rows.size(), kNoisy);
  }
}

}  // namespace

std::vector<std::string> kernel_isas() {
  std::vector<std::string> names;
  for (const Listed& kernel : runnable_kernels()) {
    if (std::find(names.begin(), names.end(), kernel.isa) == names.end()) names.push_back(kernel.isa);
  }
  return names;
}

bool check_kernel_bench(const KernelBench& bench, std::string* error) {
  const std::vector<std::string> isas = kernel_isas();
  if (bench.isa != "all" && std::find(isas.begin(), isas.end(), bench.isa) == isas.end()) {
    *error = "--isa '" + bench.isa + "': not available here; there are all";
    for (const std::string& name : isas) *error += " " + name;
    return false;
  }
  const std::vector<Listed> kernels = runnable_kernels();
  if (std::any_of(kernels.begin(), kernels.end(), [&](const Listed& kernel) { return wanted(bench, kernel); })) return true;
  *error = "--filter '" + bench.filter + "': no kernel" + (bench.isa == "all" ? "" : " of " + bench.isa) +
           " has this in its name, such as " + kernels.front().name;
  return false;
}

void run_kernel_bench(const KernelBench& bench) {
  const std::vector<Listed> kernels = runnable_kernels();
  Table table;
  table.columns = {"kernel", "per", "ns", "ref", "cycles", "bits/cycle", "x scalar", "bound", "% bound", "max/min"};
  std::vector<double> clock;
  size_t noisy = 0;
  for (const Listed& first : kernels) {
    if (first.isa != "scalar") continue;
    std::vector<Entry> entries = {first.make(bench)};
    const bool show_scalar = wanted(bench, first);
    for (const Listed& kernel : kernels) {
      if (kernel.stage == first.stage && kernel.isa != "scalar" && wanted(bench, kernel))
        entries.push_back(kernel.make(bench));
    }
    if (entries.size() == 1 && !show_scalar) continue;
    std::vector<double> stage_clock;
    sample_stage(bench.repeat, &entries, &stage_clock);
    clock.push_back(median(stage_clock));
    const double scalar = median(entries.front().nanoseconds);
    for (size_t i = show_scalar ? 0 : 1; i < entries.size(); ++i) {
      table.add(cells_of(entries[i], scalar, clock.back()));
      noisy += entries[i].spread() > kNoisy ? 1 : 0;
    }
  }
  if (bench.csv) {
    std::fputs(to_csv(table).c_str(), stdout);
  } else {
    print_text(bench, table, median(clock), noisy);
  }
}

}  // namespace bsm::bench
