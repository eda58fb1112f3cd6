// fuzz_config.cpp - libFuzzer harness of the public calls: any configuration is refused or opens in exactly the memory it
// asks for; small ones play calls in the order that the input says, right and wrong ones, between forbidden pages.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iterator>

#include "bsm/bsm.h"
#include "call_sequence.h"
#include "check.h"
#include "images.h"
#include "page_yard.h"

using namespace bsm::test;

namespace {

constexpr int kSmallSize = 24;
constexpr int kCalls = 8;

// Numbers from the input; when it has ended, from a generator that the input seeds, so that short inputs play whole games.
class Input {
 public:
  Input(const uint8_t* data, size_t size) : data_(data), end_(data + size), rng_(fnv1a(data, size)) {}
  uint8_t byte() { return data_ != end_ ? *data_++ : rng_.byte(); }
  uint32_t word() {
    uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value = value << 8 | byte();
    return value;
  }
  int in(int low, int high) {
    const uint32_t span = static_cast<uint32_t>(high) - static_cast<uint32_t>(low) + 1;
    return low + static_cast<int>((span <= 256 ? byte() : word()) % span);
  }
  // Mostly a value that is allowed, now and then one just beyond or any at all.
  int32_t near(int32_t low, int32_t high) {
    switch (byte()) {
      case 255:
        return static_cast<int32_t>(word());
      case 254:
        return low - 1;
      case 253:
        return high + 1;
      default:
        return in(low, high);
    }
  }
  template <typename T, size_t N>
  int32_t one_of(const T (&values)[N]) {
    const int32_t i = near(0, static_cast<int32_t>(N) - 1);
    return i >= 0 && i < static_cast<int32_t>(N) ? static_cast<int32_t>(values[i]) : i;
  }

 private:
  static uint64_t fnv1a(const uint8_t* data, size_t size) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < size; ++i) hash = (hash ^ data[i]) * 0x100000001b3u;
    return hash;
  }
  const uint8_t* data_;
  const uint8_t* end_;
  Rng rng_;
};

bsm_config read_config(Input& input) {
  bsm_config config;
  REQUIRE_EQ(bsm_config_init(&config, 1, 1), BSM_OK);
  const bool small = input.byte() % 8 != 0;
  constexpr int32_t kPaths[] = {3, 4, 5, 8};
  config.width = input.near(1, small ? kSmallSize : BSM_MAX_SIZE);
  config.height = input.near(1, small ? kSmallSize : BSM_MAX_SIZE);
  config.format = input.one_of(kAllFormats);
  config.min_disparity = small ? input.near(-8, 8) : input.near(BSM_MIN_DISPARITY, BSM_MAX_DISPARITY);
  config.num_disparities = small ? input.near(1, 20) : input.near(1, 4094);
  const int32_t words = small ? input.near(1, 4) : input.near(1, 64);
  config.bits = words > 1000 || words < -1000 ? words : 64 * words;
  config.sigma = input.near(3, 4);
  config.stage = input.near(0, BSM_STAGE_REFINED);
  config.right_map = input.near(0, 1);
  config.confidence = input.near(0, 1);
  config.method = input.near(0, 1);
  config.paths = input.one_of(kPaths);
  config.p1 = input.near(1, 2000);
  config.p2 = input.near(std::clamp<int32_t>(config.p1, 1, 16384), 16384);
  config.edge_threshold = input.near(1, 255);
  config.edge_divisor = input.near(1, 64);
  config.right_costs = input.near(0, 1);
  config.subpixel = input.near(0, 1);
  config.lr_tolerance = input.near(0, 255);
  config.speckle = input.byte() % 2 ? 0 : input.near(0, 100);
  config.border = input.near(0, 1);
  config.vote_step = input.byte() % 2 ? 1 : input.near(1, 6);
  config.vote_radius = input.byte() % 2 ? config.vote_step : input.near(1, BSM_MAX_VOTE_RADIUS);
  config.vote_color = input.near(1, 64);
  config.vote_distance = input.near(1, 64);
  config.vote_cap = input.near(0, 1);
  config.smooth_radius = input.near(1, BSM_MAX_SMOOTH_RADIUS);
  config.smooth_passes = input.near(0, BSM_MAX_SMOOTH_PASSES);
  config.smooth_color = input.near(1, 64);
  config.smooth_distance = input.near(2, 64);
  config.median = input.near(0, 1);
  config.max_jobs = small ? input.near(1, 4) : input.near(1, BSM_MAX_JOBS);
  config.isa_mask = input.word();
  if (input.byte() == 7) config.reserved[input.byte() % std::size(config.reserved)] = input.byte();
  if (input.byte() == 7) config.struct_size = input.word();
  return config;
}

// True when the configuration is accepted. What the size query says must be what opening it says.
bool opens(const bsm_config& config) {
  size_t bytes = 0;
  int32_t delay = 0;
  uint8_t too_small[64];
  bsm_context* context = nullptr;
  const bsm_status status = bsm_memory_required(&config, &bytes);
  const bsm_status delay_status = bsm_row_delay(&config, &delay);
  const bsm_status open_status = bsm_open(&config, too_small, sizeof too_small, &context);
  const bool row_mode = config.method != BSM_METHOD_SGM || config.paths != 8;
  REQUIRE(delay_status == status || status == BSM_ERROR_MEMORY_SIZE || (!row_mode && delay_status == BSM_ERROR_ROW_MODE));
  REQUIRE_EQ(open_status, status == BSM_OK ? BSM_ERROR_ARENA : status);
  REQUIRE(context == nullptr);
  REQUIRE(bsm_status_string(status) != nullptr);
  return status == BSM_OK;
}

bool is_small(const bsm_config& config) {
  return config.width <= kSmallSize && config.height <= kSmallSize && config.num_disparities <= 32 && config.bits <= 256;
}

PixelImage read_image(Input& input, const bsm_config& config) {
  ColorImage colors(config.width, config.height);
  for (uint8_t& value : colors.rgb) value = input.byte();
  return encode(colors, static_cast<bsm_format>(config.format));
}

void play(Input& input) {
  Stage stage{};
  stage.config[0] = read_config(input);
  if (!opens(stage.config[0]) || !is_small(stage.config[0])) return;
  bsm_config other = read_config(input);
  other.width = stage.config[0].width;
  other.height = stage.config[0].height;
  other.format = stage.config[0].format;
  stage.config[1] = opens(other) && is_small(other) ? other : stage.config[0];
  for (EncodedPair& pair : stage.pair) pair = {read_image(input, stage.config[0]), read_image(input, stage.config[0])};
  static PageYard yard;  // its pages serve every input
  play_calls(
      stage, [&input](int low, int high) { return input.in(low, high); }, yard, kCalls);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Input input(data, size);
  try {
    play(input);
  } catch (const Stop&) {
  }
  if (failures() != 0) std::abort();
  return 0;
}
