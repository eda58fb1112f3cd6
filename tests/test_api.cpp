// test_api.cpp - the contract of the public calls: every status is produced by the mistake it names, a call that fails
// writes nothing and leaves the context usable, and the small calls answer what the header says.
#include <cstring>
#include <functional>
#include <map>
#include <set>

#include "api_mistakes.h"
#include "bsm/bsm.h"
#include "bsm/bsm.hpp"
#include "check.h"
#include "images.h"
#include "matching.h"

using namespace bsm::test;

namespace {

void check_mistake(const Mistake& mistake, std::set<bsm_status>& seen) {
  const Scope scope(mistake.what);
  World world;
  if (mistake.prepare) mistake.prepare(world);
  const std::vector<uint8_t> before = world.snapshot();
  const bsm_status status = mistake.call(world);
  CHECK_EQ(status, mistake.expected);
  CHECK(world.snapshot() == before);
  seen.insert(status);
  world.check_usable();
}

// Statuses that no call can produce in this build, and why.
std::map<bsm_status, const char*> unreachable_statuses() {
  std::map<bsm_status, const char*> list;
  if (sizeof(size_t) > 4) list[BSM_ERROR_MEMORY_SIZE] = "the largest configuration fits a 64-bit size_t";
  list[BSM_ERROR_ISA] = "this build has scalar kernels";
  return list;
}

}  // namespace

TEST_CASE(every_status_has_a_call_that_produces_it) {
  std::set<bsm_status> seen;
  for (const auto& list : {config_mistakes(), null_mistakes(), use_mistakes()}) {
    for (const Mistake& mistake : list) check_mistake(mistake, seen);
  }
  {
    World world;  // the rest: an arena that is too small, and the three statuses of success
    const std::vector<uint8_t> before = world.snapshot();
    for (const size_t bytes : {size_t{0}, size_t{1}, world.arena.size() / 2, world.arena.size() - 1}) {
      const bsm_status status = bsm_open(&world.config, world.arena.data(), bytes, &world.context_out);
      CHECK_EQ(status, BSM_ERROR_ARENA);
      seen.insert(status);
    }
    CHECK(world.snapshot() == before);
    seen.insert(world.pull());
    CHECK(seen.count(BSM_NEED_ROWS));
    seen.insert(bsm_finish(world.context));
    seen.insert(world.pull());
    CHECK(seen.count(BSM_OK) && seen.count(BSM_END));
    world.check_usable();
  }
  {
    World world;  // rows of a context whose paths need the whole frame
    world.config.method = BSM_METHOD_SGM;
    world.config.paths = 8;
    Arena arena(arena_bytes(world.config));
    bsm_context* whole_frame = nullptr;
    REQUIRE_EQ(bsm_open(&world.config, arena.data(), arena.size(), &whole_frame), BSM_OK);
    const std::vector<uint8_t> before = world.snapshot();
    CHECK_EQ(bsm_push_row(whole_frame, &world.left_row, &world.right_row), BSM_ERROR_ROW_MODE);
    CHECK_EQ(bsm_pull_row(whole_frame, world.left_map.data(), nullptr, nullptr), BSM_ERROR_ROW_MODE);
    CHECK_EQ(bsm_finish(whole_frame), BSM_ERROR_ROW_MODE);
    CHECK_EQ(bsm_row_delay(&world.config, &world.int_out), BSM_ERROR_ROW_MODE);
    seen.insert(bsm_push_row(whole_frame, &world.left_row, &world.right_row));
    CHECK(world.snapshot() == before);
    CHECK_EQ(bsm_process(whole_frame, &world.frame), BSM_OK);  // and it still matches frames
    check_same_map(world.left_map, match_frame(world.config, world.pair).left, World::kWidth, "map of eight paths");
  }
  {
    bsm_config config = config_for(BSM_MAX_SIZE, BSM_MAX_SIZE);  // the largest there is
    config.min_disparity = BSM_MIN_DISPARITY;
    config.num_disparities = BSM_MAX_DISPARITY - BSM_MIN_DISPARITY + 1;
    config.vote_radius = BSM_MAX_VOTE_RADIUS;
    config.right_map = 1;
    config.max_jobs = BSM_MAX_JOBS;
    size_t bytes = 0;
    const bsm_status status = bsm_memory_required_for(&config, 0, &bytes);
    CHECK(status == BSM_OK || (sizeof(size_t) <= 4 && status == BSM_ERROR_MEMORY_SIZE));
    seen.insert(status);
  }
  const auto unreachable = unreachable_statuses();
  for (int value = BSM_ERROR_SIGMA; value <= BSM_END; ++value) {
    const bsm_status status = static_cast<bsm_status>(value);
    const Scope scope("status " + text_of(value));
    if (const auto it = unreachable.find(status); it != unreachable.end()) {
      std::printf("  status %d is not produced here: %s\n", value, it->second);
      CHECK(seen.count(status) == 0);
    } else {
      CHECK(seen.count(status) == 1);
    }
  }
}

TEST_CASE(extremes_of_every_field_are_accepted) {
  const auto accepted = [](const std::function<void(bsm_config&)>& change) {
    bsm_config config = config_for(16, 16);
    change(config);
    const Scope scope(describe(config));
    size_t bytes = 0;
    int32_t delay = 0;
    CHECK_EQ(bsm_memory_required(&config, &bytes), BSM_OK);
    CHECK(bytes > 0);
    CHECK_EQ(bsm_memory_required_for(&config, 0, &bytes), BSM_OK);
    const bool rows = config.method != BSM_METHOD_SGM || config.paths != 8;
    CHECK_EQ(bsm_row_delay(&config, &delay), rows ? BSM_OK : BSM_ERROR_ROW_MODE);
    CHECK(delay >= 0);
  };
  for (const int size : {1, BSM_MAX_SIZE}) {
    accepted([size](bsm_config& c) { c.width = size; });
    accepted([size](bsm_config& c) { c.height = size; });
  }
  for (int bits = BSM_MIN_BITS; bits <= BSM_MAX_BITS; bits += 64) accepted([bits](bsm_config& c) { c.bits = bits; });
  for (const int sigma : {3, 4}) accepted([sigma](bsm_config& c) { c.sigma = sigma; });
  for (const int tolerance : {0, 255}) accepted([tolerance](bsm_config& c) { c.lr_tolerance = tolerance; });
  for (const int radius : {1, BSM_MAX_VOTE_RADIUS}) accepted([radius](bsm_config& c) { c.vote_radius = radius; });
  for (const int divisor : {1, 64}) {
    accepted([divisor](bsm_config& c) { c.vote_color = divisor; });
    accepted([divisor](bsm_config& c) { c.vote_distance = divisor; });
  }
  for (const int jobs : {1, BSM_MAX_JOBS}) accepted([jobs](bsm_config& c) { c.max_jobs = jobs; });
  for (const bsm_format format : kAllFormats) accepted([format](bsm_config& c) { c.format = format; });
  accepted([](bsm_config& c) { c.min_disparity = BSM_MIN_DISPARITY, c.num_disparities = 4094; });
  accepted([](bsm_config& c) { c.min_disparity = BSM_MAX_DISPARITY, c.num_disparities = 1; });
  for (const int paths : {3, 4, 5, 8})
    accepted([paths](bsm_config& c) { c.method = BSM_METHOD_SGM, c.bits = 64, c.paths = paths; });
  accepted([](bsm_config& c) { c.p1 = 1, c.p2 = 16384; });
  accepted([](bsm_config& c) { c.p1 = 16384, c.p2 = 16384; });
  accepted([](bsm_config& c) { c.vote_radius = 32, c.vote_step = 32; });
  accepted([](bsm_config& c) {
    c.smooth_radius = BSM_MAX_SMOOTH_RADIUS, c.smooth_passes = BSM_MAX_SMOOTH_PASSES, c.smooth_distance = 2,
    c.smooth_color = 64;
  });
  accepted([](bsm_config& c) { c.isa_mask = 0; });
}

TEST_CASE(defaults) {
  bsm_config config;
  std::memset(&config, 0x5a, sizeof config);
  REQUIRE_EQ(bsm_config_init(&config, 320, 240), BSM_OK);
  CHECK_EQ(config.struct_size, sizeof(bsm_config));
  CHECK_EQ(config.width, 320);
  CHECK_EQ(config.height, 240);
  CHECK_EQ(config.min_disparity, 0);
  CHECK_EQ(config.num_disparities, 64);
  CHECK_EQ(config.stage, static_cast<int32_t>(BSM_STAGE_REFINED));
  CHECK_EQ(config.format, static_cast<int32_t>(BSM_FORMAT_RGB24));
  CHECK_EQ(config.right_map, 0);
  CHECK_EQ(config.confidence, 0);
  CHECK_EQ(config.max_jobs, 1);
  CHECK_EQ(config.isa_mask, BSM_ISA_ALL);
  for (const uint32_t value : config.reserved) CHECK_EQ(value, 0u);
  bsm_config balanced = config;
  REQUIRE_EQ(bsm_config_preset(&balanced, BSM_PRESET_BALANCED), BSM_OK);
  CHECK(std::memcmp(&config, &balanced, sizeof config) == 0);
  REQUIRE_EQ(bsm_config_preset(&config, BSM_PRESET_PAPER), BSM_OK);
  CHECK_EQ(config.bits, 4096);
  CHECK_EQ(config.median, 1);
  CHECK_EQ(bsm_config_init(&config, -5, 0), BSM_OK);  // sizes are checked later
  size_t bytes = 1;
  CHECK_EQ(bsm_memory_required(&config, &bytes), BSM_ERROR_WIDTH);
}

TEST_CASE(presets_keep_what_is_not_theirs) {
  for (const bsm_preset preset :
       {BSM_PRESET_PAPER, BSM_PRESET_FAST, BSM_PRESET_BALANCED, BSM_PRESET_BEST, BSM_PRESET_LOCAL}) {
    const Scope scope("preset " + text_of(preset));
    bsm_config config = config_for(77, 55, BSM_FORMAT_GRAY8);
    config.min_disparity = -3;
    config.num_disparities = 20;
    config.stage = BSM_STAGE_CHECKED;
    config.right_map = 1;
    config.max_jobs = 5;
    config.isa_mask = 0;
    REQUIRE_EQ(bsm_config_preset(&config, preset), BSM_OK);
    CHECK(config.width == 77 && config.height == 55 && config.format == BSM_FORMAT_GRAY8 && config.min_disparity == -3);
    CHECK(config.num_disparities == 20 && config.stage == BSM_STAGE_CHECKED && config.right_map == 1);
    CHECK(config.max_jobs == 5 && config.isa_mask == 0);
    const bool local = preset == BSM_PRESET_PAPER || preset == BSM_PRESET_LOCAL;
    CHECK_EQ(config.method, static_cast<int32_t>(local ? BSM_METHOD_LOCAL : BSM_METHOD_SGM));
    size_t bytes = 0;
    CHECK_EQ(bsm_memory_required(&config, &bytes), BSM_OK);
  }
}

TEST_CASE(invalid_disparity_is_below_the_range) {
  bsm_config config = config_for(4, 4);
  for (const int least : {BSM_MIN_DISPARITY, -3, 0, 5, BSM_MAX_DISPARITY}) {
    config.min_disparity = least;
    CHECK_EQ(bsm_invalid_disparity(&config), (least - 1) * BSM_DISPARITY_SCALE);
  }
}

TEST_CASE(status_strings_are_sentences_of_their_own) {
  std::set<std::string> sentences;
  for (int value = BSM_ERROR_SIGMA; value <= BSM_END; ++value) {
    const char* text = bsm_status_string(static_cast<bsm_status>(value));
    REQUIRE(text != nullptr);
    const Scope scope("status " + text_of(value) + " '" + text + "'");
    CHECK(std::strlen(text) > 1);
    CHECK(sentences.insert(text).second);
  }
  for (const int value : {BSM_ERROR_SIGMA - 1, BSM_END + 1}) {
    CHECK(bsm_status_string(static_cast<bsm_status>(value)) != nullptr);
  }
}

TEST_CASE(version_and_features) {
  CHECK_EQ(std::string(bsm_version()),
           text_of(BSM_VERSION_MAJOR) + "." + text_of(BSM_VERSION_MINOR) + "." + text_of(BSM_VERSION_PATCH));
  const uint32_t features = bsm_cpu_features();
  for (int32_t bit = 0; bit < 32; ++bit) {
    if (features >> bit & 1) CHECK(bsm_cpu_feature_name(bit) != nullptr);
  }
  for (const int32_t bit : {-1, 32, INT32_MAX, INT32_MIN}) CHECK(bsm_cpu_feature_name(bit) == nullptr);
}

TEST_CASE(kernel_names_follow_the_scheme) {
  const std::map<bsm_kernel, std::string> prefixes = {{BSM_KERNEL_COLOR, "color_"},
                                                      {BSM_KERNEL_DESCRIPTOR, "descriptor_"},
                                                      {BSM_KERNEL_MASK, "mask_"},
                                                      {BSM_KERNEL_MATCH, "match_"},
                                                      {BSM_KERNEL_VOTE, "vote_"}};
  World world;
  bsm_config scalar = world.config;
  scalar.isa_mask = 0;
  Arena arena(arena_bytes(scalar));
  bsm_context* context = nullptr;
  REQUIRE_EQ(bsm_open(&scalar, arena.data(), arena.size(), &context), BSM_OK);
  for (int kernel = 0; kernel < BSM_KERNEL_COUNT; ++kernel) {
    const char* name = bsm_kernel_name(world.context, static_cast<bsm_kernel>(kernel));
    REQUIRE(name != nullptr);
    const auto prefix = prefixes.find(static_cast<bsm_kernel>(kernel));
    if (prefix != prefixes.end()) CHECK_EQ(std::string(name).find(prefix->second), 0u);
    const std::string scalar_name = bsm_kernel_name(context, static_cast<bsm_kernel>(kernel));
    CHECK(scalar_name.size() > 7 && scalar_name.substr(scalar_name.size() - 7) == "_scalar");
  }
  for (const int kernel : {-1, static_cast<int>(BSM_KERNEL_COUNT), 1000}) {
    CHECK(bsm_kernel_name(world.context, enum_of<bsm_kernel>(kernel)) == nullptr);
  }
  CHECK(bsm_kernel_name(nullptr, BSM_KERNEL_COLOR) == nullptr);
  CHECK(bsm_kernel_name(not_a_context(), BSM_KERNEL_COLOR) == nullptr);
}

TEST_CASE(cpp_wrapper_forwards) {
  bsm::Config config(12, 10);
  config.bits = 64;
  config.num_disparities = 4;
  CHECK_EQ(config.validate(), BSM_OK);
  CHECK_EQ(config.memory_required(), arena_bytes(config));
  CHECK_EQ(config.invalid_disparity(), -16);
  Rng rng(seed());
  const EncodedPair pair = encode(make_pair(rng, Content::kShifted, 12, 10), BSM_FORMAT_RGB24);
  const Maps expected = match_frame(config, pair);
  Arena arena(config.memory_required());
  bsm::Matcher matcher;
  CHECK_EQ(matcher.reset(), BSM_ERROR_NULL);  // not open
  REQUIRE_EQ(matcher.open(config, arena.data(), arena.size()), BSM_OK);
  CHECK(matcher.get() != nullptr && matcher.kernel_name(BSM_KERNEL_VOTE) != nullptr);
  std::vector<int16_t> map(120);
  bsm_frame frame{};
  frame.left = bsm::image(pair.left.bytes.data(), pair.left.stride);
  frame.right = bsm::image(pair.right.bytes.data(), pair.right.stride);
  frame.disparity = {map.data(), 24};
  CHECK_EQ(matcher.process(frame), BSM_OK);
  check_same_map(map, expected.left, 12, "map");

  std::vector<int16_t> rows, row(12);
  for (int y = 0; y < 10; ++y) {
    CHECK_EQ(matcher.push_row(bsm::row(pair.left.row(y)), bsm::row(pair.right.row(y))), BSM_OK);
    if (y >= config.row_delay()) {
      CHECK_EQ(matcher.pull_row(row.data()), BSM_OK);
      rows.insert(rows.end(), row.begin(), row.end());
    }
  }
  CHECK_EQ(matcher.finish(), BSM_OK);
  while (matcher.pull_row(row.data()) == BSM_OK) rows.insert(rows.end(), row.begin(), row.end());
  check_same_map(rows, expected.left, 12, "rows");

  bsm::Config wrong(0, 10);
  CHECK_EQ(wrong.validate(), BSM_ERROR_WIDTH);
  CHECK_EQ(wrong.memory_required(), 0u);
  CHECK_EQ(wrong.row_delay(), static_cast<int32_t>(BSM_ERROR_WIDTH));
}
