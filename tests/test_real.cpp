// test_real.cpp - real pairs with ground truth, from the folder that the environment variable BSM_DATA names: rows equal
// frames, the mask removes edge fattening, and the refined maps reach the error that the documentation states.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "bsm/bsm.h"
#include "check.h"
#include "host/config_options.h"
#include "host/disparity_file.h"
#include "host/evaluate.h"
#include "host/pnm_read.h"
#include "host/run_match.h"

using namespace bsm::host;
using namespace bsm::test;

namespace {

struct Pair {
  const char* name;
  int num_disparities;
  double scale;  // ground truth = disparity * scale
};
constexpr Pair kPairs[] = {{"tsukuba", 16, 16}, {"venus", 20, 8}, {"teddy", 60, 4}, {"cones", 60, 4}};
constexpr const char* kRegions[] = {"nonocc", "all", "disc"};

// The folder of the four pairs; skips the case without it.
std::string data_folder() {
  const char* root = std::getenv("BSM_DATA");
  if (!root || !*root) {
    SKIP(
        "BSM_DATA is not set; it names a folder that holds v2/tsukuba, v2/venus, v2/teddy and v2/cones "
        "(pairs with ground truth: vision.middlebury.edu/stereo/data)");
  }
  const std::string folder = std::string(root) + "/v2";
  if (!std::filesystem::is_directory(folder)) {
    SKIP("BSM_DATA names " + std::string(root) +
         ", which has no folder v2 (pairs with ground truth: vision.middlebury.edu/stereo/data)");
  }
  return folder;
}

Image8 read_view(const std::string& path) {
  SampleImage image;
  std::string error;
  const Scope scope(path);
  REQUIRE(read_pnm_file(path, &image, &error));
  return to_image8(image);
}

MatchResult match(const Image8& left, const Image8& right, const bsm_config& config, bool rows) {
  MatchRequest request;
  request.left = &left;
  request.right = &right;
  request.config = config;
  request.rows = rows;
  MatchResult result;
  bsm_status status = BSM_OK;
  REQUIRE(run_match(request, &result, &status));
  return result;
}

bsm_config config_of(const Image8& left, const Pair& pair) {
  bsm_config config;
  REQUIRE_EQ(bsm_config_init(&config, left.width, left.height), BSM_OK);
  REQUIRE_EQ(bsm_config_preset(&config, BSM_PRESET_PAPER), BSM_OK);
  config.num_disparities = pair.num_disparities;
  config.max_jobs = static_cast<int32_t>(std::clamp(std::thread::hardware_concurrency(), 1u, 16u));
  return config;
}

// Bad-pixel percentages of a map in the three regions.
std::vector<double> errors_of(const std::string& folder, const Pair& pair, const MatchResult& result) {
  std::string error;
  DisparityMap truth;
  REQUIRE(read_truth(folder + "/disparity.pgm", pair.scale, &truth, &error) == MapRead::kDone);
  const DisparityMap map = disparity_map(result.disparity.data(), result.config.width, result.config.height,
                                         bsm_invalid_disparity(&result.config));
  std::vector<double> errors;
  for (const char* region : kRegions) {
    const Image8 mask = read_view(folder + "/" + region + ".pgm");
    errors.push_back(evaluate(map, truth, mask.pixels, 1.0).bad_percent());
  }
  return errors;
}

}  // namespace

TEST_CASE(rows_equal_frame) {
  const std::string folder = data_folder() + "/tsukuba";
  const Image8 left = read_view(folder + "/left.ppm"), right = read_view(folder + "/right.ppm");
  bsm_config config = config_of(left, kPairs[0]);
  config.bits = 256;
  config.right_map = 1;
  const MatchResult frame = match(left, right, config, false), rows = match(left, right, config, true);
  CHECK(frame.disparity == rows.disparity);
  CHECK(frame.right_disparity == rows.right_disparity);
}

TEST_CASE(errors_at_4096_bits) {
  const std::string root = data_folder();
  if (kSanitized || !kOptimized) SKIP("4096 bits on four pairs take too long in a build that is sanitized or not optimized");
  double average[BSM_STAGE_REFINED + 1] = {}, disc[BSM_STAGE_REFINED + 1] = {};
  std::printf("  bad pixels in %% (nonocc / all / disc)\n");
  for (const Pair& pair : kPairs) {
    const std::string folder = root + "/" + pair.name;
    const Image8 left = read_view(folder + "/left.ppm"), right = read_view(folder + "/right.ppm");
    for (const bsm_stage stage : {BSM_STAGE_COST, BSM_STAGE_MASKED, BSM_STAGE_REFINED}) {
      bsm_config config = config_of(left, pair);
      config.stage = stage;
      const std::vector<double> errors = errors_of(folder, pair, match(left, right, config, false));
      std::printf("  %-8s %-8s %6.2f %6.2f %6.2f\n", pair.name, stage_name(stage), errors[0], errors[1], errors[2]);
      for (const double e : errors) average[stage] += e / 12;
      disc[stage] += errors[2] / 4;
    }
  }
  for (const bsm_stage stage : {BSM_STAGE_COST, BSM_STAGE_MASKED, BSM_STAGE_REFINED}) {
    std::printf("  average  %-8s %6.2f, disc alone %6.2f\n", stage_name(stage), average[stage], disc[stage]);
  }
  CHECK(disc[BSM_STAGE_MASKED] < disc[BSM_STAGE_COST]);
  CHECK_LE(average[BSM_STAGE_REFINED], 5.8);
}
