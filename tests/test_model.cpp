// test_model.cpp - the library against the plain model, all four stages and both views, scalar and every other kernel that
// runs here, on small images of every kind.
#include <initializer_list>

#include "bsm/bsm.h"
#include "check.h"
#include "images.h"
#include "matching.h"
#include "model.h"

using namespace bsm::test;

namespace {

void compare(bsm_config config, const ColorPair& colors) {
  config.right_map = 1;
  const bsm_format format = static_cast<bsm_format>(config.format);
  const EncodedPair pair = encode(colors, format);
  const ModelMaps model = run_model(config, is_yuv(format) ? decode(pair) : colors);
  for (const bsm_stage stage : kStages) {
    config.stage = stage;
    for (const uint32_t isa_mask : isa_masks()) {
      config.isa_mask = isa_mask;
      const Scope scope(describe(config));
      const Maps maps = match_frame(config, pair);
      check_same_map(maps.left, model.left[stage], config.width, "left map, library against model");
      check_same_map(maps.right, model.right[stage], config.width, "right map, library against model");
    }
  }
}

// A random configuration of the given size whose every field can matter.
bsm_config random_config(Rng& rng, int width, int height) {
  bsm_config config = config_for(width, height, rng.one_in(3) ? BSM_FORMAT_GRAY8 : BSM_FORMAT_RGB24);
  config.bits = 64 * rng.range(1, rng.one_in(8) ? 64 : 6);
  config.num_disparities = rng.range(1, 24);
  config.min_disparity = rng.one_in(2) ? 0 : rng.range(-12, 12);
  config.lr_tolerance = rng.range(0, 3);
  config.vote_radius = rng.one_in(4) ? rng.range(1, BSM_MAX_VOTE_RADIUS) : rng.range(1, 6);
  config.vote_color = rng.range(1, 64);
  config.vote_distance = rng.range(1, 64);
  config.median = rng.range(0, 1);
  return config;
}

Content random_content(Rng& rng) {
  return kAllContents[rng.range(0, 5)];
}

}  // namespace

TEST_CASE(random_configurations) {
  Rng rng(seed());
  for (int i = repeats(250); i-- > 0;) {
    const bsm_config config = random_config(rng, rng.range(1, 36), rng.range(1, 20));
    const Content content = random_content(rng);
    const Scope scope(content_name(content));
    compare(config, make_pair(rng, content, config.width, config.height, rng.range(-8, 8)));
  }
}

TEST_CASE(every_content_in_color_and_gray) {
  Rng rng(seed() + 1);
  for (const Content content : kAllContents) {
    for (const bsm_format format : {BSM_FORMAT_RGB24, BSM_FORMAT_GRAY8}) {
      bsm_config config = config_for(33, 17, format);  // defaults of the vote and the median
      config.bits = 256;
      config.num_disparities = 16;
      const Scope scope(content_name(content));
      compare(config, make_pair(rng, content, config.width, config.height, 5));
    }
  }
}

TEST_CASE(every_format) {
  Rng rng(seed() + 2);
  for (const bsm_format format : kAllFormats) {
    bsm_config config = config_for(23, 14, format);
    config.bits = 192;
    config.num_disparities = 9;
    compare(config, to_rgb565_colors(make_pair(rng, Content::kShifted, 23, 14)));
    config.width = 10, config.height = 9;
    compare(config, to_rgb565_colors(make_pair(rng, Content::kNoise, 10, 9)));
  }
}

TEST_CASE(descriptor_lengths) {
  Rng rng(seed() + 3);
  for (const int bits : {64, 128, 192, 256, 1024, 4032, 4096}) {
    for (const Content content : {Content::kShifted, Content::kFewColors}) {
      bsm_config config = config_for(21, 9);
      config.bits = bits;
      config.num_disparities = 12;
      config.vote_radius = 5;
      compare(config, make_pair(rng, content, config.width, config.height, 4));
    }
  }
}

TEST_CASE(tiny_and_thin_images) {
  Rng rng(seed() + 4);
  const int sizes[][2] = {{1, 1},  {2, 1},  {1, 2},   {2, 2},   {3, 3},  {1, 40}, {60, 1},
                          {2, 31}, {45, 2}, {12, 12}, {13, 13}, {24, 5}, {5, 27}};
  for (const auto& size : sizes) {
    for (int i = 0; i < 3; ++i) {
      bsm_config config = random_config(rng, size[0], size[1]);
      config.bits = 64 * rng.range(1, 3);
      compare(config, make_pair(rng, random_content(rng), size[0], size[1], 1));
    }
  }
}

// Taller than everything that the windows span, so that every ring of rows comes round more than once.
TEST_CASE(tall_images) {
  Rng rng(seed() + 9);
  for (int i = repeats(20); i-- > 0;) {
    bsm_config config = random_config(rng, rng.range(3, 9), rng.range(60, 130));
    config.bits = 64;
    config.num_disparities = rng.range(2, 6);
    config.vote_radius = rng.one_in(2) ? rng.range(1, 12) : rng.range(13, 32);
    config.max_jobs = rng.range(1, 2);  // rings hold the rows of a move with more than one
    compare(config, make_pair(rng, rng.one_in(2) ? Content::kShifted : Content::kNoise, config.width, config.height));
  }
}

TEST_CASE(disparity_ranges_at_and_beyond_the_width) {
  Rng rng(seed() + 5);
  const int ranges[][2] = {{0, 1},        {0, 8},    {0, 9},     {0, 10}, {0, 200},   {-8, 9},    {-9, 9},
                           {-10, 3},      {7, 4},    {8, 4},     {9, 4},  {100, 50},  {-100, 50}, {-5, 11},
                           {-2047, 4094}, {2046, 1}, {-2047, 1}, {-3, 2}, {-20, 2067}};
  for (const auto& range : ranges) {
    bsm_config config = config_for(9, 6);
    config.bits = 64;
    config.min_disparity = range[0];
    config.num_disparities = range[1];
    config.vote_radius = 3;
    for (const Content content : {Content::kShifted, Content::kConstant}) {
      compare(config, make_pair(rng, content, config.width, config.height, 2));
    }
  }
}

TEST_CASE(tolerances) {
  Rng rng(seed() + 6);
  for (const int tolerance : {0, 1, 2, 7, 255}) {
    bsm_config config = config_for(30, 12);
    config.bits = 64;  // few bits: many pixels disagree by a little
    config.num_disparities = 14;
    config.lr_tolerance = tolerance;
    compare(config, make_pair(rng, Content::kShifted, config.width, config.height, 6));
    compare(config, make_pair(rng, Content::kNoise, config.width, config.height));
  }
}

TEST_CASE(vote_parameters) {
  Rng rng(seed() + 7);
  for (const int radius : {1, 2, 24, BSM_MAX_VOTE_RADIUS}) {
    for (const int divisor : {1, 9, 64}) {
      bsm_config config = config_for(38, 10);
      config.bits = 64;
      config.num_disparities = 16;
      config.vote_radius = radius;
      config.vote_color = divisor;
      config.vote_distance = 65 - divisor;
      config.median = 0;
      compare(config, make_pair(rng, Content::kShifted, config.width, config.height, 7));
      config.format = BSM_FORMAT_GRAY8;
      compare(config, make_pair(rng, Content::kFewColors, config.width, config.height));
    }
  }
}

TEST_CASE(holes_without_a_vote) {
  // Hardly any pixel survives the check of noise with a wide range, and the smallest window sees few of them: rows with one
  // valid pixel, rows with none, and images with none all occur.
  Rng rng(seed() + 8);
  for (int i = repeats(40); i-- > 0;) {
    bsm_config config = config_for(rng.range(4, 40), rng.range(2, 12));
    config.bits = 64;
    config.num_disparities = config.width;
    config.lr_tolerance = 0;
    config.vote_radius = 1;
    config.median = i % 2;
    compare(config, make_pair(rng, Content::kNoise, config.width, config.height));
  }
  bsm_config none = config_for(8, 5);  // no candidates anywhere
  none.bits = 64;
  none.min_disparity = 50;
  none.num_disparities = 3;
  compare(none, make_pair(rng, Content::kNoise, none.width, none.height));
}
