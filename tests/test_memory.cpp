// test_memory.cpp - the arena: sizes held to their targets, any alignment, any contents, and no byte less.
#include <cstdio>

#include "bsm/bsm.h"
#include "check.h"
#include "images.h"
#include "matching.h"

using namespace bsm::test;

namespace {

// What the size targets are stated for: the scalar kernels, one job, no right map.
bsm_config target_config(int width, int height, int disparities, int bits, bsm_format format) {
  bsm_config config = config_for(width, height, format);
  config.num_disparities = disparities;
  config.bits = bits;
  config.isa_mask = 0;
  return config;
}

size_t scalar_bytes(const bsm_config& config) {
  size_t bytes = 0;
  REQUIRE_EQ(bsm_memory_required_for(&config, 0, &bytes), BSM_OK);
  return bytes;
}

}  // namespace

TEST_CASE(size_targets) {
  const bsm_config teddy = target_config(450, 375, 60, 4096, BSM_FORMAT_RGB24);
  const bsm_config small = target_config(160, 120, 32, 256, BSM_FORMAT_RGB24);
  const bsm_config small_gray = target_config(160, 120, 32, 256, BSM_FORMAT_GRAY8);
  std::printf("  450x375 rgb24, 60 disparities, 4096 bits: %zu bytes\n", scalar_bytes(teddy));
  std::printf("  160x120 rgb24, 32 disparities,  256 bits: %zu bytes\n", scalar_bytes(small));
  std::printf("  160x120 gray8, 32 disparities,  256 bits: %zu bytes\n", scalar_bytes(small_gray));
  std::printf("  (scalar kernels, one job, no right map, refined stage)\n");
  CHECK_LE(scalar_bytes(teddy), size_t{2} * 1024 * 1024);
  CHECK_LE(scalar_bytes(small), size_t{128} * 1024);
  CHECK(scalar_bytes(small_gray) < scalar_bytes(small));
}

TEST_CASE(size_does_not_grow_with_height) {
  for (const bsm_preset preset : {BSM_PRESET_PAPER, BSM_PRESET_FAST, BSM_PRESET_BALANCED, BSM_PRESET_LOCAL}) {
    for (const bsm_format format : {BSM_FORMAT_RGB24, BSM_FORMAT_GRAY8}) {
      for (const bsm_stage stage : kStages) {
        bsm_config low = target_config(320, 100, 48, 512, format);
        REQUIRE_EQ(bsm_config_preset(&low, preset), BSM_OK);
        low.stage = stage;
        bsm_config high = low;
        high.height = 10000;
        const Scope scope(describe(low));
        CHECK_EQ(scalar_bytes(low), scalar_bytes(high));
        CHECK_EQ(arena_bytes(low), arena_bytes(high));
      }
    }
  }
  bsm_config low = target_config(320, 100, 48, 512, BSM_FORMAT_RGB24);  // only eight paths keep the frame
  REQUIRE_EQ(bsm_config_preset(&low, BSM_PRESET_BEST), BSM_OK);
  bsm_config high = low;
  high.height = 200;
  CHECK(scalar_bytes(high) > scalar_bytes(low));
}

TEST_CASE(size_grows_with_what_needs_memory) {
  const bsm_config base = target_config(200, 100, 32, 256, BSM_FORMAT_RGB24);
  const auto grows = [&base](void (*change)(bsm_config&)) {
    bsm_config config = base;
    change(config);
    const Scope scope(describe(config));
    CHECK(scalar_bytes(config) > scalar_bytes(base));
  };
  grows([](bsm_config& c) { c.width = 400; });
  grows([](bsm_config& c) { c.bits = 512; });
  grows([](bsm_config& c) { c.right_map = 1; });
  grows([](bsm_config& c) { c.max_jobs = 2; });
}

TEST_CASE(scalar_size_is_the_size_without_features) {
  Rng rng(seed());
  for (int i = 0; i < 20; ++i) {
    bsm_config config = any_config(rng, rng.range(1, 2000), rng.range(1, 2000));
    config.isa_mask = 0;
    const Scope scope(describe(config));
    CHECK_EQ(scalar_bytes(config), arena_bytes(config));
    size_t bytes = 0;
    CHECK_EQ(bsm_memory_required_for(&config, bsm_cpu_features(), &bytes), BSM_OK);
    CHECK_EQ(bytes, arena_bytes(config));
  }
}

TEST_CASE(any_alignment_works) {
  Rng rng(seed() + 1);
  for (int i = repeats(12); i-- > 0;) {
    const bsm_config config = any_config(rng, rng.range(1, 40), rng.range(1, 40));
    const Scope scope(describe(config));
    const EncodedPair pair =
        encode(make_pair(rng, Content::kShifted, config.width, config.height), static_cast<bsm_format>(config.format));
    const Maps expected = match_frame(config, pair);
    for (size_t misalignment = 0; misalignment < 64; misalignment += misalignment == 0 || rng.one_in(2) ? 1 : 7) {
      const Scope offset("arena " + text_of(misalignment) + " bytes past a multiple of 64");
      Arena arena(arena_bytes(config), misalignment);
      bsm_context* context = nullptr;
      REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
      CHECK(reinterpret_cast<uintptr_t>(context) >= reinterpret_cast<uintptr_t>(arena.data()));
      check_same(stream_rows(context, config, pair), expected);
    }
  }
}

TEST_CASE(one_byte_less_is_refused) {
  Rng rng(seed() + 2);
  for (int i = 0; i < 40; ++i) {
    const bsm_config config = any_config(rng, rng.range(1, 200), rng.range(1, 200));
    const Scope scope(describe(config));
    Arena arena(arena_bytes(config), static_cast<size_t>(rng.range(0, 63)));
    bsm_context* context = nullptr;
    CHECK_EQ(bsm_open(&config, arena.data(), arena.size() - 1, &context), BSM_ERROR_ARENA);
    CHECK(context == nullptr);
    CHECK_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
    CHECK_EQ(bsm_open(&config, arena.data(), arena.size() + 1, &context), BSM_OK);
  }
}

TEST_CASE(old_arena_contents_do_not_matter) {
  Rng rng(seed() + 3);
  for (int i = repeats(20); i-- > 0;) {
    const bsm_config config = any_config(rng, rng.range(1, 40), rng.range(1, 40));
    const Scope scope(describe(config));
    const EncodedPair pair =
        encode(make_pair(rng, Content::kShifted, config.width, config.height), static_cast<bsm_format>(config.format));
    Maps maps[3];
    for (int fill = 0; fill < 3; ++fill) {
      Arena arena(arena_bytes(config));
      uint8_t* bytes = static_cast<uint8_t*>(arena.data());
      for (size_t b = 0; b < arena.size(); ++b) bytes[b] = fill == 0 ? 0 : fill == 1 ? 0xff : rng.byte();
      bsm_context* context = nullptr;
      REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
      maps[fill] = stream_rows(context, config, pair);
    }
    check_same(maps[1], maps[0]);
    check_same(maps[2], maps[0]);
  }
}
