// api_world.h - a context with all that its caller owns around it, for tests of calls that have to fail: they write nothing,
// and the context does its work afterwards. And arguments that only a C caller or a mistaken one can pass.
#ifndef BSM_TESTS_API_WORLD_H
#define BSM_TESTS_API_WORLD_H

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "bsm/bsm.h"
#include "check.h"
#include "images.h"
#include "matching.h"

namespace bsm::test {

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

// Any number as a value of a C enumeration, as a C caller may pass it.
template <typename Enum>
Enum enum_of(int value) {
  static_assert(sizeof(Enum) == sizeof(int));
  Enum result;
  std::memcpy(&result, &value, sizeof result);
  return result;
}

// Memory that no bsm_open made into a context.
inline bsm_context* not_a_context() {
  alignas(64) static uint8_t memory[4096] = {};
  return reinterpret_cast<bsm_context*>(memory);
}

}  // namespace bsm::test

#endif  // BSM_TESTS_API_WORLD_H
