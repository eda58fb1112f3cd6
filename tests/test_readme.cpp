// test_readme.cpp - the README's two examples, which CMakeLists.txt takes from its text, find the library's maps.
#include <algorithm>
#include <vector>

#include "bsm/bsm.h"
#include "check.h"
#include "images.h"
#include "matching.h"

extern "C" bsm_status find_depth(const uint8_t* left, const uint8_t* right, int16_t* map);
bsm_status stream_depth(const uint8_t* left, const uint8_t* right, void (*use)(int y, const int16_t* disparities));

using namespace bsm::test;

namespace {

constexpr int kWidth = 640, kHeight = 480;

std::vector<int16_t> streamed;  // rows in the order in which they came, which is that of their numbers

void append_row(int y, const int16_t* disparities) {
  CHECK_EQ(static_cast<size_t>(y) * kWidth, streamed.size());
  streamed.insert(streamed.end(), disparities, disparities + kWidth);
}

EncodedPair example_pair() {
  Rng rng(seed());
  return encode(make_pair(rng, Content::kShifted, kWidth, kHeight, 20), BSM_FORMAT_RGB24);
}

bsm_config example_config(bsm_preset preset) {
  bsm_config config;
  REQUIRE_EQ(bsm_config_init(&config, kWidth, kHeight), BSM_OK);
  REQUIRE_EQ(bsm_config_preset(&config, preset), BSM_OK);
  return config;
}

}  // namespace

TEST_CASE(example_in_c) {
  const EncodedPair pair = example_pair();
  std::vector<int16_t> map(size_t{kWidth} * kHeight, kUnwritten);
  REQUIRE_EQ(find_depth(pair.left.row(0), pair.right.row(0), map.data()), BSM_OK);
  check_same_map(map, match_frame(example_config(BSM_PRESET_BALANCED), pair).left, kWidth, "map of the example in C");
}

TEST_CASE(example_in_cpp) {
  const EncodedPair pair = example_pair();
  streamed.clear();
  REQUIRE_EQ(stream_depth(pair.left.row(0), pair.right.row(0), append_row), BSM_OK);
  check_same_map(streamed, match_frame(example_config(BSM_PRESET_FAST), pair).left, kWidth, "map of the example in C++");
}
