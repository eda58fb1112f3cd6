// Contents of the measured kernels' inputs. Settings are those of the preset balanced.
#include "bench/kernel_inputs.h"

#include <algorithm>

#include "core/pattern.h"
#include "core/weights.h"
#include "simd/pattern_order.h"

namespace bsm::bench {
namespace {

constexpr int32_t kPlanes = 3;
constexpr size_t kMargin = 256;  // bytes before and after a buffer
constexpr size_t kCacheLine = 64;

size_t count_of(int32_t a, int32_t b) {
  return static_cast<size_t>(a) * static_cast<size_t>(b);
}

bsm_config balanced(const Inputs& inputs) {
  bsm_config config;
  bsm_config_init(&config, inputs.width, 1);
  config.format = BSM_FORMAT_RGB24;
  bsm_config_preset(&config, BSM_PRESET_BALANCED);
  return config;
}

Pattern take_pattern(Inputs& inputs) {
  Pattern pattern = local_pattern(inputs.bits, inputs.take<PixelPair>(static_cast<size_t>(inputs.bits)));
  if constexpr (kOrdersPatterns) {
    const size_t bytes = static_cast<size_t>(pattern_order_bytes(inputs.bits));
    pattern.order = make_pattern_order(pattern, inputs.take<uint8_t>(bytes));
  }
  return pattern;
}

// A texture: slow changes with a step now and then, other rows alike.
template <typename T>
void fill_texture(Rng& rng, int32_t count, int32_t most, T* values) {
  const int32_t step = most / 80;
  int32_t value = rng.range(0, most);
  for (int32_t i = 0; i < count; ++i) {
    value = rng.one_in(20) ? rng.range(0, most) : std::clamp(value + rng.range(-step, step), 0, most);
    values[i] = static_cast<T>(value);
  }
}

// Rows of CIELAB planes, x = 0 behind `before` values.
ptrdiff_t take_lab(Inputs& inputs, int32_t count, int32_t before) {
  const int32_t values = inputs.width + 2 * before;
  std::vector<uint8_t> base(count_of(values, kPlanes));
  for (int32_t plane = 0; plane < kPlanes; ++plane) fill_texture(inputs.rng, values, 255, &base[count_of(plane, values)]);
  for (int32_t i = 0; i < count; ++i) {
    uint8_t* const row = inputs.take<uint8_t>(base.size() + static_cast<size_t>(inputs.block));
    for (size_t k = 0; k < base.size(); ++k) {
      row[k] = static_cast<uint8_t>(std::clamp(base[k] + inputs.rng.range(-4, 4), 0, 255));
    }
    inputs.rows8.push_back(row + before);
  }
  return values;
}

// Rows of a surface that steps every forty pixels or so, in 1/16 level; one pixel in ten differs by a few sixteenths.
void take_levels(Inputs& inputs, int32_t count, bool holes) {
  const int32_t width = inputs.width;
  const int32_t most = inputs.disparities * 16 - 9;
  std::vector<int32_t> surface(static_cast<size_t>(width));
  int32_t level = inputs.rng.range(0, most);
  for (int32_t& value : surface) value = level = inputs.rng.one_in(40) ? inputs.rng.range(0, most) : level;
  for (int32_t i = 0; i < count; ++i) {
    uint16_t* const row = inputs.take<uint16_t>(static_cast<size_t>(width + inputs.block));
    int32_t missing = 0;  // pixels of a hole still to come; holes are one pixel in six
    for (int32_t x = 0; x < width; ++x) {
      const int32_t change = inputs.rng.one_in(10) ? inputs.rng.range(-24, 24) : 0;
      row[x] = static_cast<uint16_t>(std::clamp(surface[static_cast<size_t>(x)] + change, 0, most));
      if (holes && missing == 0 && inputs.rng.one_in(50)) missing = 10;
      if (missing > 0) row[x] = --missing % 2 == 0 ? kNoLevel : kOccluded;
    }
    inputs.rows16.push_back(row);
  }
}

// Descriptors, and masks of which a quarter of the bits is set.
struct Bits {
  uint8_t* descriptor;
  uint8_t* mask;
};

Bits take_bits(Inputs& inputs) {
  const size_t bytes = count_of(inputs.width, inputs.bits / 8);
  const size_t readable = count_of(inputs.width + inputs.block, inputs.bits / 8);
  const Bits bits{inputs.take<uint8_t>(readable), inputs.take<uint8_t>(readable)};
  for (size_t i = 0; i < bytes; ++i) {
    bits.descriptor[i] = static_cast<uint8_t>(inputs.rng.next());
    bits.mask[i] = static_cast<uint8_t>(inputs.rng.next() & inputs.rng.next());
  }
  return bits;
}

// Two views that agree in seven of eight bits at one disparity.
void take_views(Inputs& inputs, Bits* left, Bits* right) {
  *left = take_bits(inputs);
  *right = take_bits(inputs);
  const ptrdiff_t bytes = inputs.bits / 8;
  const ptrdiff_t shift = std::min(inputs.disparities, inputs.width) / 3;
  for (ptrdiff_t i = 0; i < (inputs.width - shift) * bytes; ++i) {
    const uint64_t noise = inputs.rng.next() & inputs.rng.next() & inputs.rng.next();
    right->descriptor[i] = static_cast<uint8_t>(left->descriptor[i + shift * bytes] ^ noise);
  }
}

// Costs with a valley at one level; pixels at the left end have fewer candidates.
uint16_t* take_costs(Inputs& inputs, int32_t paths) {
  const int32_t stride = inputs.level_stride();
  uint16_t* const costs = inputs.take<uint16_t>(count_of(inputs.width, stride));
  const int32_t noise = inputs.bits / 8;
  uint16_t* cost = costs;
  for (int32_t x = 0; x < inputs.width; ++x) {
    for (int32_t d = 0; d < stride; ++d) {
      const bool candidate = d < inputs.disparities && d <= x;
      const int32_t base = d == inputs.disparities / 3 ? 0 : noise;
      *cost++ = candidate ? static_cast<uint16_t>(paths * (base + inputs.rng.range(0, noise / 2))) : kNoCost;
    }
  }
  return costs;
}

uint8_t* take_edges(Inputs& inputs) {
  uint8_t* const edges = inputs.take<uint8_t>(static_cast<size_t>(inputs.width));
  for (int32_t x = 0; x < inputs.width; ++x) edges[x] = inputs.rng.one_in(10) ? 1 : 0;
  return edges;
}

void set_penalties(const Inputs& inputs, Penalties (&penalties)[2]) {
  const bsm_config config = balanced(inputs);
  for (int32_t edge = 0; edge < 2; ++edge) {
    const int32_t divisor = BSM_MAX_BITS * (edge == 0 ? 1 : config.edge_divisor);
    penalties[edge].p1 = static_cast<uint16_t>(std::max(1, config.p1 * inputs.bits / divisor));
    penalties[edge].p2 = static_cast<uint16_t>(std::max(1, config.p2 * inputs.bits / divisor));
  }
}

// Steps of the exponent over a quarter of the window.
template <typename T>
T* take_steps(Inputs& inputs, int32_t radius, int32_t distance, T (*steps_of)(int32_t, int32_t, int32_t)) {
  T* const steps = inputs.take<T>(count_of(radius + 1, radius + 1));
  T* step = steps;
  for (int32_t dy = 0; dy <= radius; ++dy) {
    for (int32_t dx = 0; dx <= radius; ++dx) *step++ = steps_of(dx, dy, distance);
  }
  return steps;
}

}  // namespace

uint64_t Rng::next() {
  uint64_t z = state_ += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

int32_t Rng::range(int32_t least, int32_t most) {
  return least + static_cast<int32_t>(next() % (static_cast<uint64_t>(most - least) + 1));
}

void* Inputs::take_bytes(size_t bytes) {
  memory_.push_back(std::make_unique<uint8_t[]>(bytes + 2 * kMargin + kCacheLine));
  uint8_t* const begin = memory_.back().get() + kMargin;
  return begin + (kCacheLine - reinterpret_cast<uintptr_t>(begin) % kCacheLine) % kCacheLine;
}

void* Inputs::take_scratch(kernel_scratch_fn* scratch, int32_t radius) {
  return take_bytes(static_cast<size_t>(scratch(KernelShape{width, bits, radius, kPlanes, disparities})));
}

void prepare(Inputs& inputs, kernel_scratch_fn*, ColorLabArgs* args) {
  const size_t width = static_cast<size_t>(inputs.width);
  uint8_t* const source = inputs.take<uint8_t>(3 * width);
  fill_texture(inputs.rng, 3 * inputs.width, 255, source);
  *args = ColorLabArgs{
      source,       nullptr, BSM_FORMAT_RGB24, inputs.width, inputs.take<uint16_t>(width), inputs.take<uint8_t>(3 * width),
      inputs.width, kPlanes};
}

void prepare(Inputs& inputs, kernel_scratch_fn* scratch, DescriptorCompareArgs* args) {
  const Pattern pattern = take_pattern(inputs);
  const int32_t values = inputs.width + 2 * pattern.radius;
  for (int32_t i = 0; i <= 2 * pattern.radius; ++i) {
    uint16_t* const row = inputs.take<uint16_t>(static_cast<size_t>(values + inputs.block));
    fill_texture(inputs.rng, values, 255 * 255, row);
    inputs.rows16.push_back(row + pattern.radius);
  }
  uint8_t* const out = inputs.take<uint8_t>(count_of(inputs.width, inputs.bits / 8));
  *args =
      DescriptorCompareArgs{inputs.rows16.data(), inputs.width, pattern, out, inputs.take_scratch(scratch, pattern.radius)};
}

void prepare(Inputs& inputs, kernel_scratch_fn* scratch, MaskThresholdArgs* args) {
  const Pattern pattern = take_pattern(inputs);
  const ptrdiff_t stride = take_lab(inputs, 2 * pattern.radius + 1, pattern.radius);
  uint8_t* const out = inputs.take<uint8_t>(count_of(inputs.width, inputs.bits / 8));
  *args = MaskThresholdArgs{
      inputs.rows8.data(), stride, kPlanes, inputs.width, pattern, out, inputs.take_scratch(scratch, pattern.radius)};
}

void prepare(Inputs& inputs, kernel_scratch_fn* scratch, MatchHammingArgs* args) {
  Bits left{}, right{};
  take_views(inputs, &left, &right);
  const size_t width = static_cast<size_t>(inputs.width);
  *args = MatchHammingArgs{left.descriptor,
                           right.descriptor,
                           left.mask,
                           right.mask,
                           inputs.width,
                           inputs.bits,
                           0,
                           inputs.disparities,
                           inputs.take<uint16_t>(width),
                           inputs.take<uint16_t>(width),
                           inputs.take_scratch(scratch, kMaxPatternRadius)};
}

void prepare(Inputs& inputs, kernel_scratch_fn* scratch, CostHammingArgs* args) {
  Bits left{}, right{};
  take_views(inputs, &left, &right);
  *args = CostHammingArgs{};
  args->own = left.descriptor;
  args->own_mask = left.mask;
  args->other = right.descriptor;
  args->width = inputs.width;
  args->bits = inputs.bits;
  args->num_disparities = inputs.disparities;
  args->stride = inputs.level_stride();
  args->cost = inputs.take<uint16_t>(count_of(inputs.width, args->stride));
  args->scratch = inputs.take_scratch(scratch, kMaxPatternRadius);
}

void prepare(Inputs& inputs, kernel_scratch_fn* scratch, EdgeThresholdArgs* args) {
  const ptrdiff_t stride = take_lab(inputs, 2, 0);
  *args = EdgeThresholdArgs{inputs.rows8[0],
                            inputs.rows8[1],
                            stride,
                            kPlanes,
                            inputs.width,
                            balanced(inputs).edge_threshold,
                            inputs.take<uint8_t>(static_cast<size_t>(inputs.width)),
                            inputs.take_scratch(scratch, kMaxPatternRadius)};
}

void prepare(Inputs& inputs, kernel_scratch_fn* scratch, AggregateAlongArgs* args) {
  *args = AggregateAlongArgs{};
  args->cost = take_costs(inputs, 1);
  args->edge = take_edges(inputs);
  set_penalties(inputs, args->penalties);
  args->most_cost = inputs.bits;
  args->width = inputs.width;
  args->num_disparities = inputs.disparities;
  args->stride = inputs.level_stride();
  args->sum = inputs.take<uint16_t>(count_of(inputs.width, args->stride));
  args->scratch = inputs.take_scratch(scratch, kMaxPatternRadius);
}

void prepare(Inputs& inputs, kernel_scratch_fn* scratch, AggregateAcrossArgs* args) {
  *args = AggregateAcrossArgs{};
  args->cost = take_costs(inputs, 1);
  args->previous = take_costs(inputs, 1);
  args->edge = take_edges(inputs);
  set_penalties(inputs, args->penalties);
  args->dx = 1;
  args->end = inputs.width;
  args->width = inputs.width;
  args->num_disparities = inputs.disparities;
  args->stride = inputs.level_stride();
  args->current = inputs.take<uint16_t>(count_of(inputs.width, args->stride));
  args->sum = take_costs(inputs, 2);
  args->scratch = inputs.take_scratch(scratch, kMaxPatternRadius);
}

void prepare(Inputs& inputs, kernel_scratch_fn* scratch, WinnerSumsArgs* args) {
  const uint16_t* const sums = take_costs(inputs, 4);
  *args = WinnerSumsArgs{sums,
                         inputs.width,
                         inputs.disparities,
                         inputs.level_stride(),
                         1,
                         inputs.take<uint16_t>(static_cast<size_t>(inputs.width)),
                         inputs.take_scratch(scratch, kMaxPatternRadius)};
}

void prepare(Inputs& inputs, kernel_scratch_fn* scratch, VoteWeighArgs* args) {
  const bsm_config config = balanced(inputs);
  *args = VoteWeighArgs{};
  args->radius = config.vote_radius;
  args->step = config.vote_step;
  take_levels(inputs, 2 * args->radius + 1, true);
  args->plane_stride = take_lab(inputs, 2 * args->radius + 1, 0);
  args->levels = inputs.rows16.data();
  args->lab = inputs.rows8.data();
  args->planes = kPlanes;
  args->width = inputs.width;
  args->num_disparities = inputs.disparities;
  args->color_scale = vote_color_scale(config.vote_color);
  args->distance_steps = take_steps(inputs, args->radius, config.vote_distance, vote_distance_steps);
  args->weights = kVoteWeights.weight;
  args->weights_count = VoteWeights::kCount;
  args->out = inputs.take<uint16_t>(static_cast<size_t>(inputs.width));
  args->scratch = inputs.take_scratch(scratch, kMaxPatternRadius);
}

void prepare(Inputs& inputs, kernel_scratch_fn* scratch, MedianWeightedArgs* args) {
  const bsm_config config = balanced(inputs);
  *args = MedianWeightedArgs{};
  args->radius = config.smooth_radius;
  take_levels(inputs, 2 * args->radius + 1, false);
  args->plane_stride = take_lab(inputs, 2 * args->radius + 1, 0);
  args->levels = inputs.rows16.data();
  args->lab = inputs.rows8.data();
  args->planes = kPlanes;
  args->width = inputs.width;
  args->color_scale = smooth_color_scale(config.smooth_color);
  args->distance_steps = take_steps(inputs, args->radius, config.smooth_distance, smooth_distance_steps);
  args->weights = kSmoothWeights.weight;
  args->checked = inputs.rows16[static_cast<size_t>(args->radius)];
  args->own_bonus = 256;
  args->out = inputs.take<uint16_t>(static_cast<size_t>(inputs.width));
  args->scratch = inputs.take_scratch(scratch, kMaxPatternRadius);
}

void prepare(Inputs& inputs, kernel_scratch_fn* scratch, FractionSmoothArgs* args) {
  constexpr int32_t kSide = 2 * kFractionRadius + 1;
  take_levels(inputs, kSide, false);
  for (int32_t i = 0; i < kSide; ++i) {
    uint8_t* const row = inputs.take<uint8_t>(static_cast<size_t>(inputs.width));
    for (int32_t x = 0; x < inputs.width; ++x) row[x] = static_cast<uint8_t>(inputs.rng.range(1, kMaxFractionWeight));
    inputs.rows8.push_back(row);
  }
  *args = FractionSmoothArgs{};
  args->levels = inputs.rows16.data();
  args->weights = inputs.rows8.data();
  args->width = inputs.width;
  args->out = inputs.take<uint16_t>(static_cast<size_t>(inputs.width));
  args->scratch = inputs.take_scratch(scratch, kMaxPatternRadius);
}

}  // namespace bsm::bench
