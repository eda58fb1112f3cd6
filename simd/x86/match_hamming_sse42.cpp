// match_hamming, POPCNT: 64-bit words, the XOR shared by both views.
// Counting of a long candidate stops, eight words at a time, once neither view can win. Bound, per word of a candidate and
// both views: 1 XOR, 2 ANDs, 2 population counts, 2 additions; 4 loads.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include <nmmintrin.h>

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

constexpr int32_t kStopWords = 8;

template <bool kMasked, int32_t kWords>
inline Costs count(Pixel left, Pixel right, ptrdiff_t at) {
  uint64_t left_count = 0, right_count = 0;
  BSM_UNROLL
  for (int32_t i = 0; i < kWords; ++i, at += 8) {
    const uint64_t differing = load_word(left.descriptor + at) ^ load_word(right.descriptor + at);
    if (kMasked) {
      left_count += static_cast<uint64_t>(_mm_popcnt_u64(differing & load_word(left.mask + at)));
      right_count += static_cast<uint64_t>(_mm_popcnt_u64(differing & load_word(right.mask + at)));
    } else {
      left_count += static_cast<uint64_t>(_mm_popcnt_u64(differing));
    }
  }
  return Costs{static_cast<uint32_t>(left_count), static_cast<uint32_t>(kMasked ? right_count : left_count)};
}

// Descriptors of exactly kWords words.
template <bool kMasked, int32_t kWords>
void match_short(const MatchHammingArgs& args) {
  match_row<kMasked>(args,
                     [](Pixel left, Pixel right, uint32_t, uint32_t) { return count<kMasked, kWords>(left, right, 0); });
}

template <bool kMasked>
void match_any(const MatchHammingArgs& args) {
  const int32_t words = args.bits / 64;
  match_row<kMasked>(args, [words](Pixel left, Pixel right, uint32_t left_limit, uint32_t right_limit) {
    Costs costs{0, 0};
    int32_t i = 0;
    for (; i + kStopWords <= words; i += kStopWords) {
      const Costs more = count<kMasked, kStopWords>(left, right, ptrdiff_t{i} * 8);
      costs.left += more.left;
      costs.right += more.right;
      if (costs.left > left_limit && costs.right > right_limit) return costs;
    }
    for (; i < words; ++i) {
      const Costs more = count<kMasked, 1>(left, right, ptrdiff_t{i} * 8);
      costs.left += more.left;
      costs.right += more.right;
    }
    return costs;
  });
}

template <bool kMasked>
void match(const MatchHammingArgs& args) {
  switch (args.bits / 64) {
    case 1:
      return match_short<kMasked, 1>(args);
    case 2:
      return match_short<kMasked, 2>(args);
    case 4:
      return match_short<kMasked, 4>(args);
    default:
      return match_any<kMasked>(args);
  }
}

}  // namespace

uint64_t match_hamming_sse42_scratch(const KernelShape& shape) {
  return uint64_t{4} * static_cast<uint32_t>(shape.width);
}

void match_hamming_sse42(const MatchHammingArgs& args) {
  if (args.left_mask != nullptr) {
    match<true>(args);
  } else {
    match<false>(args);
  }
}

}  // namespace bsm
#endif
