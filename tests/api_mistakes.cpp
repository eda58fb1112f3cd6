// api_mistakes.cpp - the list of mistakes, by what is wrong: a field of the configuration, a null pointer, the use.
#include "api_mistakes.h"

namespace bsm::test {
namespace {

constexpr int32_t kMost = INT32_MAX, kLeast = INT32_MIN;

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

}  // namespace

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

}  // namespace bsm::test
