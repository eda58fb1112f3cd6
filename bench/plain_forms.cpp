// The plain forms of scalar kernels.
#include "bench/plain_forms.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "simd/scalar/aggregate.h"
#include "simd/scalar/bits.h"
#include "simd/scalar/sad.h"

namespace bsm::bench {

// --- mask_threshold

namespace {

struct PairScratch {
  uint16_t weight[BSM_MAX_BITS];  // w_i
  uint16_t histogram[kMaxSad + 1];
};

uint32_t pair_weight(const MaskThresholdArgs& args, int32_t x, const PixelPair& pair) {
  const uint8_t* const* rows = args.rows + args.pattern.radius;
  const uint8_t* center = rows[0] + x;
  return std::max(sad(center, rows[pair.py] + x + pair.px, args.plane_stride, args.planes),
                  sad(center, rows[pair.qy] + x + pair.qx, args.plane_stride, args.planes));
}

}  // namespace

uint64_t mask_colors_by_pair_scratch(const KernelShape&) {
  return sizeof(PairScratch);
}

void mask_colors_by_pair(const MaskThresholdArgs& args) {
  PairScratch& scratch = *static_cast<PairScratch*>(args.scratch);
  const int32_t bits = args.pattern.bits;
  uint8_t* out = args.out;
  for (int32_t x = 0; x < args.width; ++x) {
    std::memset(scratch.histogram, 0, sizeof scratch.histogram);
    for (int32_t i = 0; i < bits; ++i) {
      scratch.weight[i] = static_cast<uint16_t>(pair_weight(args, x, args.pattern.pairs[i]));
      ++scratch.histogram[scratch.weight[i]];
    }
    uint32_t threshold = 0;
    int32_t counted = scratch.histogram[0];
    while (counted < bits / 4) counted += scratch.histogram[++threshold];
    for (int32_t first = 0; first < bits; first += 8) {
      uint32_t byte = 0;
      for (int32_t i = 7; i >= 0; --i) byte = 2 * byte + (scratch.weight[first + i] <= threshold ? 1u : 0u);
      *out++ = static_cast<uint8_t>(byte);
    }
  }
}

namespace {

struct WindowScratch {
  uint16_t sad[kMaxWindowSide * kMaxWindowSide];
  uint16_t histogram[kMaxSad + 1];
};

}  // namespace

uint64_t mask_whole_window_scratch(const KernelShape&) {
  return sizeof(WindowScratch);
}

void mask_whole_window(const MaskThresholdArgs& args) {
  WindowScratch& scratch = *static_cast<WindowScratch*>(args.scratch);
  const Pattern& pattern = args.pattern;
  const int32_t side = 2 * pattern.radius + 1;
  const uint16_t* center = scratch.sad + pattern.radius * side + pattern.radius;
  const auto weight = [center, side](const PixelPair& pair) {
    return std::max(center[pair.py * side + pair.px], center[pair.qy * side + pair.qx]);
  };
  uint8_t* out = args.out;
  for (int32_t x = 0; x < args.width; ++x) {
    uint16_t* next = scratch.sad;
    for (int32_t dy = 0; dy < side; ++dy) {
      const uint8_t* row = args.rows[dy] + x - pattern.radius;
      for (int32_t dx = 0; dx < side; ++dx) {
        *next++ = static_cast<uint16_t>(sad(args.rows[pattern.radius] + x, row + dx, args.plane_stride, args.planes));
      }
    }
    std::memset(scratch.histogram, 0, sizeof scratch.histogram);
    for (int32_t i = 0; i < pattern.bits; ++i) ++scratch.histogram[weight(pattern.pairs[i])];
    uint32_t threshold = 0;
    int32_t counted = scratch.histogram[0];
    while (counted < pattern.bits / 4) counted += scratch.histogram[++threshold];
    for (int32_t first = 0; first < pattern.bits; first += 8) {
      uint32_t byte = 0;
      for (int32_t i = 7; i >= 0; --i) byte = 2 * byte + (weight(pattern.pairs[first + i]) <= threshold ? 1u : 0u);
      *out++ = static_cast<uint8_t>(byte);
    }
  }
}

// --- match_hamming

namespace {

constexpr uint32_t kNone = 0xffffffffu;

// Bits that differ under a mask.
uint32_t count_differing(const uint8_t* a, const uint8_t* b, const uint8_t* mask, int32_t words) {
  uint32_t cost = 0;
  for (int32_t i = 0; i < words; i += 3) {
    uint64_t word[3] = {0, 0, 0};
    for (int32_t k = 0; k < 3 && i + k < words; ++k) {
      const ptrdiff_t at = ptrdiff_t{i + k} * 8;
      word[k] = (load_bits(a + at) ^ load_bits(b + at)) & load_bits(mask + at);
    }
    cost += count_bits(word[0], word[1], word[2]);
  }
  return cost;
}

struct Costs {
  uint32_t left, right;
};

// The same under both views' masks.
Costs count_shared(const uint8_t* a, const uint8_t* b, const uint8_t* left_mask, const uint8_t* right_mask, int32_t words) {
  Costs costs{0, 0};
  for (int32_t i = 0; i < words; i += 3) {
    uint64_t left[3] = {0, 0, 0};
    uint64_t right[3] = {0, 0, 0};
    for (int32_t k = 0; k < 3 && i + k < words; ++k) {
      const ptrdiff_t at = ptrdiff_t{i + k} * 8;
      const uint64_t differing = load_bits(a + at) ^ load_bits(b + at);
      left[k] = differing & load_bits(left_mask + at);
      right[k] = differing & load_bits(right_mask + at);
    }
    costs.left += count_bits(left[0], left[1], left[2]);
    costs.right += count_bits(right[0], right[1], right[2]);
  }
  return costs;
}

// Winner-takes-all over every candidate, counted to the end by count(left, right, left_mask, right_mask).
template <class Count>
void match_row(const MatchHammingArgs& args, const Count& count) {
  const ptrdiff_t bytes = args.bits / 8;
  uint32_t* right_best = static_cast<uint32_t*>(args.scratch);
  std::fill_n(right_best, args.width, kNone);
  std::fill_n(args.right_level, args.width, kNoLevel);
  for (int32_t x = 0; x < args.width; ++x) {
    const int32_t farthest = x - args.min_disparity;
    const int32_t first = std::max(0, farthest - args.width + 1);
    const int32_t last = std::min(farthest, args.num_disparities - 1);
    uint32_t best = kNone;
    args.left_level[x] = kNoLevel;
    for (int32_t level = first; level <= last; ++level) {
      const int32_t xr = farthest - level;
      const Costs costs =
          count(args.left + x * bytes, args.right + xr * bytes, args.left_mask + x * bytes, args.right_mask + xr * bytes);
      if (costs.left < best) {
        best = costs.left;
        args.left_level[x] = static_cast<uint16_t>(level << kLevelShift);
      }
      if (costs.right < right_best[xr]) {
        right_best[xr] = costs.right;
        args.right_level[xr] = static_cast<uint16_t>(level << kLevelShift);
      }
    }
  }
}

}  // namespace

uint64_t match_all_bits_scratch(const KernelShape& shape) {
  return match_hamming_scalar_scratch(shape);
}

void match_all_bits(const MatchHammingArgs& args) {
  match_row(args, [words = args.bits / 64](const uint8_t* left, const uint8_t* right, const uint8_t* left_mask,
                                           const uint8_t* right_mask) {
    return count_shared(left, right, left_mask, right_mask, words);
  });
}

uint64_t match_each_view_scratch(const KernelShape& shape) {
  return match_hamming_scalar_scratch(shape);
}

void match_each_view(const MatchHammingArgs& args) {
  match_row(args, [words = args.bits / 64](const uint8_t* left, const uint8_t* right, const uint8_t* left_mask,
                                           const uint8_t* right_mask) {
    return Costs{count_differing(left, right, left_mask, words), count_differing(left, right, right_mask, words)};
  });
}

namespace {

// count_shared, but words that both masks leave out are not looked at: three at a time, as they are counted.
Costs count_nonzero(const uint8_t* a, const uint8_t* b, const uint8_t* left_mask, const uint8_t* right_mask, int32_t words) {
  Costs costs{0, 0};
  for (int32_t i = 0; i < words; i += 3) {
    uint64_t left[3] = {0, 0, 0};
    uint64_t right[3] = {0, 0, 0};
    for (int32_t k = 0; k < 3 && i + k < words; ++k) {
      left[k] = load_bits(left_mask + ptrdiff_t{i + k} * 8);
      right[k] = load_bits(right_mask + ptrdiff_t{i + k} * 8);
    }
    if ((left[0] | left[1] | left[2] | right[0] | right[1] | right[2]) == 0) continue;
    for (int32_t k = 0; k < 3 && i + k < words; ++k) {
      const ptrdiff_t at = ptrdiff_t{i + k} * 8;
      const uint64_t differing = load_bits(a + at) ^ load_bits(b + at);
      left[k] &= differing;
      right[k] &= differing;
    }
    costs.left += count_bits(left[0], left[1], left[2]);
    costs.right += count_bits(right[0], right[1], right[2]);
  }
  return costs;
}

}  // namespace

void match_given_order(const TwoOrdersArgs& args) {
  match_all_bits(args.given);
}

void match_skipping_zeros(const TwoOrdersArgs& args) {
  match_row(args.coherent, [words = args.coherent.bits / 64](const uint8_t* left, const uint8_t* right,
                                                             const uint8_t* left_mask, const uint8_t* right_mask) {
    return count_nonzero(left, right, left_mask, right_mask, words);
  });
}

// --- aggregate_along

namespace {

// aggregate_step; previous and current are two.
void step_by_level(const uint16_t* cost, const uint16_t* previous, Penalties penalties, int32_t count, uint16_t* current) {
  for (int32_t level = 0; level < count; ++level) {
    const uint32_t smallest = least_cost(previous, count);
    // The costs are in memory for all the compiler knows: it must not take the line above out of the loop.
    BSM_KEEP_ORDER();
    const uint32_t jump = saturate(smallest + penalties.p2);
    const uint32_t below = level > 0 ? previous[level - 1] : kNoCost;
    const uint32_t above = level + 1 < count ? previous[level + 1] : kNoCost;
    const uint32_t change = saturate(least(below, above) + penalties.p1);
    current[level] = saturate(cost[level] + least(least(previous[level], change), jump) - smallest);
  }
}

}  // namespace

uint64_t aggregate_least_by_level_scratch(const KernelShape& shape) {
  return 2 * aggregate_along_scalar_scratch(shape);
}

void aggregate_least_by_level(const AggregateAlongArgs& args) {
  const int32_t count = args.num_disparities;
  uint16_t* path = static_cast<uint16_t*>(args.scratch);
  uint16_t* next = path + count;
  for (int32_t x = 0; x < args.width; ++x) {
    const uint16_t* cost = args.cost + ptrdiff_t{x} * args.stride;
    if (x == 0) {
      std::copy_n(cost, count, next);
    } else {
      step_by_level(cost, path, args.penalties[args.edge[x]], count, next);
    }
    std::swap(path, next);
    std::copy_n(path, count, args.sum + ptrdiff_t{x} * args.stride);
  }
  for (int32_t x = args.width - 1; x >= 0; --x) {
    const uint16_t* cost = args.cost + ptrdiff_t{x} * args.stride;
    if (x == args.width - 1) {
      std::copy_n(cost, count, next);
    } else {
      step_by_level(cost, path, args.penalties[args.edge[x + 1]], count, next);
    }
    std::swap(path, next);
    uint16_t* sum = args.sum + ptrdiff_t{x} * args.stride;
    for (int32_t level = 0; level < count; ++level) sum[level] = saturate(uint32_t{sum[level]} + path[level]);
  }
}

// --- vote_weigh

uint64_t vote_everywhere_scratch(const KernelShape& shape) {
  return vote_weigh_scalar_scratch(shape);
}

void vote_everywhere(const VoteWeighArgs& args) {
  uint32_t* votes = static_cast<uint32_t*>(args.scratch);
  const int32_t radius = args.radius;
  for (int32_t x = 0; x < args.width; ++x) {
    std::fill_n(votes, args.num_disparities, 0u);
    for (int32_t dy = -radius; dy <= radius; dy += args.step) {
      const uint16_t* levels = args.levels[dy + radius];
      for (int32_t dx = -radius; levels != nullptr && dx <= radius; dx += args.step) {
        const int32_t i = x + dx;
        if (i < 0 || i >= args.width || levels[i] >= kOccluded) continue;
        const uint32_t color = sad(args.lab[radius] + x, args.lab[dy + radius] + i, args.plane_stride, args.planes);
        const uint32_t exponent =
            ((color * args.color_scale + 512) >> 10) + args.distance_steps[std::abs(dy) * (radius + 1) + std::abs(dx)];
        if (exponent < static_cast<uint32_t>(args.weights_count)) votes[whole_level(levels[i])] += args.weights[exponent];
      }
    }
    const auto winner = [votes](int32_t end) {
      const uint32_t* const most = std::max_element(votes, votes + end);
      return *most == 0 ? kNoLevel : static_cast<uint16_t>((most - votes) << kLevelShift);
    };
    const bool capped = args.cap != nullptr && args.cap[x] < args.num_disparities - 1;
    uint16_t level = winner(capped ? args.cap[x] + 1 : args.num_disparities);
    if (level == kNoLevel) level = winner(args.num_disparities);
    const uint16_t own = args.levels[radius][x];
    args.out[x] = own < kOccluded ? static_cast<uint16_t>(whole_level(own) << kLevelShift) : level;
  }
}

// --- median_weighted

namespace {

constexpr int32_t kMaxTaps = ((2 * kMaxMedianRadius + 1) * (2 * kMaxMedianRadius + 1) + 1) / 2 + 1;

struct Tap {
  uint16_t level, weight;
};

int32_t gather(const MedianWeightedArgs& args, int32_t x, Tap* taps) {
  const int32_t radius = args.radius;
  const uint8_t* center = args.lab[radius] + x;
  taps[0] = Tap{args.levels[radius][x], static_cast<uint16_t>(args.checked[x] < kOccluded ? args.own_bonus : 0)};
  int32_t count = 1;
  for (int32_t dy = -radius; dy <= radius; ++dy) {
    if (args.levels[dy + radius] == nullptr) continue;
    for (int32_t dx = -radius; dx <= radius; ++dx) {
      if ((dx + dy) % 2 != 0 || x + dx < 0 || x + dx >= args.width) continue;
      const uint32_t color = sad(center, args.lab[dy + radius] + x + dx, args.plane_stride, args.planes);
      const uint32_t exponent =
          (std::min(color, 255u) * args.color_scale >> 8) + args.distance_steps[std::abs(dy) * (radius + 1) + std::abs(dx)];
      taps[count++] = Tap{args.levels[dy + radius][x + dx], args.weights[std::min(exponent, 127u)]};
    }
  }
  return count;
}

bool is_flat(const MedianWeightedArgs& args, int32_t x) {
  for (int32_t dy = -1; dy <= 1; ++dy) {
    const uint16_t* levels = args.levels[args.radius + dy];
    for (int32_t i = std::max(0, x - 1); levels != nullptr && i <= std::min(x + 1, args.width - 1); ++i) {
      if (levels[i] != args.levels[args.radius][x]) return false;
    }
  }
  return true;
}

}  // namespace

uint64_t median_by_sorting_scratch(const KernelShape&) {
  return sizeof(Tap) * kMaxTaps;
}

void median_by_sorting(const MedianWeightedArgs& args) {
  Tap* taps = static_cast<Tap*>(args.scratch);
  for (int32_t x = 0; x < args.width; ++x) {
    const uint16_t own = args.out[x] = args.levels[args.radius][x];
    if (is_flat(args, x)) continue;  // what the map is, not how it is computed
    const int32_t count = gather(args, x, taps);
    std::sort(taps, taps + count, [](const Tap& a, const Tap& b) { return a.level < b.level; });
    uint32_t total = 0, below = 0, above = 0;
    for (int32_t i = 0; i < count; ++i) {
      total += taps[i].weight;
      below += taps[i].level < own ? taps[i].weight : 0u;
      above += taps[i].level > own ? taps[i].weight : 0u;
    }
    if (2 * below <= total && 2 * above <= total) continue;
    uint32_t up_to = 0;
    int32_t i = 0;
    while (2 * (up_to += taps[i].weight) < total) ++i;
    args.out[x] = taps[i].level;
  }
}

}  // namespace bsm::bench
