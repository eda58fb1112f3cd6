// bsm demo: renders the synthetic scene, matches it, measures the result and leaves pictures of everything.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "bsm/bsm.h"
#include "host/colormap.h"
#include "host/commands.h"
#include "host/config_options.h"
#include "host/disparity_file.h"
#include "host/evaluate.h"
#include "host/file_output.h"
#include "host/map_write.h"
#include "host/options.h"
#include "host/png_write.h"
#include "host/run_match.h"
#include "host/scene_frame.h"
#include "host/text.h"

namespace bsm::host {
namespace {

constexpr char kUsage[] = "demo DIR [options]";
constexpr char kSummary[] =
    "Renders a synthetic stereo scene with exact ground truth, matches it and writes the pictures into the folder DIR.";

// The refined map comes first: it is the one that is measured.
constexpr int32_t kStages[] = {BSM_STAGE_REFINED, BSM_STAGE_CHECKED, BSM_STAGE_AGGREGATED, BSM_STAGE_MASKED, BSM_STAGE_COST};
constexpr int kStageCount = sizeof(kStages) / sizeof(kStages[0]);

constexpr double kThreshold = 1.0;
constexpr Color kBadColor{224, 48, 48};         // bad, though both views show the point
constexpr Color kBadHiddenColor{240, 176, 48};  // bad, where the right view does not show the point

Color error_color(const Image8& left, size_t i, bool bad, bool visible) {
  if (bad) return visible ? kBadColor : kBadHiddenColor;
  const uint8_t* pixel = &left.pixels[3 * i];
  const uint8_t gray = static_cast<uint8_t>((pixel[0] + 2 * pixel[1] + pixel[2]) / 8);
  return {gray, gray, gray};
}

// The left view darkened, with the bad pixels marked.
Image8 draw_errors(const Scene& scene, const DisparityMap& result, const DisparityMap& truth) {
  Image8 picture{scene.left.width, scene.left.height, 3, {}};
  picture.pixels.reserve(scene.left.pixels.size());
  for (size_t i = 0; i < truth.pixels.size(); ++i) {
    const float error =
        result.pixels[i] > truth.pixels[i] ? result.pixels[i] - truth.pixels[i] : truth.pixels[i] - result.pixels[i];
    const Color color = error_color(scene.left, i, error > static_cast<float>(kThreshold), scene.left_visible[i] == 255);
    picture.pixels.insert(picture.pixels.end(), {color.r, color.g, color.b});
  }
  return picture;
}

MapView view_of(const std::vector<int16_t>& values, const bsm_config& config) {
  return {values.data(),        config.width,          config.height, bsm_invalid_disparity(&config),
          config.min_disparity, config.num_disparities};
}

// Writes files into one folder; after a failure it does nothing more.
class Folder {
 public:
  explicit Folder(const std::string& path) : path_(path) {
    std::error_code failure;
    std::filesystem::create_directories(path, failure);
    if (!std::filesystem::is_directory(path)) {
      error_ =
          path + ": cannot make this folder" + (failure ? ": " + failure.message() : "; a file of that name is in the way");
    }
  }

  void write(const char* name, const std::vector<uint8_t>& bytes) {
    if (error_.empty()) write_file(path_ + "/" + name, bytes, &error_);
  }
  void write_color(const char* name, const MapView& map) {
    std::vector<uint8_t> bytes;
    MapStyle style;
    style.color = true;
    if (error_.empty() && encode_map(map, MapFormat::kPng, style, &bytes, &error_)) write(name, bytes);
  }
  void write_pfm(const char* name, const MapView& map) {
    std::vector<uint8_t> bytes;
    if (error_.empty() && encode_map(map, MapFormat::kPfm, MapStyle(), &bytes, &error_)) write(name, bytes);
  }

  const std::string& error() const { return error_; }

 private:
  std::string path_;
  std::string error_;
};

void print_evaluation(const char* pixels, const Evaluation& evaluation) {
  std::printf("  %-14s %6.2f %% bad (error > %g), mean error %.3f pixels\n", pixels, evaluation.bad_percent(), kThreshold,
              evaluation.mean_error());
}

// Matches the scene up to each stage and writes the maps.
int run_demo(const std::string& path, const bsm_config& config, const SceneOptions& scene_options) {
  Folder folder(path);
  if (!folder.error().empty()) {
    print_error("demo: " + folder.error());
    return kExitData;
  }
  std::fprintf(stderr, "rendering %d x %d\n", static_cast<int>(scene_options.width), static_cast<int>(scene_options.height));
  const Scene scene = render_scene(scene_options);
  folder.write("left.png", encode_png(scene.left));
  folder.write("right.png", encode_png(scene.right));
  folder.write("left.ppm", encode_pnm(scene.left));
  folder.write("right.ppm", encode_pnm(scene.right));
  const DisparityMap truth =
      disparity_map(scene.left_truth.data(), scene.left.width, scene.left.height, bsm_invalid_disparity(&config));

  MatchResult refined;
  for (int i = 0; i < kStageCount && folder.error().empty(); ++i) {
    const int32_t stage = kStages[i];
    if (stage == BSM_STAGE_AGGREGATED && config.method == BSM_METHOD_LOCAL) continue;
    std::fprintf(stderr, "matching, %s map (%d of %d)\n", stage_name(stage), i + 1, kStageCount);
    MatchRequest request;
    request.left = &scene.left;
    request.right = &scene.right;
    request.config = config;
    request.config.stage = stage;
    MatchResult result;
    bsm_status status = BSM_OK;
    if (!run_match(request, &result, &status)) {
      print_error("demo: " + config_error(status));
      return kExitData;
    }
    const MapView map = view_of(result.disparity, result.config);
    folder.write_color(text("stage_%s.png", stage_name(stage)).c_str(), map);
    if (stage != BSM_STAGE_REFINED) continue;
    folder.write_color("truth.png", view_of(scene.left_truth, result.config));
    folder.write_pfm("truth.pfm", view_of(scene.left_truth, result.config));
    folder.write_color("disparity.png", map);
    folder.write_pfm("disparity.pfm", map);
    const DisparityMap measured = disparity_map(map.values, map.width, map.height, map.invalid);
    folder.write("error.png", encode_png(draw_errors(scene, measured, truth)));
    refined = result;
  }
  if (!folder.error().empty()) {
    print_error("demo: " + folder.error());
    return kExitData;
  }

  const bsm_config& used = refined.config;
  const DisparityMap measured =
      disparity_map(refined.disparity.data(), used.width, used.height, bsm_invalid_disparity(&used));
  std::printf("synthetic scene, %d x %d, %d disparities, %d bits\n", static_cast<int>(used.width),
              static_cast<int>(used.height), static_cast<int>(used.num_disparities), static_cast<int>(used.bits));
  print_evaluation("all", evaluate(measured, truth, Mask(), kThreshold));
  print_evaluation("non-occluded", evaluate(measured, truth, scene.left_visible, kThreshold));
  std::printf("  time           %.1f ms on %d thread%s\n", refined.fastest(), static_cast<int>(used.max_jobs),
              used.max_jobs == 1 ? "" : "s");
  std::printf("  memory         %.0f KB\n", static_cast<double>(refined.arena_bytes) / 1024.0);
  std::printf(
      "pictures in %s:\n"
      "  left.png right.png          the two views (left.ppm, right.ppm: for 'bsm match')\n"
      "  disparity.png, truth.png    what was found and what is true, violet = far, yellow = near (.pfm: the numbers)\n"
      "  error.png                   bad pixels: red, and orange where the right view does not show the point\n"
      "  stage_*.png                 the map after each stage: cost, masked, aggregated, checked (black = rejected), "
      "refined\n",
      path.c_str());
  return kExitOk;
}

}  // namespace

int demo_command(const std::vector<std::string>& argument_list) {
  std::string path;
  ConfigOptions config_options;
  SceneOptions scene;
  int32_t seed = static_cast<int32_t>(scene.seed);
  config_options.config.max_jobs =
      static_cast<int32_t>(std::min<unsigned>(BSM_MAX_JOBS, std::max(1u, std::thread::hardware_concurrency())));
  Options options("demo", kUsage, kSummary);
  options.positional("DIR", &path);
  options.integer("--width", "W", &scene.width, 1, BSM_MAX_SIZE, "width of the views in pixels");
  options.integer("--height", "H", &scene.height, 1, BSM_MAX_SIZE, "height of the views in pixels");
  options.integer("--seed", "S", &seed, 0, INT32_MAX, "other textures and noise");
  config_options.add_search(&options);
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
  if (!config_options.finish(&error)) {
    print_error("demo: " + error);
    return kExitUsage;
  }
  bsm_config& config = config_options.config;
  config.width = scene.width;
  config.height = scene.height;
  size_t bytes = 0;
  const bsm_status status = bsm_memory_required(&config, &bytes);
  if (status < 0) {
    print_error("demo: " + config_error(status));
    return kExitUsage;
  }
  scene.seed = static_cast<uint32_t>(seed);
  scene.min_disparity = config.min_disparity;
  scene.num_disparities = config.num_disparities;
  return run_demo(path, config, scene);
}

}  // namespace bsm::host
