// fuzz_config.cpp - libFuzzer harness of the public calls: any configuration is refused or opens in exactly the memory it
// asks for, and small ones match an image made of the rest of the input, as a frame and as rows, to the same map.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <vector>

#include "bsm/bsm.h"

namespace {

// Reads numbers from the input; zeros when it has ended.
class Input {
 public:
  Input(const uint8_t* data, size_t size) : data_(data), size_(size) {}
  uint8_t byte() { return position_ < size_ ? data_[position_++] : 0; }
  int32_t word() {
    uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value = value << 8 | byte();
    return static_cast<int32_t>(value);
  }
  // Mostly a value that is allowed, now and then one just beyond or any at all.
  int32_t near(int32_t low, int32_t high) {
    const uint8_t kind = byte();
    if (kind == 255) return word();
    if (kind == 254) return low - 1;
    if (kind == 253) return high + 1;
    return static_cast<int32_t>(low + (int64_t{byte()} * 256 + byte()) % (int64_t{high} - low + 1));
  }

 private:
  const uint8_t* data_;
  size_t size_;
  size_t position_ = 0;
};

void require(bool condition) {
  if (!condition) std::abort();
}

size_t pixel_bytes(int32_t format) {
  const size_t bytes[] = {1, 3, 3, 4, 4, 2};
  return bytes[format];
}

bsm_config read_config(Input& input) {
  bsm_config config;
  require(bsm_config_init(&config, 1, 1) == BSM_OK);
  const bool small = input.byte() % 4 != 0;
  config.width = input.near(1, small ? 24 : BSM_MAX_SIZE);
  config.height = input.near(1, small ? 24 : BSM_MAX_SIZE);
  config.min_disparity = small ? input.near(-20, 20) : input.near(BSM_MIN_DISPARITY, BSM_MAX_DISPARITY);
  config.num_disparities = small ? input.near(1, 40) : input.near(1, 4094);
  const int32_t bits = small ? input.near(1, 3) : input.near(1, 64);
  config.bits = bits > 1000 || bits < -1000 ? bits : 64 * bits + (input.byte() == 7);
  config.method = input.near(0, 1);
  config.stage = input.near(0, BSM_STAGE_REFINED);
  config.format = input.near(0, 5);
  config.paths = input.near(3, 8);
  config.p1 = input.near(1, 200);
  config.p2 = input.near(100, 16384);
  config.edge_threshold = input.near(1, 255);
  config.edge_divisor = input.near(1, 64);
  config.right_costs = input.near(0, 1);
  config.subpixel = input.near(0, 1);
  config.lr_tolerance = input.near(0, 255);
  config.speckle = input.byte() % 2 ? 0 : input.near(0, 100);
  config.border = input.near(0, 1);
  config.vote_radius = input.near(1, BSM_MAX_VOTE_RADIUS);
  config.vote_step = input.byte() % 2 ? 1 : input.near(1, 6);
  config.vote_color = input.near(1, 64);
  config.vote_distance = input.near(1, 64);
  config.vote_cap = input.near(0, 1);
  config.smooth_radius = input.near(1, BSM_MAX_SMOOTH_RADIUS);
  config.smooth_passes = input.near(0, BSM_MAX_SMOOTH_PASSES);
  config.smooth_color = input.near(1, 64);
  config.smooth_distance = input.near(2, 64);
  config.median = input.near(0, 1);
  config.right_map = input.near(0, 1);
  config.confidence = input.near(0, 1);
  config.max_jobs = small ? input.near(1, 3) : input.near(1, BSM_MAX_JOBS);
  config.isa_mask = static_cast<uint32_t>(input.word());
  if (input.byte() == 7) config.reserved[input.byte() % std::size(config.reserved)] = input.byte();
  if (input.byte() == 7) config.struct_size = static_cast<uint32_t>(input.word());
  return config;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Input input(data, size);
  const bsm_config config = read_config(input);
  size_t bytes = 0;
  int32_t delay = 0;
  bsm_context* context = nullptr;
  const bsm_status status = bsm_memory_required(&config, &bytes);
  require(bsm_row_delay(&config, &delay) == status || status == BSM_ERROR_MEMORY_SIZE);
  require(bsm_status_string(status) != nullptr);
  uint8_t too_small[64];
  if (status != BSM_OK) {
    require(bsm_open(&config, too_small, sizeof too_small, &context) == status && context == nullptr);
    return 0;
  }
  require(bsm_open(&config, too_small, sizeof too_small, &context) == BSM_ERROR_ARENA && context == nullptr);
  if (config.width > 25 || config.height > 25 || config.num_disparities > 64 || config.bits > 256 || bytes > (1u << 24))
    return 0;

  // Exactly the memory asked for, at any alignment: a sanitizer sees the byte before and after.
  const size_t offset = input.byte() % 64;
  std::vector<uint8_t> arena(offset + bytes);
  require(bsm_open(&config, arena.data() + offset, bytes, &context) == BSM_OK);
  const size_t width = static_cast<size_t>(config.width), height = static_cast<size_t>(config.height);
  const size_t stride = width * pixel_bytes(config.format);
  std::vector<uint8_t> left(stride * height), right(left.size());
  for (uint8_t& value : left) value = input.byte();
  for (uint8_t& value : right) value = input.byte();

  std::vector<int16_t> map(width * height), right_map(map.size()), rows, right_rows, row(width), right_row(width);
  std::vector<uint8_t> confidence(map.size()), confidence_rows, confidence_row(width);
  bsm_frame frame;
  std::memset(&frame, 0, sizeof frame);
  frame.left = {{left.data(), nullptr}, {static_cast<ptrdiff_t>(stride), 0}};
  frame.right = {{right.data(), nullptr}, {static_cast<ptrdiff_t>(stride), 0}};
  frame.disparity = {map.data(), static_cast<ptrdiff_t>(width * 2)};
  if (config.right_map) frame.right_disparity = {right_map.data(), static_cast<ptrdiff_t>(width * 2)};
  if (config.confidence) frame.confidence = {confidence.data(), config.width};
  require(bsm_process(context, &frame) == BSM_OK);

  if (config.method == BSM_METHOD_SGM && config.paths == 8 && config.stage >= BSM_STAGE_AGGREGATED) {
    const bsm_row any{{left.data(), nullptr}};
    require(bsm_push_row(context, &any, &any) == BSM_ERROR_ROW_MODE);
    return 0;
  }
  const auto pull = [&] {
    const bsm_status pulled = bsm_pull_row(context, row.data(), config.right_map ? right_row.data() : nullptr,
                                           config.confidence ? confidence_row.data() : nullptr);
    if (pulled == BSM_OK) {
      rows.insert(rows.end(), row.begin(), row.end());
      right_rows.insert(right_rows.end(), right_row.begin(), right_row.end());
      confidence_rows.insert(confidence_rows.end(), confidence_row.begin(), confidence_row.end());
    }
    return pulled;
  };
  for (size_t y = 0; y < height; ++y) {
    const bsm_row left_row{{left.data() + y * stride, nullptr}}, right_input{{right.data() + y * stride, nullptr}};
    require(bsm_push_row(context, &left_row, &right_input) == BSM_OK);
    if (y >= static_cast<size_t>(delay)) require(pull() == BSM_OK);
  }
  while (pull() == BSM_OK) {
  }
  require(pull() == BSM_END);
  require(rows == map && (!config.right_map || right_rows == right_map));
  require(!config.confidence || confidence_rows == confidence);
  for (const int16_t value : map) {
    const int32_t first = config.min_disparity * BSM_DISPARITY_SCALE;
    const bool in_range = value >= first && value < first + config.num_disparities * BSM_DISPARITY_SCALE;
    require(in_range || (config.stage != BSM_STAGE_REFINED && value == bsm_invalid_disparity(&config)));
  }
  return 0;
}
