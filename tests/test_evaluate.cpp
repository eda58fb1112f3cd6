// test_evaluate.cpp - the bad-pixel measure on cases counted by hand, the cross-check, and the synthetic scene: its ground
// truth agrees with itself, and the library finds it.
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "bsm/bsm.h"
#include "check.h"
#include "host/disparity_file.h"
#include "host/evaluate.h"
#include "host/scene_frame.h"
#include "images.h"
#include "matching.h"

using namespace bsm::host;
using namespace bsm::test;

namespace {

DisparityMap row_map(std::vector<float> pixels) {
  const int32_t width = static_cast<int32_t>(pixels.size());
  return {width, 1, std::move(pixels)};
}

Scene scene_of(int width, int height, int min_disparity, int num_disparities, uint32_t scene_seed) {
  SceneOptions options;
  options.width = width;
  options.height = height;
  options.min_disparity = min_disparity;
  options.num_disparities = num_disparities;
  options.seed = scene_seed;
  return render_scene(options);
}

}  // namespace

TEST_CASE(what_counts_and_what_is_bad) {
  const float none = kNoDisparity;
  const DisparityMap truth = row_map({5, 5, 5, 5, none, 5, 5, 5});
  const DisparityMap result = row_map({5, 6, 6.0625f, none, 9, 3.9375f, 99, 4});
  // Every pixel: 7 have a known truth; bad are 6.0625 and 3.9375 (strictly above 1), the invalid one, and 99.
  const Evaluation all = evaluate(result, truth, Mask(), 1.0);
  CHECK_EQ(all.counted, 7);
  CHECK_EQ(all.bad, 4);
  CHECK_EQ(all.invalid, 1);
  CHECK_LE(std::fabs(all.bad_percent() - 400.0 / 7), 1e-9);
  CHECK_LE(std::fabs(all.error_sum - (0 + 1 + 1.0625 + 1.0625 + 94 + 1)), 1e-5);
  // A mask counts where it is exactly 255.
  const Evaluation masked = evaluate(result, truth, Mask{255, 255, 254, 255, 255, 0, 128, 255}, 1.0);
  CHECK_EQ(masked.counted, 4);
  CHECK_EQ(masked.bad, 1);
  // The threshold itself is not bad, and the disparity is not rounded first.
  CHECK_EQ(evaluate(row_map({5.5f}), row_map({5}), Mask(), 0.5).bad, 0);
  CHECK_EQ(evaluate(row_map({5.5625f}), row_map({5}), Mask(), 0.5).bad, 1);
  CHECK_EQ(evaluate(row_map({6.4f}), row_map({5}), Mask(), 1.0).bad, 1);
  const Evaluation nothing = evaluate(row_map({1}), row_map({none}), Mask(), 1.0);
  CHECK_EQ(nothing.counted, 0);
  CHECK_EQ(nothing.bad_percent(), 0.0);
  CHECK_EQ(nothing.mean_error(), 0.0);
}

TEST_CASE(common_thresholds) {
  const Evaluation e = evaluate(row_map({0, 0.75f, 1.5f, 3, 5, kNoDisparity}), row_map({0, 0, 0, 0, 0, 0}), Mask(), 1.0);
  const int64_t expected[kCommonThresholdCount] = {5, 4, 3, 2};  // above 0.5, 1, 2, 4
  for (int i = 0; i < kCommonThresholdCount; ++i) CHECK_EQ(e.bad_at[i], expected[i]);
}

TEST_CASE(cross_check_keeps_what_both_views_show) {
  const float none = kNoDisparity;
  //                                  x:  0     1  2     3     4  5
  const DisparityMap left = row_map({2, 1, none, 1.5f, 2, 2});
  const DisparityMap right = row_map({1, 2.5f, 2, none, 2, 2});
  // 0 leaves the image; 1 meets 0 (1 and 1); 2 is unknown; 3 meets 2 (1.5 - 2); 4 meets 2 (2 and 2); 5 meets an unknown one.
  CHECK(cross_check(left, right) == Mask({0, 255, 0, 255, 255, 0}));
}

TEST_CASE(scene_truth_agrees_with_itself) {
  for (const int min_disparity : {0, -20, 7}) {
    const int num_disparities = 24, width = 200, height = 90;
    const Scene scene = scene_of(width, height, min_disparity, num_disparities, 3);
    const Scope scope("from " + text_of(min_disparity));
    int visible = 0, agreeing = 0, least = INT32_MAX, most = INT32_MIN;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const size_t pixel = static_cast<size_t>(y * width + x);
        const int value = scene.left_truth[pixel];
        least = std::min(least, value);
        most = std::max(most, value);
        if (scene.left_visible[pixel] != 255) continue;
        ++visible;
        const int other = static_cast<int>(std::floor(x - value / 16.0 + 0.5));
        if (!CHECK(other >= 0 && other < width)) continue;
        agreeing += std::abs(scene.right_truth[static_cast<size_t>(y * width + other)] - value) <= 16;
      }
    }
    CHECK(least >= min_disparity * 16 && most <= (min_disparity + num_disparities - 1) * 16);
    CHECK(most - least > 8 * 16);  // several depths
    CHECK(visible > width * height * 6 / 10 && visible < width * height);
    CHECK(agreeing > visible * 98 / 100);
  }
}

TEST_CASE(scene_is_the_same_every_time_and_differs_by_seed) {
  const Scene a = scene_of(64, 40, 0, 16, 1), b = scene_of(64, 40, 0, 16, 1), c = scene_of(64, 40, 0, 16, 2);
  CHECK(a.left.pixels == b.left.pixels && a.right.pixels == b.right.pixels && a.left_truth == b.left_truth);
  CHECK(a.left.pixels != c.left.pixels);
  CHECK(a.left_truth == c.left_truth);
}

TEST_CASE(library_finds_the_scene) {
  // Bounds a little above what the method reaches: they fail when a stage stops helping.
  const int width = 240, height = 160, num_disparities = 32;
  const Scene scene = scene_of(width, height, 0, num_disparities, 1);
  EncodedPair pair;
  pair.left = {width, height, BSM_FORMAT_RGB24, width * 3, scene.left.pixels};
  pair.right = {width, height, BSM_FORMAT_RGB24, width * 3, scene.right.pixels};
  bsm_config config = config_for(width, height);
  config.bits = 512;
  config.num_disparities = num_disparities;
  const DisparityMap truth = disparity_map(scene.left_truth.data(), width, height, INT16_MIN);
  double bad[BSM_STAGE_REFINED + 1] = {};
  int64_t rejected = 0;
  for (const bsm_stage stage : kStages) {
    config.stage = stage;
    const Maps maps = match_frame(config, pair);
    const DisparityMap map = disparity_map(maps.left.data(), width, height, bsm_invalid_disparity(&config));
    const Evaluation e = evaluate(map, truth, scene.left_visible, 1.0);
    bad[stage] = e.bad_percent();
    if (stage == BSM_STAGE_CHECKED) rejected = e.invalid;
    std::printf("  %-8s %.2f %% bad, %.2f %% invalid of the pixels both views show\n", stage_name(stage), bad[stage],
                e.percent(e.invalid));
    if (stage == BSM_STAGE_REFINED) CHECK_EQ(e.invalid, 0);
  }
  CHECK(bad[BSM_STAGE_MASKED] < bad[BSM_STAGE_COST]);
  CHECK(bad[BSM_STAGE_REFINED] < bad[BSM_STAGE_MASKED]);
  CHECK(rejected > 0);
  CHECK_LE(bad[BSM_STAGE_REFINED], 3.0);
}
