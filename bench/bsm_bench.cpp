// bsm_bench: the speed of single kernels and of whole frames on this machine.
#include <cstdio>
#include <new>
#include <string>

#include "bench/command_line.h"
#include "bench/frame_bench.h"
#include "bench/kernel_bench.h"
#include "bench/savings_bench.h"
#include "bench/worst_bench.h"
#include "bsm/bsm.h"
#include "host/config_options.h"
#include "host/options.h"

namespace bsm::bench {
namespace {

constexpr char kProgram[] = "bsm_bench";
constexpr char kKernels[] = "bsm_bench kernels";
constexpr char kFrame[] = "bsm_bench frame";
constexpr char kWorst[] = "bsm_bench worst";
constexpr char kSavings[] = "bsm_bench savings";
constexpr char kHelp[] =
    "usage: bsm_bench COMMAND [options]\n\n"
    "commands:\n"
    "  kernels [options]           time of each kernel that this machine can run\n"
    "  frame LEFT RIGHT [options]  time of a whole frame and of its stages\n"
    "  worst LEFT RIGHT [options]  time of frames that have nothing to match, beside a pair's\n"
    "  savings LEFT RIGHT [options]  each saving of the kernels against the same computation without it\n\n"
    "'bsm_bench COMMAND --help' lists the options.\n";

int usage_error(const char* program, const std::string& message) {
  complain(program, message + " ('" + program + " --help' says more)");
  return kExitUsage;
}

int kernels_command(int argc, char** argv) {
  KernelBench bench;
  host::Options options(
      kKernels, "bsm_bench kernels [options]",
      "Times every kernel that this machine can run on one row of a made-up scene: nanoseconds and cycles\n"
      "per pixel or per pixel and disparity, bits per cycle, the ratio to the scalar kernel measured beside\n"
      "it, and the share of a bound: the operations that the stage needs at the throughput of a known core.");
  options.word("--isa", "NAME", &bench.isa, "kernels of this instruction set alone: all, scalar, or as kernels are named");
  options.word("--filter", "TEXT", &bench.filter, "kernels whose name holds TEXT");
  options.integer("--width", "W", &bench.width, 1, BSM_MAX_SIZE, "pixels of the row");
  options.integer("--bits", "N", &bench.bits, BSM_MIN_BITS, BSM_MAX_BITS, "descriptor length, a multiple of 64");
  options.integer("--disparities", "D", &bench.disparities, 1, BSM_MAX_DISPARITY - BSM_MIN_DISPARITY + 1,
                  "how many disparities are searched, from 0 up");
  options.integer("--repeat", "R", &bench.repeat, 1, 1000000, "samples of each kernel; the median is reported");
  options.flag("--csv", &bench.csv, "comma-separated values");
  int exit_code = kExitOk;
  if (!parse_command_line(argc, argv, &options, &exit_code)) return exit_code;
  std::string error;
  if (bench.bits % BSM_MIN_BITS != 0) {
    return usage_error(kKernels, "--bits '" + std::to_string(bench.bits) + "': not a multiple of 64");
  }
  if (!check_kernel_bench(bench, &error)) return usage_error(kKernels, error);
  run_kernel_bench(bench);
  return kExitOk;
}

int frame_command(int argc, char** argv) {
  FrameBench bench;
  host::Options options(
      kFrame, "bsm_bench frame LEFT RIGHT [options]",
      "Times the matching of a rectified pair, two PPM or PGM images of one size: the whole frame, million\n"
      "disparity evaluations a second (pixels x disparities / time), and each stage as the difference of\n"
      "whole runs that end there. With several threads every run takes turns with one of one thread.");
  options.positional("LEFT", &bench.left);
  options.positional("RIGHT", &bench.right);
  bench.config.add_search(&options);
  options.flag("--lengths", &bench.lengths, "the frame at 256, 512 .. 4096 bits (sgm: 1024) instead of its stages");
  options.integer("--repeat", "R", &bench.repeat, 1, 1000000, "runs of each stage; the median is reported");
  options.flag("--csv", &bench.csv, "comma-separated values");
  int exit_code = kExitOk;
  if (!parse_command_line(argc, argv, &options, &exit_code)) return exit_code;
  std::string error;
  if (!bench.config.finish(&error)) return usage_error(kFrame, error);
  size_t bytes = 0;
  const bsm_status status = bsm_memory_required(&bench.config.config, &bytes);
  if (status < 0) return usage_error(kFrame, host::config_error(status));
  if (run_frame_bench(&bench, &error)) return kExitOk;
  complain(kFrame, error);
  return kExitData;
}

int worst_command(int argc, char** argv) {
  WorstBench bench;
  host::Options options(
      kWorst, "bsm_bench worst LEFT RIGHT [options]",
      "Times the matching of views that have nothing to match, or the same everywhere, beside a given pair of PPM or\n"
      "PGM images: flat, striped, noise, unrelated, covered lenses; with the presets fast and balanced and the local\n"
      "method with 256 and 4096 bits.");
  options.positional("LEFT", &bench.left);
  options.positional("RIGHT", &bench.right);
  options.integer("--disparities", "N", &bench.disparities, 1, BSM_MAX_DISPARITY + 1,
                  "how many disparities are searched, from 0 up");
  options.word("--isa", "NAME", &bench.isa, "instructions allowed: auto, scalar or a name from 'bsm info'");
  options.integer("--repeat", "R", &bench.repeat, 1, 1000000, "runs of each pair of views; the median is reported");
  options.flag("--csv", &bench.csv, "comma-separated values");
  int exit_code = kExitOk;
  if (!parse_command_line(argc, argv, &options, &exit_code)) return exit_code;
  std::string error;
  if (!host::isa_mask_of(bench.isa, &bench.isa_mask, &error)) return usage_error(kWorst, error);
  if (run_worst_bench(bench, &error)) return kExitOk;
  complain(kWorst, error);
  return kExitData;
}

int savings_command(int argc, char** argv) {
  SavingsBench bench;
  host::Options options(
      kSavings, "bsm_bench savings LEFT RIGHT [options]",
      "Times each saving of the kernels and stages against the same computation without it, on rows of a pair of PPM or\n"
      "PGM images, and checks that both write the same bytes.");
  options.positional("LEFT", &bench.left);
  options.positional("RIGHT", &bench.right);
  bench.config.add_search(&options);
  options.integer("--repeat", "R", &bench.repeat, 1, 1000000, "rounds; the median is reported");
  options.word("--filter", "TEXT", &bench.filter, "savings whose name or place, as --list has them, holds TEXT");
  options.flag("--list", &bench.list, "name the savings that --count knows, and measure nothing");
  options.word("--count", "FORM", &bench.count, "run one form R times and take no times, for an emulator: plain or saved");
  options.flag("--csv", &bench.csv, "comma-separated values");
  int exit_code = kExitOk;
  if (!parse_command_line(argc, argv, &options, &exit_code)) return exit_code;
  std::string error;
  if (!bench.count.empty() && bench.count != "plain" && bench.count != "saved") {
    return usage_error(kSavings, "--count '" + bench.count + "': neither plain nor saved");
  }
  if (!bench.config.finish(&error)) return usage_error(kSavings, error);
  size_t bytes = 0;
  const bsm_status status = bsm_memory_required(&bench.config.config, &bytes);
  if (status < 0) return usage_error(kSavings, host::config_error(status));
  if (run_savings_bench(&bench, &error)) return kExitOk;
  complain(kSavings, error);
  return kExitData;
}

int main_program(int argc, char** argv) {
  const std::string command = argc > 1 ? argv[1] : "";
  if (command == "kernels") return kernels_command(argc - 1, argv + 1);
  if (command == "frame") return frame_command(argc - 1, argv + 1);
  if (command == "worst") return worst_command(argc - 1, argv + 1);
  if (command == "savings") return savings_command(argc - 1, argv + 1);
  if (command == "--help" || command == "-h") {
    std::fputs(kHelp, stdout);
    return kExitOk;
  }
  return usage_error(kProgram, command.empty() ? "a command is missing: kernels, frame, worst or savings"
                                               : "'" + command + "': no such command");
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
