// test_formats.cpp - the same colours give the same map in every pixel format, and luma and CIELAB rows are what the
// formats' definitions say.
#include <algorithm>
#include <utility>

#include "bsm/bsm.h"
#include "check.h"
#include "images.h"
#include "matching.h"

using namespace bsm::test;

namespace {

bsm_config small_config(Rng& rng, bsm_format format, int stage) {
  bsm_config config = config_for(rng.range(1, 40), rng.range(1, 24), format);
  config.bits = 128;
  config.num_disparities = rng.range(1, 12);
  config.stage = stage;
  config.right_map = 1;
  return config;
}

}  // namespace

TEST_CASE(color_formats_agree) {
  Rng rng(seed());
  for (int i = repeats(24); i-- > 0;) {
    bsm_config config = small_config(rng, BSM_FORMAT_RGB24, kStages[i % 4]);
    // Colours that rgb565 holds exactly, so that all five describe the same image.
    const ColorPair colors = to_rgb565_colors(make_pair(rng, kAllContents[i % 6], config.width, config.height));
    const Maps expected = match_frame(config, encode(colors, BSM_FORMAT_RGB24));
    for (const bsm_format format : {BSM_FORMAT_BGR24, BSM_FORMAT_RGBA32, BSM_FORMAT_BGRA32, BSM_FORMAT_RGB565}) {
      config.format = format;
      const Scope scope(describe(config));
      check_same(match_frame(config, encode(colors, format)), expected);
      check_same(match_rows(config, encode(colors, format)), expected);
    }
  }
}

TEST_CASE(channels_are_told_apart) {
  // Red and blue swapped is another image: if a format mixed them up consistently, the case above would not see it.
  Rng rng(seed() + 1);
  bsm_config config = config_for(48, 24);
  config.bits = 256;
  config.num_disparities = 12;
  config.stage = BSM_STAGE_MASKED;
  const EncodedPair pair = encode(make_pair(rng, Content::kNoise, 48, 24), BSM_FORMAT_RGB24);
  const Maps rgb = match_frame(config, pair);
  config.format = BSM_FORMAT_BGR24;
  CHECK(match_frame(config, pair).left != rgb.left);
}

TEST_CASE(gray_equals_equal_channels) {
  Rng rng(seed() + 2);
  for (int i = repeats(24); i-- > 0;) {
    bsm_config config = small_config(rng, BSM_FORMAT_GRAY8, kStages[i % 4]);
    const ColorPair colors = to_gray(make_pair(rng, kAllContents[i % 6], config.width, config.height));
    const Maps gray = match_frame(config, encode(colors, BSM_FORMAT_GRAY8));
    config.format = BSM_FORMAT_RGB24;
    const Scope scope(describe(config));
    check_same(gray, match_frame(config, encode(colors, BSM_FORMAT_RGB24)));
  }
}

// The same image as yuyv: every row with the chroma row that belongs to it.
static PixelImage to_yuyv(const PixelImage& nv12) {
  PixelImage result = nv12;
  result.format = BSM_FORMAT_YUYV;
  result.chroma.clear();
  result.stride = row_bytes(BSM_FORMAT_YUYV, nv12.width);
  result.bytes.assign(static_cast<size_t>(result.stride * nv12.height), 0xee);  // the pixel past an odd width says nothing
  for (int y = 0; y < nv12.height; ++y) {
    uint8_t* out = result.bytes.data() + y * result.stride;
    for (int x = 0; x < nv12.width; ++x) out[2 * x] = nv12.row(y)[x];
    for (int x = 0; x < chroma_row_bytes(nv12.width); ++x) out[2 * x + 1] = nv12.chroma_row(y)[x];
  }
  return result;
}

static PixelImage to_nv21(const PixelImage& nv12) {
  PixelImage result = nv12;
  result.format = BSM_FORMAT_NV21;
  for (size_t i = 0; i + 1 < result.chroma.size(); i += 2) std::swap(result.chroma[i], result.chroma[i + 1]);
  return result;
}

// The plane Y alone.
static PixelImage to_gray8(const PixelImage& nv12) {
  PixelImage result = nv12;
  result.format = BSM_FORMAT_GRAY8;
  result.chroma.clear();
  return result;
}

static EncodedPair convert(const EncodedPair& pair, PixelImage (*function)(const PixelImage&)) {
  return {function(pair.left), function(pair.right)};
}

TEST_CASE(yuv_formats_agree) {
  Rng rng(seed() + 4);
  for (int i = repeats(24); i-- > 0;) {
    bsm_config config = small_config(rng, BSM_FORMAT_NV12, kStages[i % 4]);
    const EncodedPair nv12 = encode(make_pair(rng, kAllContents[i % 6], config.width, config.height), BSM_FORMAT_NV12);
    const Maps expected = match_frame(config, nv12);
    check_same(match_rows(config, nv12), expected);
    for (const bsm_format format : {BSM_FORMAT_NV21, BSM_FORMAT_YUYV}) {
      const auto change = format == BSM_FORMAT_NV21 ? to_nv21 : to_yuyv;
      config.format = format;
      const Scope scope(describe(config));
      check_same(match_frame(config, convert(nv12, change)), expected);
      check_same(match_rows(config, convert(nv12, change)), expected);
    }
  }
}

TEST_CASE(yuv_without_color_equals_gray) {
  Rng rng(seed() + 5);
  for (int i = repeats(24); i-- > 0;) {
    bsm_config config = small_config(rng, BSM_FORMAT_NV12, kStages[i % 4]);
    EncodedPair pair = encode(make_pair(rng, kAllContents[i % 6], config.width, config.height), BSM_FORMAT_NV12);
    // Plain costs compare Y alone, whatever the chroma; with masks it has to be that of gray.
    if (config.stage != BSM_STAGE_COST) {
      for (PixelImage* image : {&pair.left, &pair.right})
        std::fill(image->chroma.begin(), image->chroma.end(), uint8_t{128});
    }
    const Maps color = match_frame(config, pair);
    config.format = BSM_FORMAT_GRAY8;
    const Scope scope(describe(config));
    check_same(color, match_frame(config, convert(pair, to_gray8)));
  }
}

TEST_CASE(chroma_matters_and_u_is_not_v) {
  Rng rng(seed() + 6);
  bsm_config config = config_for(48, 24, BSM_FORMAT_NV12);
  config.bits = 256;
  config.num_disparities = 12;
  config.stage = BSM_STAGE_MASKED;
  const EncodedPair pair = encode(make_pair(rng, Content::kNoise, 48, 24), BSM_FORMAT_NV12);
  const Maps nv12 = match_frame(config, pair);
  config.format = BSM_FORMAT_NV21;
  CHECK(match_frame(config, pair).left != nv12.left);
  config.format = BSM_FORMAT_GRAY8;
  CHECK(match_frame(config, convert(pair, to_gray8)).left != nv12.left);
}

TEST_CASE(alpha_does_not_matter) {
  Rng rng(seed() + 3);
  for (const bsm_format format : {BSM_FORMAT_RGBA32, BSM_FORMAT_BGRA32}) {
    const bsm_config config = small_config(rng, format, BSM_STAGE_REFINED);
    EncodedPair pair = encode(make_pair(rng, Content::kShifted, config.width, config.height), format);
    const Maps expected = match_frame(config, pair);
    for (PixelImage* image : {&pair.left, &pair.right}) {
      for (size_t i = 3; i < image->bytes.size(); i += 4) image->bytes[i] = rng.byte();
    }
    check_same(match_frame(config, pair), expected);
  }
}
