// test_golden.cpp - hashes of the synthetic scene's maps and of what they rest on. One value for every machine, compiler,
// kernel and number of jobs; `--print` prints the table for a change of the algorithm that is meant.
#include <algorithm>
#include <cstdio>
#include <string>

#include "bsm/bsm.h"
#include "check.h"
#include "core/pattern.h"
#include "hash.h"
#include "host/scene_frame.h"
#include "images.h"
#include "matching.h"
#include "simd/kernels.h"
#include "simd/lab.h"

using namespace bsm::test;

namespace {

struct Golden {
  const char* name;
  uint64_t hash;
};

constexpr Golden kGolden[] = {
#include "golden.inc"
};

std::string hex(uint64_t hash) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%016llxu", static_cast<unsigned long long>(hash));
  return text;
}

void check_golden(const std::string& name, uint64_t hash) {
  if (printing()) {
    std::printf("{\"%s\", %s},\n", name.c_str(), hex(hash).c_str());
    return;
  }
  const auto* golden =
      std::find_if(std::begin(kGolden), std::end(kGolden), [&name](const Golden& g) { return name == g.name; });
  const Scope scope(name);
  REQUIRE(golden != std::end(kGolden));
  CHECK_EQ(hex(hash), hex(golden->hash));
}

constexpr int kWidth = 160, kHeight = 120, kDisparities = 32;

ColorPair scene(int min_disparity) {
  bsm::host::SceneOptions options;
  options.width = kWidth;
  options.height = kHeight;
  options.min_disparity = min_disparity;
  options.num_disparities = kDisparities;
  const bsm::host::Scene rendered = bsm::host::render_scene(options);
  ColorPair pair{ColorImage(kWidth, kHeight), ColorImage(kWidth, kHeight)};
  pair.left.rgb = rendered.left.pixels;
  pair.right.rgb = rendered.right.pixels;
  return pair;
}

bsm_config scene_config(int bits, bsm_format format, int min_disparity) {
  bsm_config config = config_for(kWidth, kHeight, format);
  config.bits = bits;
  config.min_disparity = min_disparity;
  config.num_disparities = kDisparities;
  config.right_map = 1;
  return config;
}

void check_maps(const std::string& name, const bsm_config& config, const EncodedPair& pair) {
  const Maps maps = match_frame(config, pair);
  Hash left, right;
  left.add_all(maps.left);
  right.add_all(maps.right);
  check_golden(name + " left", left.value());
  check_golden(name + " right", right.value());
  if (config.confidence == 0) return;
  Hash confidence;
  confidence.add_all(maps.confidence);
  check_golden(name + " confidence", confidence.value());
}

}  // namespace

TEST_CASE(scene_bytes) {
  for (const int min_disparity : {0, -16}) {
    const ColorPair pair = scene(min_disparity);
    Hash hash;
    hash.add_all(pair.left.rgb);
    hash.add_all(pair.right.rgb);
    check_golden("scene from " + text_of(min_disparity), hash.value());
  }
}

TEST_CASE(pattern_bytes) {
  std::vector<bsm::PixelPair> pairs(BSM_MAX_BITS);
  const bsm::Pattern pattern = bsm::local_pattern(BSM_MAX_BITS, pairs.data());
  Hash hash;
  for (int i = 0; i < pattern.bits; ++i) {
    for (const int8_t v : {pattern.pairs[i].px, pattern.pairs[i].py, pattern.pairs[i].qx, pattern.pairs[i].qy}) {
      hash.add(static_cast<uint8_t>(v));
    }
  }
  check_golden("pattern", hash.value());
}

TEST_CASE(color_bytes) {
  Hash hash;
  for (int r = 0; r < 256; r += 5) {
    for (int g = 0; g < 256; g += 5) {
      for (int b = 0; b < 256; b += 5) {
        const bsm::Lab lab = bsm::lab_from_rgb(static_cast<uint8_t>(r), static_cast<uint8_t>(g), static_cast<uint8_t>(b));
        for (const uint8_t v : {lab.l, lab.a, lab.b}) hash.add(v);
      }
    }
  }
  check_golden("lab", hash.value());
}

// Descriptor bytes of one row: the byte layout is part of the contract, also on big-endian machines.
TEST_CASE(descriptor_bytes) {
  std::vector<bsm::PixelPair> pairs(320);
  const bsm::Pattern pattern = bsm::local_pattern(320, pairs.data());
  const bsm::Kernels kernels = bsm::select_kernels(0);
  constexpr int kRowWidth = 50;
  const int pad = pattern.radius, rows = 2 * pattern.radius + 1, stride = kRowWidth + 2 * pad;
  std::vector<uint16_t> luma(static_cast<size_t>(rows * stride));
  for (size_t i = 0; i < luma.size(); ++i) luma[i] = static_cast<uint16_t>(i * 40503 >> 3);
  std::vector<const uint16_t*> row_pointers;
  for (int y = 0; y < rows; ++y) row_pointers.push_back(luma.data() + y * stride + pad);
  std::vector<uint8_t> memory(static_cast<size_t>(kRowWidth * pattern.bits / 8) + 64, 0);
  const bsm::KernelShape shape{kRowWidth, pattern.bits, pattern.radius, 3, 1};
  std::vector<uint8_t> scratch(static_cast<size_t>(bsm::kernel_scratch_bytes(kernels, shape, false)) + 64);
  const auto aligned = [](std::vector<uint8_t>& bytes) {
    return bytes.data() + (64 - reinterpret_cast<uintptr_t>(bytes.data()) % 64) % 64;
  };
  uint8_t* out = aligned(memory);
  kernels.descriptor_compare(bsm::DescriptorCompareArgs{row_pointers.data(), kRowWidth, pattern, out, aligned(scratch)});
  // Bit i of a descriptor is bit i % 8 of byte i / 8.
  for (int x = 0; x < kRowWidth; ++x) {
    for (int i = 0; i < pattern.bits; ++i) {
      const bsm::PixelPair& pair = pattern.pairs[i];
      const bool expected = row_pointers[static_cast<size_t>(pad + pair.py)][x + pair.px] >
                            row_pointers[static_cast<size_t>(pad + pair.qy)][x + pair.qx];
      CHECK_EQ((out[x * pattern.bits / 8 + i / 8] >> (i % 8) & 1) != 0, expected);
    }
  }
  Hash hash;
  for (int i = 0; i < kRowWidth * pattern.bits / 8; ++i) hash.add(out[i]);
  check_golden("descriptors", hash.value());
}

TEST_CASE(every_stage) {
  const ColorPair colors = scene(0);
  for (const int bits : {64, 256, 1024}) {
    for (const bsm_format format : {BSM_FORMAT_RGB24, BSM_FORMAT_GRAY8}) {
      for (const bsm_stage stage : kStages) {
        bsm_config config = scene_config(bits, format, 0);
        config.stage = stage;
        check_maps(text_of(bits) + " " + format_name(format) + " " + stage_name(stage), config, encode(colors, format));
      }
    }
  }
}

TEST_CASE(full_length) {
  check_maps("4096 rgb24 refined", scene_config(4096, BSM_FORMAT_RGB24, 0), encode(scene(0), BSM_FORMAT_RGB24));
}

TEST_CASE(other_parameters) {
  bsm_config config = scene_config(256, BSM_FORMAT_RGB24, -16);
  check_maps("256 from -16", config, encode(scene(-16), BSM_FORMAT_RGB24));
  const EncodedPair pair = encode(scene(0), BSM_FORMAT_RGB24);
  config = scene_config(256, BSM_FORMAT_RGB24, 0);
  config.median = 0;
  check_maps("256 without median", config, pair);
  config.lr_tolerance = 0;
  config.vote_radius = 9;
  config.vote_color = 4;
  config.vote_distance = 30;
  check_maps("256 other vote", config, pair);
  check_maps("256 rgb565", scene_config(256, BSM_FORMAT_RGB565, 0), encode(scene(0), BSM_FORMAT_RGB565));
}

TEST_CASE(yuv_formats) {
  for (const bsm_format format : kYuvFormats) {
    check_maps(std::string("256 ") + format_name(format), scene_config(256, format, 0), encode(scene(0), format));
    bsm_config config = scene_config(128, format, 0);
    REQUIRE_EQ(bsm_config_preset(&config, BSM_PRESET_FAST), BSM_OK);
    check_maps(std::string("fast ") + format_name(format), config, encode(scene(0), format));
  }
}

TEST_CASE(presets) {
  const struct {
    const char* name;
    bsm_preset preset;
  } presets[] = {{"fast", BSM_PRESET_FAST}, {"balanced", BSM_PRESET_BALANCED}, {"best", BSM_PRESET_BEST}};
  const ColorPair colors = scene(0);
  for (const auto& preset : presets) {
    for (const bsm_format format : {BSM_FORMAT_RGB24, BSM_FORMAT_GRAY8}) {
      for (const bsm_stage stage : {BSM_STAGE_AGGREGATED, BSM_STAGE_REFINED}) {
        bsm_config config = scene_config(64, format, 0);
        REQUIRE_EQ(bsm_config_preset(&config, preset.preset), BSM_OK);
        config.stage = stage;
        config.confidence = 1;
        check_maps(std::string(preset.name) + " " + format_name(format) + " " + stage_name(stage), config,
                   encode(colors, format));
      }
    }
  }
}

// What a microcontroller of 192 KB matches.
TEST_CASE(small_memory) {
  bsm_config config = scene_config(64, BSM_FORMAT_GRAY8, 0);
  REQUIRE_EQ(bsm_config_preset(&config, BSM_PRESET_FAST), BSM_OK);
  config.speckle = 0;
  check_maps("fast gray8 without speckle filter", config, encode(scene(0), BSM_FORMAT_GRAY8));
}

TEST_CASE(local_preset) {
  for (const bsm_format format : {BSM_FORMAT_RGB24, BSM_FORMAT_GRAY8}) {
    bsm_config config = scene_config(64, format, 0);
    REQUIRE_EQ(bsm_config_preset(&config, BSM_PRESET_LOCAL), BSM_OK);
    config.confidence = 1;
    check_maps(std::string("local ") + format_name(format) + " refined", config, encode(scene(0), format));
  }
}

TEST_CASE(jobs_rows_and_kernels_have_the_same_hash) {
  const EncodedPair pair = encode(scene(0), BSM_FORMAT_RGB24);
  std::vector<uint32_t> masks = isa_masks();
  masks.pop_back();  // the best kernels give what is expected
  for (const bsm_preset preset : {BSM_PRESET_PAPER, BSM_PRESET_FAST, BSM_PRESET_BEST, BSM_PRESET_LOCAL}) {
    bsm_config config = scene_config(256, BSM_FORMAT_RGB24, 0);
    REQUIRE_EQ(bsm_config_preset(&config, preset), BSM_OK);
    config.bits = 256;
    const Maps expected = match_frame(config, pair);
    if (preset != BSM_PRESET_BEST) check_same(match_rows(config, pair), expected);
    config.max_jobs = 3;
    check_same(match_frame(config, pair, Jobs::kThreads), expected);
    config.max_jobs = 1;
    for (const uint32_t isa_mask : masks) {
      config.isa_mask = isa_mask;
      const Scope scope(describe(config));
      check_same(match_frame(config, pair), expected);
    }
  }
}
