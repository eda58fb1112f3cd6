// match_hamming, scalar: masked cost and winner-takes-all of one row, both views (eq. 1, 4, 8).
#include "simd/kernels.h"
#include "simd/scalar/bits.h"

namespace bsm {
namespace {

constexpr uint32_t kNoCost = 0xffffffffu;

struct Costs {
  uint32_t left, right;
};

struct Pixel {
  const uint8_t* descriptor;
  const uint8_t* mask;
};

constexpr uint64_t kAll = ~uint64_t{0};

// Costs of a candidate under both masks; the XOR is shared. Counting stops once neither view can win: when the left count
// has reached left_limit and the right count right_limit. kMasked = false counts every bit (eq. 4).
template <bool kMasked>
Costs hamming(Pixel left, Pixel right, int32_t words, uint32_t left_limit, uint32_t right_limit) {
  Costs costs{0, 0};
  for (int32_t i = 0; i < words; i += 3) {
    uint64_t differing[3] = {0, 0, 0};
    uint64_t left_mask[3] = {kAll, kAll, kAll};
    uint64_t right_mask[3] = {kAll, kAll, kAll};
    for (int32_t k = 0; k < 3 && i + k < words; ++k) {
      const ptrdiff_t at = ptrdiff_t{i + k} * 8;
      differing[k] = load_bits(left.descriptor + at) ^ load_bits(right.descriptor + at);
      if (kMasked) {
        left_mask[k] = load_bits(left.mask + at);
        right_mask[k] = load_bits(right.mask + at);
      }
    }
    costs.left += count_bits(differing[0] & left_mask[0], differing[1] & left_mask[1], differing[2] & left_mask[2]);
    if (kMasked) {
      costs.right += count_bits(differing[0] & right_mask[0], differing[1] & right_mask[1], differing[2] & right_mask[2]);
    } else {
      costs.right = costs.left;
    }
    if (costs.left >= left_limit && costs.right >= right_limit) break;
  }
  return costs;
}

template <bool kMasked>
void match_row(const MatchHammingArgs& args) {
  const ptrdiff_t bytes = args.bits / 8;
  uint32_t* right_best = static_cast<uint32_t*>(args.scratch);
  for (int32_t x = 0; x < args.width; ++x) {
    right_best[x] = kNoCost;
    args.right_level[x] = kNoLevel;
  }
  for (int32_t x = 0; x < args.width; ++x) {
    // Candidates are right pixels x - min_disparity - level within the row.
    const int32_t farthest = x - args.min_disparity;
    const int32_t first = farthest < args.width ? 0 : farthest - args.width + 1;
    const int32_t last = farthest < args.num_disparities - 1 ? farthest : args.num_disparities - 1;
    const Pixel left{args.left + x * bytes, kMasked ? args.left_mask + x * bytes : nullptr};
    uint32_t best = kNoCost;
    uint16_t best_level = kNoLevel;
    for (int32_t level = first; level <= last; ++level) {
      const int32_t xr = farthest - level;
      const Pixel right{args.right + xr * bytes, kMasked ? args.right_mask + xr * bytes : nullptr};
      const Costs costs = hamming<kMasked>(left, right, args.bits / 64, best, right_best[xr]);
      // Both views meet their candidates in ascending order of level: a later one wins only when it is cheaper.
      if (costs.left < best) {
        best = costs.left;
        best_level = static_cast<uint16_t>(level << kLevelShift);
      }
      if (costs.right < right_best[xr]) {
        right_best[xr] = costs.right;
        args.right_level[xr] = static_cast<uint16_t>(level << kLevelShift);
      }
    }
    args.left_level[x] = best_level;
  }
}

}  // namespace

uint64_t match_hamming_scalar_scratch(const KernelShape& shape) {
  return uint64_t{4} * static_cast<uint32_t>(shape.width);
}

void match_hamming_scalar(const MatchHammingArgs& args) {
  if (args.left_mask != nullptr) {
    match_row<true>(args);
  } else {
    match_row<false>(args);
  }
}

}  // namespace bsm
