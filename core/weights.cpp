// Makes the tables of weights at compile time, and the steps of their exponents.
#include "core/weights.h"

namespace bsm {
namespace {

// Largest r with r * r <= value.
uint32_t square_root(uint32_t value) {
  uint32_t root = 0;
  for (uint32_t bit = 1u << 15; bit != 0; bit >>= 1) {
    const uint32_t larger = root | bit;
    if (larger * larger <= value) root = larger;
  }
  return root;
}

// Distance in 1/256 pixel, for |dx|, |dy| <= 32.
uint32_t length(int32_t dx, int32_t dy) {
  return square_root(static_cast<uint32_t>(dx * dx + dy * dy) << 16);
}

}  // namespace

// weight[k] = full exp(-k / steps), rounded; ratio = exp(-1 / steps) 2^32.
template <class Table, class Weight>
static constexpr Table make_weights(uint64_t full, uint64_t ratio) {
  Table table{};
  uint64_t value = full << 16;
  for (Weight& weight : table.weight) {
    weight = static_cast<Weight>((value + (1u << 15)) >> 16);
    value = (value * ratio + (uint64_t{1} << 31)) >> 32;
  }
  return table;
}

constexpr VoteWeights kVoteWeights = make_weights<VoteWeights, uint16_t>(65535, 4228380000);
constexpr SmoothWeights kSmoothWeights = make_weights<SmoothWeights, uint8_t>(255, 4034748382);

uint32_t vote_color_scale(int32_t color) {
  const uint32_t divisor = static_cast<uint32_t>(color);
  return (52429 + divisor / 2) / divisor;  // 0.8 * 64 * 2^10 = 52428.8
}

uint16_t vote_distance_steps(int32_t dx, int32_t dy, int32_t distance) {
  const uint32_t divisor = static_cast<uint32_t>(distance);
  return static_cast<uint16_t>((length(dx, dy) + 2 * divisor) / (4 * divisor));
}

uint32_t smooth_color_scale(int32_t color) {
  const uint32_t divisor = static_cast<uint32_t>(color);
  return (3277 + divisor / 2) / divisor;  // 0.8 * 16 * 2^8 = 3276.8
}

uint8_t smooth_distance_steps(int32_t dx, int32_t dy, int32_t distance) {
  const uint32_t divisor = static_cast<uint32_t>(distance);
  const uint32_t steps = (length(dx, dy) + 8 * divisor) / (16 * divisor);
  return static_cast<uint8_t>(steps < 127 ? steps : 127);
}

}  // namespace bsm
