// One row of winner-takes-all for AVX2 and SSE4.2, candidate by candidate: how to count bits comes from the including file.
#ifndef BSM_SIMD_X86_MATCH_ROW_H
#define BSM_SIMD_X86_MATCH_ROW_H

#include "platform/compiler.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

// A winner so far: cost and level in one word, so that the lesser word is the winner whatever the order, ties included.
constexpr uint32_t kNoWinner = 0xffffffffu;
constexpr int32_t kCostShift = 16;

struct Costs {
  uint32_t left, right;
};

struct Pixel {
  const uint8_t* descriptor;
  const uint8_t* mask;
};

inline uint64_t load_word(const uint8_t* bytes) {
  uint64_t word;
  BSM_MEMCPY(&word, bytes, sizeof word);
  return word;
}

inline uint16_t level_of(uint32_t winner) {
  return winner == kNoWinner ? kNoLevel : static_cast<uint16_t>(winner << kLevelShift);
}

inline uint64_t match_scratch_bytes(const KernelShape& shape) {
  return uint64_t{4} * static_cast<uint32_t>(shape.width);
}

// hamming(left, right, left_limit, right_limit) counts a candidate; it may stop when the left count is above left_limit and
// the right count above right_limit.
template <bool kMasked, class Hamming>
inline void match_row(const MatchHammingArgs& args, const Hamming& hamming) {
  const ptrdiff_t bytes = args.bits / 8;
  uint32_t* right_best = static_cast<uint32_t*>(args.scratch);
  for (int32_t x = 0; x < args.width; ++x) right_best[x] = kNoWinner;
  for (int32_t x = 0; x < args.width; ++x) {
    // Candidates are right pixels x - min_disparity - level within the row.
    const int32_t farthest = x - args.min_disparity;
    const int32_t first = farthest < args.width ? 0 : farthest - args.width + 1;
    const int32_t last = farthest < args.num_disparities - 1 ? farthest : args.num_disparities - 1;
    const Pixel left{args.left + x * bytes, kMasked ? args.left_mask + x * bytes : nullptr};
    uint32_t left_best = kNoWinner;
    for (int32_t level = first; level <= last; ++level) {
      const int32_t xr = farthest - level;
      const Pixel right{args.right + xr * bytes, kMasked ? args.right_mask + xr * bytes : nullptr};
      const Costs costs = hamming(left, right, left_best >> kCostShift, right_best[xr] >> kCostShift);
      const uint32_t number = static_cast<uint32_t>(level);
      const uint32_t left_winner = costs.left << kCostShift | number;
      const uint32_t right_winner = costs.right << kCostShift | number;
      left_best = left_winner < left_best ? left_winner : left_best;
      right_best[xr] = right_winner < right_best[xr] ? right_winner : right_best[xr];
    }
    args.left_level[x] = level_of(left_best);
  }
  for (int32_t x = 0; x < args.width; ++x) args.right_level[x] = level_of(right_best[x]);
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_MATCH_ROW_H
