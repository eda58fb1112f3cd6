// bsm match: two images in, a disparity map out.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "bsm/bsm.h"
#include "host/commands.h"
#include "host/config_options.h"
#include "host/file_output.h"
#include "host/image.h"
#include "host/json.h"
#include "host/map_write.h"
#include "host/options.h"
#include "host/png_write.h"
#include "host/pnm_read.h"
#include "host/run_match.h"
#include "host/text.h"

namespace bsm::host {
namespace {

constexpr char kUsage[] = "match LEFT RIGHT -o OUT [options]";
constexpr char kSummary[] =
    "Computes the disparity map of a rectified pair. LEFT and RIGHT are PPM or PGM images of one size; - reads standard\n"
    "input, '- -' two images one after the other. OUT says by its name what is written:\n"
    "  .pfm  disparities in pixels, +inf = invalid\n"
    "  .pgm  with --scale 8 bits, 0 = invalid; without, 16 bits in 1/16 pixel, 65535 = invalid\n"
    "  .png  gray, or with --color in colours; 0 or black = invalid; without --scale the searched range fills 1..255\n"
    "  -     a PGM to standard output; pfm:- and png:- are the other two";

struct MatchArguments {
  std::string left, right, output, right_output, confidence_output;
  ConfigOptions config;
  MapStyle style;
  bool stream = false;
  bool json = false;
  int32_t repeat = 1;
  MapOutput map, right_map, confidence_map;
};

bool usage_error(const std::string& message) {
  print_error("match: " + message);
  return false;
}

// What can be refused before any file is read.
bool check_arguments(const Options& options, MatchArguments* arguments) {
  std::string error;
  if (arguments->output.empty()) return usage_error("-o OUT is missing: where the map goes, such as -o depth.png");
  if (!arguments->config.finish(&error)) return usage_error(error);
  const int32_t min_disparity = arguments->config.config.min_disparity;
  if (!parse_map_output(arguments->output, &arguments->map, &error) ||
      !check_map_style(arguments->map, arguments->style, min_disparity, &error)) {
    return usage_error("-o " + arguments->output + ": " + error);
  }
  const bool with_right = !arguments->right_output.empty();
  if (with_right && (!parse_map_output(arguments->right_output, &arguments->right_map, &error) ||
                     !check_map_style(arguments->right_map, arguments->style, min_disparity, &error))) {
    return usage_error("--right-out " + arguments->right_output + ": " + error);
  }
  const bool with_confidence = !arguments->confidence_output.empty();
  if (with_confidence && (!parse_map_output(arguments->confidence_output, &arguments->confidence_map, &error) ||
                          arguments->confidence_map.format == MapFormat::kPfm)) {
    return usage_error("--confidence-out " + arguments->confidence_output +
                       ": the confidence is an 8-bit image; name a .png or .pgm");
  }
  if (arguments->stream && options.given("--threads") && arguments->config.config.max_jobs > 1) {
    return usage_error("--stream works in one thread; leave out --threads");
  }
  // Every output has a file of its own, which is no input.
  struct Target {
    const char* option;
    std::string path;
  };
  std::vector<Target> targets = {{"-o", arguments->map.path}};
  if (with_right) targets.push_back({"--right-out", arguments->right_map.path});
  if (with_confidence) targets.push_back({"--confidence-out", arguments->confidence_map.path});
  int to_stdout = arguments->json ? 1 : 0;
  for (size_t i = 0; i < targets.size(); ++i) {
    to_stdout += targets[i].path == "-" ? 1 : 0;
    for (const std::string& input : {arguments->left, arguments->right}) {
      if (same_file(input, targets[i].path)) {
        return usage_error(std::string(targets[i].option) + " " + targets[i].path + " would overwrite an input");
      }
    }
    for (size_t k = 0; k < i; ++k) {
      if (targets[i].path == "-" || !same_file(targets[k].path, targets[i].path)) continue;
      return usage_error(std::string(targets[k].option) + " and " + targets[i].option + " name the same file");
    }
  }
  if (to_stdout > 1) return usage_error("more than one output, or --json, goes to standard output; keep one of them");
  return true;
}

bool read_view(const std::string& path, const char* side, Image8* image, std::string* error) {
  SampleImage samples;
  if (!read_pnm_file(path, &samples, error)) {
    if (path == "-") *error += std::string(" (the ") + side + " view)";
    return false;
  }
  *image = to_image8(samples);
  return true;
}

// Both views; what is wrong with either is said, unless the right one's place on a pipe depends on the left one.
bool read_views(const std::string& left_path, const std::string& right_path, Image8* left, Image8* right,
                std::string* error) {
  const bool left_read = read_view(left_path, "left", left, error);
  if (!left_read && right_path == "-") return false;
  std::string right_error;
  const bool right_read = read_view(right_path, "right", right, &right_error);
  if (!left_read && !right_read) print_error("match: " + *error);
  if (!right_read) *error = right_error;
  return left_read && right_read;
}

// All files are complete beside their targets before any takes its name.
bool write_maps(const MatchArguments& arguments, const MatchResult& result, std::string* error) {
  const bsm_config& config = result.config;
  const int16_t invalid = bsm_invalid_disparity(&config);
  FileOutput files[3];
  const int maps = result.right_disparity.empty() ? 1 : 2;
  const int count = maps + (result.confidence.empty() ? 0 : 1);
  for (int i = 0; i < maps; ++i) {
    const MapOutput& output = i == 0 ? arguments.map : arguments.right_map;
    const MapView view{i == 0 ? result.disparity.data() : result.right_disparity.data(),
                       config.width,
                       config.height,
                       invalid,
                       config.min_disparity,
                       config.num_disparities};
    std::vector<uint8_t> bytes;
    if (!encode_map(view, output.format, arguments.style, &bytes, error)) {
      *error = output.path + ": " + *error;
      return false;
    }
    if (!files[i].open(output.path, error) || !files[i].write(bytes.data(), bytes.size(), error)) return false;
  }
  if (!result.confidence.empty()) {
    const Image8 image{config.width, config.height, 1, result.confidence};
    const MapOutput& output = arguments.confidence_map;
    const std::vector<uint8_t> bytes = output.format == MapFormat::kPng ? encode_png(image) : encode_pnm(image);
    FileOutput& file = files[maps];
    if (!file.open(output.path, error) || !file.write(bytes.data(), bytes.size(), error)) return false;
  }
  for (int i = 0; i < count; ++i) {
    if (!files[i].commit(error)) return false;
  }
  return true;
}

void print_json(const MatchArguments& arguments, const MatchResult& result) {
  const bsm_config& config = result.config;
  JsonObject kernels;
  for (const std::string& name : result.kernels) {
    kernels.add(name.substr(0, name.rfind('_')).c_str(), name);  // stage_operation: stage_operation_isa
  }
  JsonObject json;
  json.add("version", bsm_version())
      .add("left", arguments.left)
      .add("right", arguments.right)
      .add("output", arguments.output)
      .add("width", int64_t{config.width})
      .add("height", int64_t{config.height})
      .add("format", format_name(config.format))
      .add("min_disparity", int64_t{config.min_disparity})
      .add("num_disparities", int64_t{config.num_disparities})
      .add("bits", int64_t{config.bits})
      .add("sigma", int64_t{config.sigma})
      .add("method", method_name(config.method))
      .add("stage", stage_name(config.stage))
      .add("preset", arguments.config.preset())
      .add("paths", int64_t{config.paths})
      .add("p1", int64_t{config.p1})
      .add("p2", int64_t{config.p2})
      .add("edge_threshold", int64_t{config.edge_threshold})
      .add("edge_divisor", int64_t{config.edge_divisor})
      .add("right_costs", config.right_costs == BSM_RIGHT_COSTS_OWN ? "own" : "left")
      .add("subpixel", int64_t{config.subpixel})
      .add("lr_tolerance", int64_t{config.lr_tolerance})
      .add("speckle", int64_t{config.speckle})
      .add("border", int64_t{config.border})
      .add("vote_radius", int64_t{config.vote_radius})
      .add("vote_step", int64_t{config.vote_step})
      .add("vote_color", int64_t{config.vote_color})
      .add("vote_distance", int64_t{config.vote_distance})
      .add("vote_cap", int64_t{config.vote_cap})
      .add("smooth_radius", int64_t{config.smooth_radius})
      .add("smooth_passes", int64_t{config.smooth_passes})
      .add("smooth_color", int64_t{config.smooth_color})
      .add("smooth_distance", int64_t{config.smooth_distance})
      .add("median", int64_t{config.median})
      .add("right_map", int64_t{config.right_map})
      .add("isa", arguments.config.isa)
      .add("threads", int64_t{config.max_jobs})
      .add("stream", arguments.stream)
      .add_json("kernels", kernels.str())
      .add("arena_bytes", static_cast<int64_t>(result.arena_bytes))
      .add("repeat", int64_t{arguments.repeat})
      .add("ms_min", result.fastest())
      .add("ms_median", result.median());
  std::printf("%s\n", json.str().c_str());
}

void print_summary(std::FILE* stream, const MatchArguments& arguments, const MatchResult& result) {
  const bsm_config& config = result.config;
  std::fprintf(stream, "%s: %d x %d, disparities %d..%d, %d bits, %s, %s map\n", arguments.output.c_str(),
               static_cast<int>(config.width), static_cast<int>(config.height), static_cast<int>(config.min_disparity),
               static_cast<int>(config.min_disparity + config.num_disparities - 1), static_cast<int>(config.bits),
               method_name(config.method), stage_name(config.stage));
  std::fprintf(stream, "%.1f ms", result.fastest());
  if (arguments.repeat > 1)
    std::fprintf(stream, " (median %.1f ms, %d times)", result.median(), static_cast<int>(arguments.repeat));
  std::fprintf(stream, ", %d thread%s, %.0f KB\n", static_cast<int>(config.max_jobs), config.max_jobs == 1 ? "" : "s",
               static_cast<double>(result.arena_bytes) / 1024.0);
  if (config.stage != BSM_STAGE_CHECKED) return;
  const auto invalid = std::count(result.disparity.begin(), result.disparity.end(), bsm_invalid_disparity(&config));
  const double size = static_cast<double>(result.disparity.size());
  std::fprintf(stream, "both views agree on %.1f %% of the pixels\n", 100.0 * (size - static_cast<double>(invalid)) / size);
}

}  // namespace

int match_command(const std::vector<std::string>& argument_list) {
  MatchArguments arguments;
  Options options("match", kUsage, kSummary);
  options.positional("LEFT", &arguments.left);
  options.positional("RIGHT", &arguments.right);
  options.word("--output", "OUT", &arguments.output, "where the map goes");
  options.also("-o");
  arguments.config.add_search(&options);
  arguments.config.add_stage(&options);
  options.word("--right-out", "FILE", &arguments.right_output, "the right view's map goes there too");
  options.word("--confidence-out", "FILE", &arguments.confidence_output,
               "how far each value can be trusted, an 8-bit .png or .pgm");
  options.number("--scale", "S", &arguments.style.scale, 0.0, true, "8-bit value = disparity x S, at most 255");
  options.flag("--color", &arguments.style.color, "a .png in colours");
  options.flag("--stream", &arguments.stream, "match row by row; the same map in the memory of a few rows");
  options.integer("--repeat", "R", &arguments.repeat, 1, 1000000, "match R times and report the times");
  options.flag("--json", &arguments.json, "report as one JSON object");
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
  if (!check_arguments(options, &arguments)) return kExitUsage;

  // A refused configuration is reported before the images are read, which may be a long pipe. They
  // alone tell the format.
  bsm_config& config = arguments.config.config;
  config.right_map = arguments.right_output.empty() ? 0 : 1;
  config.confidence = arguments.confidence_output.empty() ? 0 : 1;
  size_t bytes = 0;
  int32_t delay = 0;
  bsm_status status = bsm_memory_required(&config, &bytes);
  if (status >= 0 && arguments.stream) status = bsm_row_delay(&config, &delay);
  if (status < 0 && status != BSM_ERROR_FORMAT) {
    usage_error(config_error(status));
    return kExitUsage;
  }

  std::string error;
  Image8 left, right;
  if (!can_write_to(arguments.map.path, &error) ||
      (config.right_map != 0 && !can_write_to(arguments.right_map.path, &error)) ||
      (config.confidence != 0 && !can_write_to(arguments.confidence_map.path, &error)) ||
      !read_views(arguments.left, arguments.right, &left, &right, &error) ||
      !prepare_pair(&left, arguments.left, &right, arguments.right, &error)) {
    print_error("match: " + error);
    return kExitData;
  }

  arguments.config.set_format(left.channels == 3 ? BSM_FORMAT_RGB24 : BSM_FORMAT_GRAY8);
  MatchRequest request;
  request.left = &left;
  request.right = &right;
  request.config = config;
  request.rows = arguments.stream;
  request.repeat = arguments.repeat;
  MatchResult result;
  if (!run_match(request, &result, &status)) {
    print_error("match: " + (status == BSM_ERROR_ARENA
                                 ? text("cannot allocate %zu bytes; fewer --threads, --disparities or --bits need less",
                                        result.arena_bytes)
                                 : config_error(status)));
    return kExitData;
  }
  if (!write_maps(arguments, result, &error)) {
    print_error("match: " + error);
    return kExitData;
  }
  if (arguments.json) {
    print_json(arguments, result);
  } else {
    const bool map_on_stdout =
        arguments.map.path == "-" || arguments.right_map.path == "-" || arguments.confidence_map.path == "-";
    print_summary(map_on_stdout ? stderr : stdout, arguments, result);
  }
  return kExitOk;
}

}  // namespace bsm::host
