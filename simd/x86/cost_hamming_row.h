// A row of costs in 64-bit words, for machines that count the bits of a word at once.
#ifndef BSM_SIMD_X86_COST_HAMMING_ROW_H
#define BSM_SIMD_X86_COST_HAMMING_ROW_H

#include "simd/x86/cost_hamming_words.h"

namespace bsm {
namespace {

// A row. kWords as in count_words.
template <int32_t kWords>
void count_row(const CostHammingArgs& row) {
  const CostHammingArgs args = row;  // a copy, which the costs written cannot change
  const int32_t bytes = args.bits / 8;
  for (int32_t x = 0; x < args.width; ++x) {
    uint16_t* costs = args.cost + ptrdiff_t{x} * args.stride;
    const LevelRange levels = candidate_levels(args, x);
    const bool none = levels.first > levels.last;
    const int32_t begin = none ? args.stride : levels.first;
    for (int32_t level = 0; level < begin; ++level) costs[level] = kNoCost;
    if (none) continue;
    for (int32_t level = levels.last + 1; level < args.stride; ++level) costs[level] = kNoCost;
    const int32_t disparity = args.min_disparity + levels.first;
    const ptrdiff_t matched = args.view == 0 ? x - disparity : x + disparity;
    const ptrdiff_t at = ptrdiff_t{x} * bytes;
    const Candidates candidates{args.other + matched * bytes, args.view == 0 ? -bytes : bytes, levels.first, levels.last};
    count_words<kWords>(args.own + at, args.own_mask == nullptr ? nullptr : args.own_mask + at, bytes, candidates, costs);
  }
}

inline void count_costs(const CostHammingArgs& args) {
  with_words<4>(args.bits / 64, [&](auto words) { count_row<decltype(words)::kCount>(args); });
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_COST_HAMMING_ROW_H
