// test_api.cpp - the contract of the public calls: every status is produced by the mistake it names, a call that fails
// writes nothing and leaves the context usable, and the small calls answer what the header says.
#include <algorithm>
#include <cstring>
#include <functional>
#include <map>
#include <set>

#include "bsm/bsm.h"
#include "bsm/bsm.hpp"
#include "check.h"
#include "images.h"
#include "matching.h"

using namespace bsm::test;

namespace {

// Everything a call could write to, filled with noise. Calls that fail must leave every byte of it alone.
struct World {
  static constexpr int kWidth = 16, kHeight = 20;

  World() : config(make_config()), arena(arena_bytes(config), 24) {
    Rng rng(seed());
    pair = encode(make_pair(rng, Content::kShifted, kWidth, kHeight), BSM_FORMAT_RGB24);
    std::fill_n(static_cast<uint8_t*>(arena.data()), arena.size(), uint8_t{0});
    REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
    left_map.assign(static_cast<size_t>(kWidth) * kHeight, kUnwritten);
    right_map_values = left_map;
    frame.left = pair.left.view();
    frame.right = pair.right.view();
    frame.disparity = {left_map.data(), kWidth * 2};
    left_row = {{pair.left.row(0), nullptr}};
    right_row = {{pair.right.row(0), nullptr}};
  }

  static bsm_config make_config() {
    bsm_config c = config_for(kWidth, kHeight);
    c.bits = 64;
    c.num_disparities = 4;
    c.vote_radius = 3;
    return c;
  }

  // Bytes of all that the caller owns and that a failing call may not change.
  std::vector<uint8_t> snapshot() {
    std::vector<uint8_t> bytes;
    const auto add = [&bytes](const void* data, size_t size) {
      const uint8_t* begin = static_cast<const uint8_t*>(data);
      bytes.insert(bytes.end(), begin, begin + size);
    };
    add(arena.data(), arena.size());
    add(left_map.data(), left_map.size() * 2);
    add(right_map_values.data(), right_map_values.size() * 2);
    add(confidence.data(), confidence.size());
    add(&config, sizeof config);
    add(&frame, sizeof frame);
    add(pair.left.bytes.data(), pair.left.bytes.size());
    add(pair.right.bytes.data(), pair.right.bytes.size());
    add(&size_out, sizeof size_out);
    add(&int_out, sizeof int_out);
    add(&context_out, sizeof context_out);
    return bytes;
  }

  bsm_status push() { return bsm_push_row(context, &left_row, &right_row); }
  bsm_status pull() { return bsm_pull_row(context, left_map.data(), nullptr, nullptr); }

  // The context still does its work after whatever happened: rows and a frame.
  void check_usable() {
    const bsm_config fresh = make_config();
    const Maps expected = match_frame(fresh, pair);
    CHECK_EQ(bsm_reset(context), BSM_OK);
    check_same(stream_rows(context, fresh, pair), expected);
    CHECK_EQ(bsm_reset(context), BSM_OK);
    bsm_frame good{};
    good.left = pair.left.view();
    good.right = pair.right.view();
    good.disparity = {left_map.data(), kWidth * 2};
    CHECK_EQ(bsm_process(context, &good), BSM_OK);
    check_same_map(left_map, expected.left, kWidth, "left map after an error");
  }

  bsm_config config;
  Arena arena;
  EncodedPair pair;
  bsm_context* context = nullptr;
  std::vector<int16_t> left_map, right_map_values;
  std::vector<uint8_t> confidence = std::vector<uint8_t>(size_t{kWidth} * kHeight, 0x5a);
  bsm_frame frame{};
  bsm_row left_row{}, right_row{};
  size_t size_out = 0x1234567;
  int32_t int_out = 0x7654321;
  bsm_context* context_out = reinterpret_cast<bsm_context*>(&size_out);
};

using Action = std::function<bsm_status(World&)>;

// A call that has to fail. `prepare` runs before the snapshot.
struct Mistake {
  const char* what;
  bsm_status expected;
  Action call;
  std::function<void(World&)> prepare;
};

// Every function that takes a configuration, with `change` applied to a valid one.
void add_config_mistakes(std::vector<Mistake>& list, const char* what, bsm_status expected,
                         const std::function<void(bsm_config&)>& change) {
  const auto prepare = [change](World& w) { change(w.config); };
  list.push_back({what, expected, [](World& w) { return bsm_memory_required(&w.config, &w.size_out); }, prepare});
  list.push_back({what, expected, [](World& w) { return bsm_memory_required_for(&w.config, 0, &w.size_out); }, prepare});
  list.push_back({what, expected, [](World& w) { return bsm_row_delay(&w.config, &w.int_out); }, prepare});
  list.push_back({what, expected,
                  [](World& w) {
                    // A second arena: the context under test lives in the first.
                    std::vector<uint8_t> memory(size_t{1} << 20, uint8_t{0x3c});
                    const bsm_status status = bsm_open(&w.config, memory.data(), memory.size(), &w.context_out);
                    CHECK(std::count(memory.begin(), memory.end(), uint8_t{0x3c}) == static_cast<ptrdiff_t>(memory.size()));
                    return status;
                  },
                  prepare});
}

void add_field_mistakes(std::vector<Mistake>& list, const char* what, bsm_status expected, int32_t bsm_config::*field,
                        std::initializer_list<int32_t> values) {
  for (const int32_t value : values) {
    add_config_mistakes(list, what, expected, [field, value](bsm_config& c) { c.*field = value; });
  }
}

constexpr int32_t kMost = INT32_MAX, kLeast = INT32_MIN;

std::vector<Mistake> config_mistakes() {
  std::vector<Mistake> list;
  for (const uint32_t size :
       {0u, 1u, static_cast<uint32_t>(sizeof(bsm_config)) - 4, static_cast<uint32_t>(sizeof(bsm_config)) + 4}) {
    add_config_mistakes(list, "struct_size", BSM_ERROR_STRUCT_SIZE, [size](bsm_config& c) { c.struct_size = size; });
  }
  for (size_t i = 0; i < std::size(bsm_config{}.reserved); ++i) {
    add_config_mistakes(list, "reserved", BSM_ERROR_RESERVED, [i](bsm_config& c) { c.reserved[i] = 1; });
  }
  add_field_mistakes(list, "width", BSM_ERROR_WIDTH, &bsm_config::width, {0, -1, BSM_MAX_SIZE + 1, kMost, kLeast});
  add_field_mistakes(list, "height", BSM_ERROR_HEIGHT, &bsm_config::height, {0, -1, BSM_MAX_SIZE + 1, kMost, kLeast});
  add_field_mistakes(list, "min_disparity", BSM_ERROR_MIN_DISPARITY, &bsm_config::min_disparity,
                     {BSM_MIN_DISPARITY - 1, BSM_MAX_DISPARITY + 1, kMost, kLeast});
  add_field_mistakes(list, "num_disparities", BSM_ERROR_NUM_DISPARITIES, &bsm_config::num_disparities,
                     {0, -1, BSM_MAX_DISPARITY + 2, kMost, kLeast});
  add_config_mistakes(list, "largest disparity", BSM_ERROR_NUM_DISPARITIES, [](bsm_config& c) {
    c.min_disparity = BSM_MAX_DISPARITY;
    c.num_disparities = 2;
  });
  add_config_mistakes(list, "largest disparity", BSM_ERROR_NUM_DISPARITIES, [](bsm_config& c) {
    c.min_disparity = BSM_MIN_DISPARITY;
    c.num_disparities = BSM_MAX_DISPARITY - BSM_MIN_DISPARITY + 2;
  });
  add_field_mistakes(list, "bits", BSM_ERROR_BITS, &bsm_config::bits,
                     {0, -64, 63, 65, 96, 4032 + 1, 4096 + 64, kMost, kLeast});
  add_config_mistakes(list, "bits of sgm", BSM_ERROR_BITS, [](bsm_config& c) {
    c.method = BSM_METHOD_SGM;
    c.bits = BSM_MAX_SGM_BITS + 64;
  });
  add_field_mistakes(list, "sigma", BSM_ERROR_SIGMA, &bsm_config::sigma, {2, 5, 0, -3, kMost, kLeast});
  add_field_mistakes(list, "method", BSM_ERROR_METHOD, &bsm_config::method, {-1, 1000, kMost, kLeast});
  add_field_mistakes(list, "stage", BSM_ERROR_STAGE, &bsm_config::stage, {-1, BSM_STAGE_AGGREGATED, 1000, kMost, kLeast});
  add_field_mistakes(list, "format", BSM_ERROR_FORMAT, &bsm_config::format, {-1, 1000, kMost, kLeast});
  add_field_mistakes(list, "paths", BSM_ERROR_PATHS, &bsm_config::paths, {0, 1, 2, 6, 7, 9, -4, kMost, kLeast});
  add_field_mistakes(list, "p1", BSM_ERROR_PENALTY, &bsm_config::p1, {0, -1, 16385, kMost, kLeast});
  add_field_mistakes(list, "p2", BSM_ERROR_PENALTY, &bsm_config::p2, {0, -1, 16385, kMost, kLeast});
  add_config_mistakes(list, "p1 above p2", BSM_ERROR_PENALTY, [](bsm_config& c) { c.p1 = c.p2 + 1; });
  add_field_mistakes(list, "edge_threshold", BSM_ERROR_EDGE, &bsm_config::edge_threshold, {0, -1, 256, kMost, kLeast});
  add_field_mistakes(list, "edge_divisor", BSM_ERROR_EDGE, &bsm_config::edge_divisor, {0, -1, 65, kMost, kLeast});
  add_field_mistakes(list, "right_costs", BSM_ERROR_RIGHT_COSTS, &bsm_config::right_costs, {-1, 2, kMost, kLeast});
  add_field_mistakes(list, "subpixel", BSM_ERROR_SUBPIXEL, &bsm_config::subpixel, {-1, 2, kMost, kLeast});
  add_field_mistakes(list, "lr_tolerance", BSM_ERROR_TOLERANCE, &bsm_config::lr_tolerance, {-1, 256, kMost, kLeast});
  add_field_mistakes(list, "speckle", BSM_ERROR_SPECKLE, &bsm_config::speckle, {-1, 101, kMost, kLeast});
  add_field_mistakes(list, "border", BSM_ERROR_BORDER, &bsm_config::border, {-1, 2, kMost, kLeast});
  add_field_mistakes(list, "vote_radius", BSM_ERROR_VOTE_RADIUS, &bsm_config::vote_radius,
                     {0, -1, BSM_MAX_VOTE_RADIUS + 1, kMost, kLeast});
  add_field_mistakes(list, "vote_step", BSM_ERROR_VOTE_STEP, &bsm_config::vote_step,
                     {0, -1, 2, 4, kMost, kLeast});  // radius 3
  add_field_mistakes(list, "vote_color", BSM_ERROR_VOTE_COLOR, &bsm_config::vote_color, {0, -1, 65, kMost, kLeast});
  add_field_mistakes(list, "vote_distance", BSM_ERROR_VOTE_DISTANCE, &bsm_config::vote_distance, {0, -1, 65, kMost, kLeast});
  add_field_mistakes(list, "vote_cap", BSM_ERROR_VOTE_CAP, &bsm_config::vote_cap, {-1, 2, kMost, kLeast});
  add_field_mistakes(list, "smooth_radius", BSM_ERROR_SMOOTH_RADIUS, &bsm_config::smooth_radius,
                     {0, -1, BSM_MAX_SMOOTH_RADIUS + 1, kMost, kLeast});
  add_field_mistakes(list, "smooth_passes", BSM_ERROR_SMOOTH_PASSES, &bsm_config::smooth_passes,
                     {-1, BSM_MAX_SMOOTH_PASSES + 1, kMost, kLeast});
  add_field_mistakes(list, "smooth_color", BSM_ERROR_SMOOTH_COLOR, &bsm_config::smooth_color, {0, -1, 65, kMost, kLeast});
  add_field_mistakes(list, "smooth_distance", BSM_ERROR_SMOOTH_DISTANCE, &bsm_config::smooth_distance,
                     {1, 0, -1, 65, kMost, kLeast});
  add_field_mistakes(list, "median", BSM_ERROR_MEDIAN, &bsm_config::median, {-1, 2, kMost, kLeast});
  add_field_mistakes(list, "confidence", BSM_ERROR_CONFIDENCE, &bsm_config::confidence, {-1, 2, kMost, kLeast});
  add_field_mistakes(list, "right_map", BSM_ERROR_RIGHT_MAP, &bsm_config::right_map, {-1, 2, kMost, kLeast});
  add_field_mistakes(list, "max_jobs", BSM_ERROR_JOBS, &bsm_config::max_jobs, {0, -1, BSM_MAX_JOBS + 1, kMost, kLeast});
  return list;
}

std::vector<Mistake> null_mistakes() {
  const bsm_status expected = BSM_ERROR_NULL;
  std::vector<Mistake> list = {
      {"bsm_config_init(null)", expected, [](World&) { return bsm_config_init(nullptr, 4, 4); }, {}},
      {"bsm_config_preset(null, )", expected, [](World&) { return bsm_config_preset(nullptr, BSM_PRESET_FAST); }, {}},
      {"bsm_memory_required(null, )", expected, [](World& w) { return bsm_memory_required(nullptr, &w.size_out); }, {}},
      {"bsm_memory_required(, null)", expected, [](World& w) { return bsm_memory_required(&w.config, nullptr); }, {}},
      {"bsm_memory_required_for(null, )",
       expected,
       [](World& w) { return bsm_memory_required_for(nullptr, 0, &w.size_out); },
       {}},
      {"bsm_memory_required_for(, null)",
       expected,
       [](World& w) { return bsm_memory_required_for(&w.config, 0, nullptr); },
       {}},
      {"bsm_row_delay(null, )", expected, [](World& w) { return bsm_row_delay(nullptr, &w.int_out); }, {}},
      {"bsm_row_delay(, null)", expected, [](World& w) { return bsm_row_delay(&w.config, nullptr); }, {}},
      {"bsm_open(null config)",
       expected,
       [](World& w) { return bsm_open(nullptr, w.arena.data(), w.arena.size(), &w.context_out); },
       {}},
      {"bsm_open(null arena)",
       expected,
       [](World& w) { return bsm_open(&w.config, nullptr, w.arena.size(), &w.context_out); },
       {}},
      {"bsm_open(null context)",
       expected,
       [](World& w) { return bsm_open(&w.config, w.arena.data(), w.arena.size(), nullptr); },
       {}},
      {"bsm_process(null, )", expected, [](World& w) { return bsm_process(nullptr, &w.frame); }, {}},
      {"bsm_process(, null)", expected, [](World& w) { return bsm_process(w.context, nullptr); }, {}},
      {"bsm_process(no left image)", expected, [](World& w) { return bsm_process(w.context, &w.frame); },
       [](World& w) { w.frame.left.plane[0] = nullptr; }},
      {"bsm_process(no right image)", expected, [](World& w) { return bsm_process(w.context, &w.frame); },
       [](World& w) { w.frame.right.plane[0] = nullptr; }},
      {"bsm_process(no map)", expected, [](World& w) { return bsm_process(w.context, &w.frame); },
       [](World& w) { w.frame.disparity.data = nullptr; }},
      {"bsm_push_row(null context)",
       expected,
       [](World& w) { return bsm_push_row(nullptr, &w.left_row, &w.right_row); },
       {}},
      {"bsm_push_row(null left)", expected, [](World& w) { return bsm_push_row(w.context, nullptr, &w.right_row); }, {}},
      {"bsm_push_row(null right)", expected, [](World& w) { return bsm_push_row(w.context, &w.left_row, nullptr); }, {}},
      {"bsm_push_row(null left plane)", expected, [](World& w) { return w.push(); },
       [](World& w) { w.left_row.plane[0] = nullptr; }},
      {"bsm_push_row(null right plane)", expected, [](World& w) { return w.push(); },
       [](World& w) { w.right_row.plane[0] = nullptr; }},
      {"bsm_pull_row(null context)",
       expected,
       [](World& w) { return bsm_pull_row(nullptr, w.left_map.data(), nullptr, nullptr); },
       {}},
      {"bsm_pull_row(null map)", expected, [](World& w) { return bsm_pull_row(w.context, nullptr, nullptr, nullptr); }, {}},
      {"bsm_finish(null)", expected, [](World&) { return bsm_finish(nullptr); }, {}},
      {"bsm_reset(null)", expected, [](World&) { return bsm_reset(nullptr); }, {}},
  };
  return list;
}

// Any number as a value of a C enumeration, as a C caller may pass it.
template <typename Enum>
Enum enum_of(int value) {
  static_assert(sizeof(Enum) == sizeof(int));
  Enum result;
  std::memcpy(&result, &value, sizeof result);
  return result;
}

// Memory that no bsm_open made into a context.
bsm_context* not_a_context() {
  alignas(64) static uint8_t memory[4096] = {};
  return reinterpret_cast<bsm_context*>(memory);
}

// A context for images with a chroma plane, of odd width and height. Every stride is the shortest that is allowed.
struct ChromaWorld {
  static constexpr int kWidth = 15, kHeight = 5;
  explicit ChromaWorld(bsm_format format) {
    config = config_for(kWidth, kHeight, format);
    config.bits = 64;
    config.num_disparities = 4;
    Rng rng(seed());
    pair = encode(make_pair(rng, Content::kShifted, kWidth, kHeight), format);
    memory.resize(arena_bytes(config));
    REQUIRE_EQ(bsm_open(&config, memory.data(), memory.size(), &context), BSM_OK);
    frame = frame_for(config, pair, maps);
  }
  bsm_config config;
  EncodedPair pair;
  std::vector<uint8_t> memory;
  Maps maps;
  bsm_context* context = nullptr;
  bsm_frame frame;
};

// Planes that are missing or too narrow. The call is made in a world of its own, which has to stay as it was.
void add_chroma_mistakes(std::vector<Mistake>& list) {
  using Change = std::function<void(bsm_image&)>;
  const auto add = [&list](const char* what, bsm_status expected, bsm_format format, const Change& change) {
    for (const bool left : {true, false}) {
      const auto call = [=](World&) {
        ChromaWorld world(format);
        change(left ? world.frame.left : world.frame.right);
        const std::vector<uint8_t> before = world.memory;
        const bsm_status status = bsm_process(world.context, &world.frame);
        CHECK(world.memory == before && std::count(world.maps.left.begin(), world.maps.left.end(), kUnwritten) ==
                                            ChromaWorld::kWidth * ChromaWorld::kHeight);
        if (expected == BSM_ERROR_NULL) {
          bsm_row rows[2] = {world.pair.left.planes(0), world.pair.right.planes(0)};
          rows[left ? 0 : 1].plane[1] = nullptr;
          CHECK_EQ(bsm_push_row(world.context, &rows[0], &rows[1]), BSM_ERROR_NULL);
          CHECK(world.memory == before);
        }
        (left ? world.frame.left : world.frame.right) = (left ? world.pair.left : world.pair.right).view();
        CHECK_EQ(bsm_process(world.context, &world.frame), BSM_OK);
        check_same(world.maps, match_frame(world.config, world.pair));
        return status;
      };
      list.push_back({what, expected, call, {}});
    }
  };
  for (const bsm_format format : {BSM_FORMAT_NV12, BSM_FORMAT_NV21}) {
    add("no chroma plane", BSM_ERROR_NULL, format, [](bsm_image& image) { image.plane[1] = nullptr; });
    for (const ptrdiff_t stride : {ChromaWorld::kWidth, -ChromaWorld::kWidth, 0}) {
      add("chroma stride", BSM_ERROR_STRIDE, format, [stride](bsm_image& image) { image.stride[1] = stride; });
    }
    for (const ptrdiff_t stride : {ChromaWorld::kWidth - 1, 1 - ChromaWorld::kWidth}) {
      add("stride of Y", BSM_ERROR_STRIDE, format, [stride](bsm_image& image) { image.stride[0] = stride; });
    }
  }
  for (const ptrdiff_t stride : {2 * ChromaWorld::kWidth + 1, -2 * ChromaWorld::kWidth - 1}) {
    add("stride of yuyv", BSM_ERROR_STRIDE, BSM_FORMAT_YUYV, [stride](bsm_image& image) { image.stride[0] = stride; });
  }
}

std::vector<Mistake> use_mistakes() {
  std::vector<Mistake> list = {
      {"process without a context", BSM_ERROR_CONTEXT, [](World& w) { return bsm_process(not_a_context(), &w.frame); }, {}},
      {"push without a context",
       BSM_ERROR_CONTEXT,
       [](World& w) { return bsm_push_row(not_a_context(), &w.left_row, &w.right_row); },
       {}},
      {"pull without a context",
       BSM_ERROR_CONTEXT,
       [](World& w) { return bsm_pull_row(not_a_context(), w.left_map.data(), nullptr, nullptr); },
       {}},
      {"finish without a context", BSM_ERROR_CONTEXT, [](World&) { return bsm_finish(not_a_context()); }, {}},
      {"reset without a context", BSM_ERROR_CONTEXT, [](World&) { return bsm_reset(not_a_context()); }, {}},
      {"preset -1", BSM_ERROR_PRESET, [](World& w) { return bsm_config_preset(&w.config, enum_of<bsm_preset>(-1)); }, {}},
      {"preset 100", BSM_ERROR_PRESET, [](World& w) { return bsm_config_preset(&w.config, enum_of<bsm_preset>(100)); }, {}},
      {"odd map address", BSM_ERROR_ALIGNMENT, [](World& w) { return bsm_process(w.context, &w.frame); },
       [](World& w) {
         w.frame.disparity.data = reinterpret_cast<int16_t*>(reinterpret_cast<uintptr_t>(w.left_map.data()) + 1);
       }},
      {"odd map stride", BSM_ERROR_ALIGNMENT, [](World& w) { return bsm_process(w.context, &w.frame); },
       [](World& w) { w.frame.disparity.stride = World::kWidth * 2 + 1; }},
      {"odd row address",
       BSM_ERROR_ALIGNMENT,
       [](World& w) {
         return bsm_pull_row(w.context, reinterpret_cast<int16_t*>(reinterpret_cast<uintptr_t>(w.left_map.data()) + 1),
                             nullptr, nullptr);
       },
       {}},
      {"right map of a frame without right_map", BSM_ERROR_NO_RIGHT_MAP,
       [](World& w) { return bsm_process(w.context, &w.frame); },
       [](World& w) {
         w.frame.right_disparity = {w.right_map_values.data(), World::kWidth * 2};
       }},
      {"right map of a row without right_map",
       BSM_ERROR_NO_RIGHT_MAP,
       [](World& w) { return bsm_pull_row(w.context, w.left_map.data(), w.right_map_values.data(), nullptr); },
       {}},
      {"confidence of a frame without confidence", BSM_ERROR_NO_CONFIDENCE,
       [](World& w) { return bsm_process(w.context, &w.frame); },
       [](World& w) {
         w.frame.confidence = {w.confidence.data(), World::kWidth};
       }},
      {"confidence of a row without confidence",
       BSM_ERROR_NO_CONFIDENCE,
       [](World& w) { return bsm_pull_row(w.context, w.left_map.data(), nullptr, w.confidence.data()); },
       {}},
      {"frame while rows are in flight", BSM_ERROR_STREAM_OPEN, [](World& w) { return bsm_process(w.context, &w.frame); },
       [](World& w) { CHECK_EQ(w.push(), BSM_OK); }},
      {"frame while rows wait to be pulled", BSM_ERROR_STREAM_OPEN,
       [](World& w) { return bsm_process(w.context, &w.frame); },
       [](World& w) {
         CHECK_EQ(w.push(), BSM_OK);
         CHECK_EQ(bsm_finish(w.context), BSM_OK);
       }},
      {"push after finish", BSM_ERROR_ROW_COUNT, [](World& w) { return w.push(); },
       [](World& w) {
         CHECK_EQ(w.push(), BSM_OK);
         CHECK_EQ(bsm_finish(w.context), BSM_OK);
       }},
      {"push while a row waits", BSM_ERROR_PULL_FIRST, [](World& w) { return w.push(); },
       [](World& w) {
         int32_t delay = 0;
         CHECK_EQ(bsm_row_delay(&w.config, &delay), BSM_OK);
         REQUIRE(delay < World::kHeight - 1);
         for (int y = 0; y <= delay; ++y) CHECK_EQ(w.push(), BSM_OK);
       }},
  };
  // Strides shorter than a row, positive and negative, of each image and of the map.
  const auto add_stride = [&list](const char* what, const std::function<void(World&, ptrdiff_t)>& set, ptrdiff_t shortest,
                                  ptrdiff_t unit) {
    for (const ptrdiff_t stride : {shortest - unit, unit - shortest, ptrdiff_t{0}, ptrdiff_t{2}, ptrdiff_t{-2}}) {
      list.push_back({what, BSM_ERROR_STRIDE, [](World& w) { return bsm_process(w.context, &w.frame); },
                      [set, stride](World& w) { set(w, stride); }});
    }
  };
  add_stride(
      "left stride", [](World& w, ptrdiff_t s) { w.frame.left.stride[0] = s; }, World::kWidth * 3, 1);
  add_stride(
      "right stride", [](World& w, ptrdiff_t s) { w.frame.right.stride[0] = s; }, World::kWidth * 3, 1);
  add_stride(
      "map stride", [](World& w, ptrdiff_t s) { w.frame.disparity.stride = s; }, World::kWidth * 2, 2);
  add_chroma_mistakes(list);
  // The confidence map's stride, in a context that has one.
  list.push_back({"confidence stride", BSM_ERROR_STRIDE,
                  [](World& w) {
                    bsm_config config = w.config;
                    config.confidence = 1;
                    std::vector<uint8_t> memory(arena_bytes(config));
                    bsm_context* context = nullptr;
                    REQUIRE_EQ(bsm_open(&config, memory.data(), memory.size(), &context), BSM_OK);
                    return bsm_process(context, &w.frame);
                  },
                  [](World& w) {
                    w.frame.confidence = {w.confidence.data(), World::kWidth - 1};
                  }});
  return list;
}

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
  for (const int32_t bit : {-1, 32, kMost, kLeast}) CHECK(bsm_cpu_feature_name(bit) == nullptr);
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
