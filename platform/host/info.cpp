// bsm info: what this machine runs, and what a size takes in memory.
#include <cstdio>
#include <string>
#include <vector>

#include "bsm/bsm.h"
#include "host/arena.h"
#include "host/commands.h"
#include "host/config_options.h"
#include "host/options.h"
#include "host/run_match.h"
#include "host/text.h"

namespace bsm::host {
namespace {

constexpr char kUsage[] = "info [--width W --height H] [options]";
constexpr char kSummary[] =
    "Prints the version, the CPU features, the kernels chosen and the memory needed: for one size, or without --width and\n"
    "--height for common ones.";

struct Size {
  int32_t width, height;
};
constexpr Size kCommonSizes[] = {{160, 120}, {320, 240}, {450, 375}, {640, 480}, {1280, 720}};
constexpr bsm_preset kPresets[] = {BSM_PRESET_FAST, BSM_PRESET_BALANCED, BSM_PRESET_LOCAL, BSM_PRESET_PAPER,
                                   BSM_PRESET_BEST};

// The kernels of a context for one small image; they do not depend on its size.
bsm_status print_kernels(bsm_config config) {
  size_t bytes = 0;
  bsm_status status = bsm_memory_required(&config, &bytes);
  Arena arena;
  bsm_context* context = nullptr;
  if (status >= 0 && !arena.allocate(bytes)) status = BSM_ERROR_ARENA;
  if (status >= 0) status = bsm_open(&config, arena.data(), arena.size(), &context);
  if (status < 0) return status;
  std::printf("kernels:\n");
  for (const std::string& name : kernel_names(context)) std::printf("  %s\n", name.c_str());
  return BSM_OK;
}

double kilobytes(size_t bytes) {
  return static_cast<double>(bytes) / 1024.0;
}

bsm_status print_size(const bsm_config& config) {
  size_t here = 0, scalar = 0;
  int32_t delay = 0;
  bsm_status status = bsm_memory_required(&config, &here);
  if (status >= 0) status = bsm_memory_required_for(&config, 0, &scalar);
  if (status < 0) return status;
  const bool rows = bsm_row_delay(&config, &delay) >= 0;
  std::printf("%d x %d, %d disparities from %d, %d bits, %s, %s map, %s, %d job%s, %s:\n", static_cast<int>(config.width),
              static_cast<int>(config.height), static_cast<int>(config.num_disparities),
              static_cast<int>(config.min_disparity), static_cast<int>(config.bits), method_name(config.method),
              stage_name(config.stage), format_name(config.format), static_cast<int>(config.max_jobs),
              config.max_jobs == 1 ? "" : "s", config.right_map != 0 ? "with right map" : "no right map");
  std::printf("  arena, this machine's kernels  %zu bytes (%.1f KB)\n", here, kilobytes(here));
  std::printf("  arena, scalar kernels          %zu bytes (%.1f KB)\n", scalar, kilobytes(scalar));
  std::printf("  row delay                      %s\n",
              rows ? text("%d rows", static_cast<int>(delay)).c_str() : "no row mode: 8 paths need the whole frame");
  return BSM_OK;
}

bsm_status print_common_sizes(bsm_config config) {
  std::printf("arena in KB, this machine's kernels / scalar kernels: %d disparities, %s map, %s, %d job%s, %s\n",
              static_cast<int>(config.num_disparities), stage_name(config.stage), format_name(config.format),
              static_cast<int>(config.max_jobs), config.max_jobs == 1 ? "" : "s",
              config.right_map != 0 ? "with right map" : "no right map");
  std::printf("  %-12s", "size");
  for (const bsm_preset preset : kPresets) std::printf("%18s", preset_name(preset));
  std::printf("\n");
  for (const Size& size : kCommonSizes) {
    std::printf("  %-12s", text("%d x %d", static_cast<int>(size.width), static_cast<int>(size.height)).c_str());
    for (const bsm_preset preset : kPresets) {
      config.width = size.width;
      config.height = size.height;
      bsm_config_preset(&config, preset);
      size_t here = 0, scalar = 0;
      bsm_status status = bsm_memory_required(&config, &here);
      if (status >= 0) status = bsm_memory_required_for(&config, 0, &scalar);
      // A dash: this library was built without what the preset needs.
      std::printf("%18s", status < 0 ? "-" : text("%.0f / %.0f", kilobytes(here), kilobytes(scalar)).c_str());
    }
    std::printf("\n");
  }
  return BSM_OK;
}

}  // namespace

int info_command(const std::vector<std::string>& argument_list) {
  ConfigOptions config_options;
  bsm_config& config = config_options.config;
  bool right_map = false;
  int32_t width = 0, height = 0;
  Options options("info", kUsage, kSummary);
  options.integer("--width", "W", &width, 1, BSM_MAX_SIZE, "image width in pixels");
  options.integer("--height", "H", &height, 1, BSM_MAX_SIZE, "image height in pixels");
  options.choice("--format", &config.format, format_choices(),
                 "pixel format of the library; files are gray8 (.pgm) or rgb24 (.ppm)");
  options.flag("--right-map", &right_map, "with the right view's map");
  config_options.add_search(&options);
  config_options.add_stage(&options);
  switch (options.parse(argument_list)) {
    case Options::Result::kHelp:
      std::fputs(options.help().c_str(), stdout);
      return kExitOk;
    case Options::Result::kError:
      print_error(options.error());
      return kExitUsage;
    case Options::Result::kRun:
      break;
  }
  std::string error;
  if (options.given("--width") != options.given("--height"))
    error = "--width and --height go together; give both or neither";
  if (!error.empty() || !config_options.finish(&error)) {
    print_error("info: " + error);
    return kExitUsage;
  }
  config.right_map = right_map ? 1 : 0;
  if (options.given("--width")) {
    config.width = width;
    config.height = height;
  }
  size_t bytes = 0;
  bsm_status status = bsm_memory_required(&config, &bytes);
  if (status >= 0) {
    std::printf("bsm %s\nCPU features: %s\n", bsm_version(), feature_names(bsm_cpu_features()).c_str());
    status = print_kernels(config);
  }
  if (status >= 0) status = options.given("--width") ? print_size(config) : print_common_sizes(config);
  if (status < 0) {
    print_error("info: " + config_error(status));
    return kExitUsage;
  }
  return kExitOk;
}

}  // namespace bsm::host
