// bsm evaluate: a disparity map against ground truth.
#include <cstdio>
#include <string>
#include <vector>

#include "host/commands.h"
#include "host/disparity_file.h"
#include "host/evaluate.h"
#include "host/json.h"
#include "host/options.h"
#include "host/pnm_read.h"
#include "host/text.h"

namespace bsm::host {
namespace {

constexpr char kUsage[] = "evaluate DISPARITY TRUTH --scale S [--mask M]... [options]";
constexpr char kSummary[] =
    "Counts bad pixels as the Middlebury benchmark does: a pixel counts where the mask is 255 and the truth is known; it "
    "is\n"
    "bad when |disparity - truth| is above the threshold or the disparity is invalid. DISPARITY is a .pfm, a 16-bit .pgm\n"
    "(1/16 pixel, 65535 = invalid) or an 8-bit .pgm (--disparity-scale, 0 = invalid). TRUTH is a .pgm (true disparity =\n"
    "value / S, 0 = unknown) or a .pfm (in pixels, without --scale). Without masks every pixel of known truth counts.";

struct Region {
  std::string name;
  Mask mask;
};

struct EvaluateArguments {
  std::string disparity, truth, truth_right;
  std::vector<std::string> masks;
  double scale = 0.0, disparity_scale = 0.0, threshold = 1.0;
  bool json = false;
};

bool read_mask(const std::string& path, Region* region, int32_t* width, int32_t* height, std::string* error) {
  SampleImage image;
  if (!read_pnm_file(path, &image, error, "pgm")) return false;
  if (image.channels != 1 || image.max_value != 255) {
    *error = path + ": a mask is an 8-bit PGM, where 255 means that the pixel counts";
    return false;
  }
  region->name = path;
  region->mask.assign(image.samples.size(), 0);
  for (size_t i = 0; i < image.samples.size(); ++i) region->mask[i] = static_cast<uint8_t>(image.samples[i]);
  *width = image.width;
  *height = image.height;
  return true;
}

bool check_size(const std::string& path, int32_t width, int32_t height, const EvaluateArguments& arguments,
                const DisparityMap& truth, std::string* error) {
  if (width == truth.width && height == truth.height) return true;
  *error = path + text(" is %d x %d pixels, but ", static_cast<int>(width), static_cast<int>(height)) + arguments.truth +
           text(" %d x %d", static_cast<int>(truth.width), static_cast<int>(truth.height));
  return false;
}

// Reads everything; the regions are the masks, or all known pixels, and with a right truth the non-occluded ones. Returns
// the exit code.
int read_inputs(const EvaluateArguments& arguments, DisparityMap* result, DisparityMap* truth, std::vector<Region>* regions,
                std::string* error) {
  DisparityMap truth_right;
  MapRead read = read_result(arguments.disparity, arguments.disparity_scale, result, error);
  if (read == MapRead::kDone) read = read_truth(arguments.truth, arguments.scale, truth, error);
  if (read == MapRead::kDone && !arguments.truth_right.empty()) {
    read = read_truth(arguments.truth_right, arguments.scale, &truth_right, error);
  }
  if (read != MapRead::kDone) return read == MapRead::kBadScale ? kExitUsage : kExitData;
  if (!check_size(arguments.disparity, result->width, result->height, arguments, *truth, error)) return kExitData;

  for (const std::string& path : arguments.masks) {
    Region region;
    int32_t width = 0, height = 0;
    if (!read_mask(path, &region, &width, &height, error) || !check_size(path, width, height, arguments, *truth, error)) {
      return kExitData;
    }
    regions->push_back(region);
  }
  if (arguments.masks.empty()) regions->push_back({"known truth", Mask()});
  if (arguments.truth_right.empty()) return kExitOk;
  if (!check_size(arguments.truth_right, truth_right.width, truth_right.height, arguments, *truth, error)) return kExitData;
  regions->push_back({"non-occluded", cross_check(*truth, truth_right)});
  return kExitOk;
}

void print_json(const EvaluateArguments& arguments, const std::vector<Region>& regions,
                const std::vector<Evaluation>& evaluations) {
  JsonArray masks;
  for (size_t i = 0; i < regions.size(); ++i) {
    const Evaluation& evaluation = evaluations[i];
    JsonObject at;
    for (int t = 0; t < kCommonThresholdCount; ++t) {
      at.add(text("%.1f", kCommonThresholds[t]).c_str(), evaluation.percent(evaluation.bad_at[t]));
    }
    JsonObject mask;
    mask.add("name", regions[i].name)
        .add("counted", evaluation.counted)
        .add("bad", evaluation.bad)
        .add("bad_percent", evaluation.bad_percent())
        .add("invalid", evaluation.invalid)
        .add("mean_abs_error", evaluation.mean_error())
        .add_json("bad_percent_at", at.str());
    masks.add_json(mask.str());
  }
  JsonObject json;
  json.add("disparity", arguments.disparity)
      .add("truth", arguments.truth)
      .add("threshold", arguments.threshold)
      .add_json("masks", masks.str());
  std::printf("%s\n", json.str().c_str());
}

void print_table(const EvaluateArguments& arguments, const std::vector<Region>& regions,
                 const std::vector<Evaluation>& evaluations) {
  std::printf("%10s %9s", text("bad > %g", arguments.threshold).c_str(), "pixels");
  for (const double threshold : kCommonThresholds) std::printf(" %9s", text("> %.1f", threshold).c_str());
  std::printf(" %9s %11s  %s\n", "invalid", "mean error", "mask");
  for (size_t i = 0; i < regions.size(); ++i) {
    const Evaluation& evaluation = evaluations[i];
    std::printf("%8.2f %% %9lld", evaluation.bad_percent(), static_cast<long long>(evaluation.counted));
    for (const int64_t bad : evaluation.bad_at) std::printf(" %7.2f %%", evaluation.percent(bad));
    std::printf(" %7.2f %% %8.3f px  %s\n", evaluation.percent(evaluation.invalid), evaluation.mean_error(),
                regions[i].name.c_str());
  }
}

}  // namespace

int evaluate_command(const std::vector<std::string>& argument_list) {
  EvaluateArguments arguments;
  Options options("evaluate", kUsage, kSummary);
  options.positional("DISPARITY", &arguments.disparity);
  options.positional("TRUTH", &arguments.truth);
  options.number("--scale", "S", &arguments.scale, 0.0, true, "true disparity = value / S, for a .pgm");
  options.words("--mask", "M", &arguments.masks, "8-bit PGM, 255 = the pixel counts; may be given several times");
  options.number("--threshold", "T", &arguments.threshold, 0.0, false, "largest error that is not bad, in pixels");
  options.word("--truth-right", "FILE", &arguments.truth_right,
               "the right view's truth, same scale: non-occluded pixels by cross-check");
  options.number("--disparity-scale", "S2", &arguments.disparity_scale, 0.0, true,
                 "disparity = value / S2, for an 8-bit .pgm");
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

  DisparityMap result, truth;
  std::vector<Region> regions;
  std::string error;
  const int read = read_inputs(arguments, &result, &truth, &regions, &error);
  if (read != kExitOk) {
    print_error("evaluate: " + error);
    return read;
  }
  std::vector<Evaluation> evaluations;
  for (const Region& region : regions) {
    evaluations.push_back(evaluate(result, truth, region.mask, arguments.threshold));
    if (evaluations.back().counted == 0) {
      print_error("evaluate: " + region.name + ": no pixel counts; the mask must be 255 somewhere with known truth");
      return kExitData;
    }
  }
  if (arguments.json) {
    print_json(arguments, regions, evaluations);
  } else {
    print_table(arguments, regions, evaluations);
  }
  return kExitOk;
}

}  // namespace bsm::host
