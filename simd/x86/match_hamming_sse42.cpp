// match_hamming, POPCNT: 64-bit words, the XOR shared by both views.
// A winner is the least of cost and level in one word, so that ties need no order. Counting of a candidate above 512 bits
// stops, eight words at a time, once neither view can win. Bound, per word of a candidate and both views: 1 XOR, 2 ANDs, 2
// population counts, 2 additions; 4 loads; then for each view 2 to make a key and 1 for the lesser. Four units do them, one
// of which alone counts: 8.5 cycles for 256 bits, 128 for 4096.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include <nmmintrin.h>

#include "simd/kernels.h"
#include "simd/x86/hamming_blocks.h"

namespace bsm {
namespace {

constexpr uint32_t kNoWinner = 0xffffffffu;  // its lower half is kNoLevel
constexpr int32_t kCostShift = 16;
constexpr int32_t kStopWords = 8;

struct Costs {
  uint32_t left, right;
};

template <bool kMasked, int32_t kWords>
inline Costs count(View left, View right) {
  uint64_t left_count = 0, right_count = 0;
  BSM_UNROLL
  for (int32_t i = 0; i < 8 * kWords; i += 8) {
    const uint64_t differing = load_word(left.descriptors + i) ^ load_word(right.descriptors + i);
    left_count += static_cast<uint64_t>(_mm_popcnt_u64(kMasked ? differing & load_word(left.masks + i) : differing));
    if (kMasked) right_count += static_cast<uint64_t>(_mm_popcnt_u64(differing & load_word(right.masks + i)));
  }
  return Costs{static_cast<uint32_t>(left_count), static_cast<uint32_t>(kMasked ? right_count : left_count)};
}

// Out of line, where the four pointers stay in registers.
template <bool kMasked>
BSM_NOINLINE Costs count_stop_words(const uint8_t* left, const uint8_t* left_mask, const uint8_t* right,
                                    const uint8_t* right_mask) {
  return count<kMasked, kStopWords>(View{left, left_mask}, View{right, right_mask});
}

// Counts a candidate of any length; may stop when the left count is above left_limit and the right count above right_limit.
template <bool kMasked>
inline Costs count_until(View left, View right, int32_t words, uint32_t left_limit, uint32_t right_limit) {
  Costs costs{0, 0};
  for (; words >= kStopWords; words -= kStopWords) {
    const Costs more = count_stop_words<kMasked>(left.descriptors, left.masks, right.descriptors, right.masks);
    costs.left += more.left;
    costs.right += more.right;
    if (costs.left > left_limit && costs.right > right_limit) return costs;
    left = left.from(8 * kStopWords);
    right = right.from(8 * kStopWords);
  }
  for (; words > 0; --words) {
    const Costs more = count<kMasked, 1>(left, right);
    costs.left += more.left;
    costs.right += more.right;
    left = left.from(8);
    right = right.from(8);
  }
  return costs;
}

// kWords: words of a descriptor, 0 for any number.
template <bool kMasked, int32_t kWords>
BSM_NOINLINE void match_row(const MatchHammingArgs& row) {
  const MatchHammingArgs args = row;  // a copy, which the levels written cannot change
  const int32_t words = kWords != 0 ? kWords : args.bits / 64;
  const ptrdiff_t bytes = ptrdiff_t{8} * words;
  uint32_t* const right_best = static_cast<uint32_t*>(args.scratch);
  for (int32_t x = 0; x < args.width; ++x) right_best[x] = kNoWinner;
  View left{args.left, args.left_mask};
  for (int32_t x = 0; x < args.width; ++x, left = left.from(bytes)) {
    // Candidates are right pixels x - min_disparity - level within the row.
    const int32_t farthest = x - args.min_disparity;
    const int32_t first = farthest < args.width ? 0 : farthest - args.width + 1;
    const int32_t last = farthest < args.num_disparities - 1 ? farthest : args.num_disparities - 1;
    const int32_t nearest = farthest - first;
    View right = View{args.right, args.right_mask}.from(nearest * bytes);
    uint32_t* best = right_best + nearest;
    uint32_t left_best = kNoWinner;
    uint32_t level = static_cast<uint32_t>(first) << kLevelShift;
    for (int32_t rest = last - first; rest >= 0; --rest) {
      Costs costs;
      if constexpr (kWords != 0) {
        costs = count<kMasked, kWords>(left, right);
      } else {
        costs = count_until<kMasked>(left, right, words, left_best >> kCostShift, *best >> kCostShift);
      }
      const uint32_t left_winner = costs.left << kCostShift | level;
      const uint32_t right_winner = costs.right << kCostShift | level;
      const uint32_t right_winner_so_far = *best;
      left_best = left_winner < left_best ? left_winner : left_best;
      *best = right_winner < right_winner_so_far ? right_winner : right_winner_so_far;
      --best;
      right = right.from(-bytes);
      level += 1u << kLevelShift;
    }
    args.left_level[x] = static_cast<uint16_t>(left_best);
  }
  for (int32_t x = 0; x < args.width; ++x) args.right_level[x] = static_cast<uint16_t>(right_best[x]);
}

}  // namespace

uint64_t match_hamming_sse42_scratch(const KernelShape& shape) {
  return uint64_t{4} * static_cast<uint32_t>(shape.width);
}

void match_hamming_sse42(const MatchHammingArgs& args) {
  if (args.left_mask == nullptr) return match_row<false, 0>(args);  // for studies: any length alike
  with_words<8>(args.bits / 64, [&](auto words) { match_row<true, decltype(words)::kCount>(args); });
}

}  // namespace bsm
#endif
