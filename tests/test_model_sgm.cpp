// test_model_sgm.cpp - the library against the plain model of all it computes: both methods, every stage, both maps and the
// confidence, scalar and every other kernel that runs here, on small images of every kind.
#include <algorithm>
#include <initializer_list>

#include "bsm/bsm.h"
#include "check.h"
#include "host/scene_frame.h"
#include "images.h"
#include "matching.h"
#include "model_refine.h"

using namespace bsm::test;

namespace {

// One frame with everything that can be asked for.
struct Outputs {
  std::vector<int16_t> left, right;
  std::vector<uint8_t> confidence;
};

Outputs match_everything(const bsm_config& config, const EncodedPair& pair, Jobs jobs) {
  Arena arena(arena_bytes(config));
  bsm_context* context = nullptr;
  REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
  const size_t pixels = static_cast<size_t>(config.width) * static_cast<size_t>(config.height);
  Outputs out{std::vector<int16_t>(pixels, kUnwritten), std::vector<int16_t>(pixels, kUnwritten),
              std::vector<uint8_t>(pixels, 0)};
  bsm_frame frame{};
  frame.left = pair.left.view();
  frame.right = pair.right.view();
  frame.disparity = {out.left.data(), static_cast<ptrdiff_t>(config.width) * 2};
  frame.right_disparity = {out.right.data(), static_cast<ptrdiff_t>(config.width) * 2};
  frame.confidence = {out.confidence.data(), config.width};
  frame.parallel_for = parallel_for_of(jobs);
  REQUIRE_EQ(bsm_process(context, &frame), BSM_OK);
  return out;
}

// The same through the row API; the pair may have fewer rows than the configuration.
Outputs stream_everything(const bsm_config& config, const EncodedPair& pair) {
  Arena arena(arena_bytes(config));
  bsm_context* context = nullptr;
  REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
  const size_t width = static_cast<size_t>(config.width);
  std::vector<int16_t> left_row(width), right_row(width);
  std::vector<uint8_t> confidence_row(width);
  Outputs out;
  const auto pull = [&] {
    const bsm_status status = bsm_pull_row(context, left_row.data(), right_row.data(), confidence_row.data());
    if (status != BSM_OK) return status;
    out.left.insert(out.left.end(), left_row.begin(), left_row.end());
    out.right.insert(out.right.end(), right_row.begin(), right_row.end());
    out.confidence.insert(out.confidence.end(), confidence_row.begin(), confidence_row.end());
    return status;
  };
  for (int y = 0; y < pair.left.height; ++y) {
    const bsm_row left = pair.left.planes(y), right = pair.right.planes(y);
    REQUIRE_EQ(bsm_push_row(context, &left, &right), BSM_OK);
    pull();
  }
  if (pair.left.height < config.height) REQUIRE_EQ(bsm_finish(context), BSM_OK);
  while (pull() == BSM_OK) continue;
  return out;
}

std::vector<int16_t> widened(const std::vector<uint8_t>& bytes) {
  return std::vector<int16_t>(bytes.begin(), bytes.end());
}

void check_outputs(const Outputs& out, const FullMaps& model, bsm_stage stage, int width) {
  check_same_map(out.left, model.left[stage], width, "left map, library against model");
  check_same_map(out.right, model.right[stage], width, "right map, library against model");
  check_same_map(widened(out.confidence), widened(model.confidence[stage]), width, "confidence, library against model");
}

void compare(bsm_config config, const ColorPair& colors, std::initializer_list<bsm_stage> stages) {
  config.right_map = 1;
  config.confidence = 1;
  const FullMaps model = run_full_model(config, colors);
  const EncodedPair pair = encode(colors, static_cast<bsm_format>(config.format));
  for (const bsm_stage stage : stages) {
    if (config.method == BSM_METHOD_LOCAL && stage == BSM_STAGE_AGGREGATED) continue;
    config.stage = stage;
    for (const uint32_t isa_mask : isa_masks()) {
      config.isa_mask = isa_mask;
      const Scope scope(describe(config));
      check_outputs(match_everything(config, pair, config.max_jobs > 1 ? Jobs::kShuffled : Jobs::kNone), model, stage,
                    config.width);
    }
  }
}

void compare(const bsm_config& config, const ColorPair& colors) {
  compare(config, colors, {BSM_STAGE_COST, BSM_STAGE_MASKED, BSM_STAGE_AGGREGATED, BSM_STAGE_CHECKED, BSM_STAGE_REFINED});
}

// The stages that aggregation and refinement change.
void compare_late(const bsm_config& config, const ColorPair& colors) {
  compare(config, colors, {BSM_STAGE_AGGREGATED, BSM_STAGE_CHECKED, BSM_STAGE_REFINED});
}

// The preset balanced, with fewer bits and a smaller vote for images that are smaller too.
bsm_config small_config(int width, int height, bsm_format format = BSM_FORMAT_RGB24) {
  bsm_config config;
  REQUIRE_EQ(bsm_config_init(&config, width, height), BSM_OK);
  config.format = format;
  REQUIRE_EQ(bsm_config_preset(&config, BSM_PRESET_BALANCED), BSM_OK);
  config.num_disparities = 12;
  config.bits = 128;
  config.vote_radius = 12;
  config.vote_step = 3;
  return config;
}

// Slanted planes that hide each other.
ColorPair scene_pair(const bsm_config& config, uint32_t scene_seed) {
  bsm::host::SceneOptions options;
  options.width = config.width;
  options.height = config.height;
  options.min_disparity = config.min_disparity;
  options.num_disparities = config.num_disparities;
  options.seed = scene_seed;
  ColorPair pair{ColorImage(config.width, config.height), ColorImage(config.width, config.height)};
  for (int y = 0; y < config.height; ++y) {
    bsm::host::scene_row(options, y, {pair.left.at(0, y), pair.right.at(0, y), nullptr, nullptr, nullptr, nullptr});
  }
  return pair;
}

// A configuration whose every field can matter.
bsm_config random_config(Rng& rng, int width, int height) {
  bsm_config config = config_for(width, height, rng.one_in(3) ? BSM_FORMAT_GRAY8 : BSM_FORMAT_RGB24);
  randomize(rng, config, rng.one_in(3));
  config.num_disparities = rng.range(1, 24);
  config.min_disparity = rng.one_in(2) ? 0 : rng.range(-12, 12);
  config.max_jobs = rng.range(1, 3);
  return config;
}

Content random_content(Rng& rng) {
  return kAllContents[rng.range(0, 5)];
}

}  // namespace

TEST_CASE(random_configurations) {
  Rng rng(seed());
  for (int i = repeats(150); i-- > 0;) {
    const bsm_config config = random_config(rng, rng.range(1, 36), rng.range(1, 20));
    const Content content = random_content(rng);
    const Scope scope(content_name(content));
    compare(config, make_pair(rng, content, config.width, config.height, rng.range(-8, 8)));
  }
}

TEST_CASE(random_configurations_on_scenes) {
  Rng rng(seed() + 1);
  for (int i = repeats(60); i-- > 0;) {
    const bsm_config config = random_config(rng, rng.range(20, 60), rng.range(8, 30));
    compare_late(config, scene_pair(config, static_cast<uint32_t>(i + 1)));
  }
}

TEST_CASE(every_content_in_color_and_gray) {
  Rng rng(seed() + 2);
  for (const Content content : kAllContents) {
    for (const bsm_format format : {BSM_FORMAT_RGB24, BSM_FORMAT_GRAY8}) {
      bsm_config config = small_config(33, 17, format);
      const Scope scope(content_name(content));
      compare(config, make_pair(rng, content, config.width, config.height, 5));
    }
  }
}

TEST_CASE(paths_and_right_costs) {
  for (const int paths : {3, 4, 5, 8}) {
    for (const bsm_right_costs right_costs : {BSM_RIGHT_COSTS_OWN, BSM_RIGHT_COSTS_LEFT}) {
      for (const int subpixel : {0, 1}) {
        bsm_config config = small_config(48, 19);
        config.paths = paths;
        config.right_costs = right_costs;
        config.subpixel = subpixel;
        compare_late(config, scene_pair(config, 5));
      }
    }
  }
}

TEST_CASE(penalties_and_edges) {
  Rng rng(seed() + 3);
  const int penalties[][2] = {{1, 1}, {1, 16384}, {16384, 16384}, {95, 96}, {160, 1000}};
  for (const auto& penalty : penalties) {
    for (const int threshold : {1, 24, 255}) {
      bsm_config config = small_config(30, 12);
      config.p1 = penalty[0];
      config.p2 = penalty[1];
      config.edge_threshold = threshold;
      config.edge_divisor = threshold == 1 ? 64 : 6;
      config.paths = 8;
      compare(config, scene_pair(config, 7), {BSM_STAGE_AGGREGATED});
      compare(config, make_pair(rng, Content::kFewColors, config.width, config.height), {BSM_STAGE_AGGREGATED});
    }
  }
}

TEST_CASE(descriptor_lengths) {
  Rng rng(seed() + 4);
  for (const int bits : {64, 192, 512, BSM_MAX_SGM_BITS}) {
    for (const Content content : {Content::kShifted, Content::kFewColors}) {
      bsm_config config = small_config(25, 9);
      config.bits = bits;
      compare(config, make_pair(rng, content, config.width, config.height, 4));
    }
  }
}

TEST_CASE(presets) {
  for (const bsm_preset preset :
       {BSM_PRESET_PAPER, BSM_PRESET_FAST, BSM_PRESET_BALANCED, BSM_PRESET_BEST, BSM_PRESET_LOCAL}) {
    for (const bsm_format format : {BSM_FORMAT_RGB24, BSM_FORMAT_GRAY8}) {
      bsm_config config = small_config(41, 15, format);
      REQUIRE_EQ(bsm_config_preset(&config, preset), BSM_OK);
      compare(config, scene_pair(config, 2));
    }
  }
}

TEST_CASE(tiny_and_thin_images) {
  Rng rng(seed() + 5);
  const int sizes[][2] = {{1, 1},  {2, 1},  {1, 2},   {2, 2},   {3, 3},  {1, 40}, {60, 1},
                          {2, 31}, {45, 2}, {12, 12}, {13, 13}, {24, 5}, {5, 27}};
  for (const auto& size : sizes) {
    for (int i = 0; i < 4; ++i) {
      const bsm_config config = random_config(rng, size[0], size[1]);
      compare(config, make_pair(rng, random_content(rng), size[0], size[1], 1));
    }
  }
}

// Taller than everything that the windows span, so that every ring of rows comes round more than once.
TEST_CASE(tall_images) {
  Rng rng(seed() + 6);
  for (int i = repeats(16); i-- > 0;) {
    bsm_config config = random_config(rng, rng.range(3, 12), rng.range(90, 180));
    config.bits = 64;
    config.num_disparities = rng.range(2, 8);
    config.border = i % 2;
    compare_late(config, make_pair(rng, rng.one_in(2) ? Content::kShifted : Content::kNoise, config.width, config.height));
  }
}

// The confidence asks rows above and below, whose number the row API may learn late.
TEST_CASE(row_streams_that_end_early) {
  Rng rng(seed() + 10);
  for (int i = repeats(60); i-- > 0;) {
    bsm_config config = random_config(rng, rng.range(3, 24), rng.range(1, 60));
    config.paths = std::min(config.paths, 5);
    config.right_map = 1;
    config.confidence = 1;
    if (config.method == BSM_METHOD_SGM && rng.one_in(3)) config.stage = BSM_STAGE_AGGREGATED;
    const ColorPair colors = make_pair(rng, random_content(rng), config.width, config.height, 2);
    const FullMaps model = run_full_model(config, colors);
    config.height += rng.range(0, 40);
    const Scope scope(describe(config));
    check_outputs(stream_everything(config, encode(colors, static_cast<bsm_format>(config.format))), model,
                  static_cast<bsm_stage>(config.stage), config.width);
  }
}

TEST_CASE(disparity_ranges_at_and_beyond_the_width) {
  Rng rng(seed() + 7);
  const int ranges[][2] = {{0, 1},   {0, 8},  {0, 9},  {0, 10},    {0, 200},      {-8, 9},  {-9, 9},
                           {-10, 3}, {7, 4},  {8, 4},  {9, 4},     {100, 50},     {-5, 11}, {-100, 50},
                           {-3, 2},  {-2, 3}, {-2, 4}, {-20, 300}, {-2047, 4094}, {2046, 1}};
  for (const auto& range : ranges) {
    bsm_config config = small_config(9, 6);
    config.bits = 64;
    config.min_disparity = range[0];
    config.num_disparities = range[1];
    for (const Content content : {Content::kShifted, Content::kConstant}) {
      compare(config, make_pair(rng, content, config.width, config.height, 2));
    }
    config.method = BSM_METHOD_LOCAL;  // with the border continued, which the paper's steps do not have
    compare(config, make_pair(rng, Content::kNoise, config.width, config.height, 2));
  }
}

TEST_CASE(negative_ranges) {
  for (const int least : {-12, -9, -6, -3, 3}) {
    for (const bsm_method method : {BSM_METHOD_LOCAL, BSM_METHOD_SGM}) {
      bsm_config config = small_config(52, 21);
      config.method = method;
      config.min_disparity = least;
      compare_late(config, scene_pair(config, 3));
    }
  }
}

TEST_CASE(tolerances) {
  Rng rng(seed() + 8);
  for (const int tolerance : {0, 1, 2, 7, 255}) {
    bsm_config config = small_config(30, 12);
    config.bits = 64;  // few bits: many pixels disagree by a little
    config.lr_tolerance = tolerance;
    compare_late(config, make_pair(rng, Content::kShifted, config.width, config.height, 6));
    compare_late(config, make_pair(rng, Content::kNoise, config.width, config.height));
  }
}

TEST_CASE(speckles) {
  for (const int percent : {1, 4, 20, 33, 50, 80, 100}) {
    for (const bsm_method method : {BSM_METHOD_LOCAL, BSM_METHOD_SGM}) {
      bsm_config config = small_config(44, 23);
      config.bits = 64;
      config.method = method;
      config.speckle = percent;
      config.border = percent % 2;
      compare(config, scene_pair(config, static_cast<uint32_t>(percent)), {BSM_STAGE_CHECKED, BSM_STAGE_REFINED});
    }
  }
}

TEST_CASE(border_slopes) {
  for (const bsm_method method : {BSM_METHOD_LOCAL, BSM_METHOD_SGM}) {
    for (uint32_t i = 1; i <= 4; ++i) {
      bsm_config config = small_config(72, 40);
      config.bits = 64;
      config.method = method;
      config.num_disparities = 18;
      config.median = 0;
      config.smooth_passes = 0;
      config.vote_radius = 6;
      compare(config, scene_pair(config, i), {BSM_STAGE_REFINED});
    }
  }
}

TEST_CASE(votes) {
  for (const int step : {1, 2, 4, 8}) {
    for (const int cap : {0, 1}) {
      bsm_config config = small_config(56, 24);
      config.vote_step = step;
      config.vote_radius = 8;
      config.vote_cap = cap;
      config.vote_color = step == 8 ? 64 : 9;  // a weight for far colours: both surfaces vote
      config.border = 0;
      config.smooth_passes = 0;
      config.median = 0;
      compare(config, scene_pair(config, 11), {BSM_STAGE_REFINED});
      config.format = BSM_FORMAT_GRAY8;
      compare(config, to_gray(scene_pair(config, 12)), {BSM_STAGE_REFINED});
    }
  }
}

// Hardly any pixel of noise survives the check, and the smallest window sees few of them: holes take levels of
// their row or of the row above.
TEST_CASE(holes_without_a_vote) {
  Rng rng(seed() + 9);
  for (int i = repeats(40); i-- > 0;) {
    bsm_config config = random_config(rng, rng.range(4, 40), rng.range(2, 12));
    config.num_disparities = config.width;
    config.min_disparity = 0;
    config.lr_tolerance = 0;
    config.vote_radius = config.vote_step = 1;
    config.subpixel = 1;
    compare(config, make_pair(rng, Content::kNoise, config.width, config.height), {BSM_STAGE_REFINED});
  }
}

TEST_CASE(smoothing) {
  for (int radius = 1; radius <= BSM_MAX_SMOOTH_RADIUS; ++radius) {
    for (int passes = 0; passes <= BSM_MAX_SMOOTH_PASSES; ++passes) {
      bsm_config config = small_config(37, 20, radius % 2 ? BSM_FORMAT_RGB24 : BSM_FORMAT_GRAY8);
      config.bits = 64;
      config.num_disparities = 9;
      config.smooth_radius = radius;
      config.smooth_passes = passes;
      config.smooth_color = radius == 8 ? 64 : 6;
      config.median = passes % 2;
      config.subpixel = radius % 3 != 0;
      compare(config, scene_pair(config, static_cast<uint32_t>(radius)), {BSM_STAGE_REFINED});
    }
  }
}
