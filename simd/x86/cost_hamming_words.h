// Masked counts of candidates in 64-bit words, for the cost kernels of x86 with POPCNT and of WebAssembly.
// Short descriptors stay in registers while the candidates pass. Bound, per word of a candidate: 1 XOR, 1 AND, 1 population
// count, 1 addition; 1 load. Up to three words, four costs are stored at once: 6 more.
#ifndef BSM_SIMD_X86_COST_HAMMING_WORDS_H
#define BSM_SIMD_X86_COST_HAMMING_WORDS_H

#include <stdint.h>

#include "platform/compiler.h"
#include "simd/kernels.h"
#include "simd/x86/hamming_blocks.h"

namespace bsm {
namespace {

// Candidates first..last of one pixel; `other` is the first one's descriptor, `step` leads to the next.
struct Candidates {
  const uint8_t* other;
  ptrdiff_t step;
  int32_t first, last;
};

// A descriptor and its mask in registers.
template <int32_t kWords>
struct ShortPixel {
  uint64_t bits[kWords], kept[kWords];

  ShortPixel(const uint8_t* own, const uint8_t* mask) {
    BSM_UNROLL
    for (int32_t i = 0; i < kWords; ++i) {
      bits[i] = load_word(own + 8 * i);
      kept[i] = mask == nullptr ? ~uint64_t{0} : load_word(mask + 8 * i);
    }
  }
  uint64_t count(const uint8_t* other) const {
    uint64_t count = 0;
    BSM_UNROLL
    for (int32_t i = 0; i < kWords; ++i) {
      count += static_cast<uint64_t>(__builtin_popcountll((bits[i] ^ load_word(other + 8 * i)) & kept[i]));
    }
    return count;
  }
};

// kStep: bytes from a candidate to the next.
template <int32_t kWords, ptrdiff_t kStep>
inline void count_short(const uint8_t* own, const uint8_t* mask, const Candidates& candidates, uint16_t* costs) {
  constexpr int32_t kCostsStored = kWords < 4 ? 4 : 1;  // at once; four of more words would spill to memory
  const ShortPixel<kWords> pixel(own, mask);
  const uint8_t* other = candidates.other;
  int32_t level = candidates.first;
  for (; level + kCostsStored - 1 <= candidates.last; level += kCostsStored, other += kCostsStored * kStep) {
    uint64_t four = 0;
    BSM_UNROLL
    for (int32_t i = 0; i < kCostsStored; ++i) four |= pixel.count(other + i * kStep) << (16 * i);
    BSM_MEMCPY(costs + level, &four, 2 * kCostsStored);
  }
  for (; level <= candidates.last; ++level, other += kStep) costs[level] = static_cast<uint16_t>(pixel.count(other));
}

inline void count_long(const uint8_t* own, const uint8_t* mask, int32_t bytes, const Candidates& candidates,
                       uint16_t* costs) {
  const uint8_t* other = candidates.other;
  for (int32_t level = candidates.first; level <= candidates.last; ++level, other += candidates.step) {
    uint64_t count = 0;
    for (int32_t i = 0; i < bytes; i += 8) {
      const uint64_t kept = mask == nullptr ? ~uint64_t{0} : load_word(mask + i);
      count += static_cast<uint64_t>(__builtin_popcountll((load_word(own + i) ^ load_word(other + i)) & kept));
    }
    costs[level] = static_cast<uint16_t>(count);
  }
}

// kWords: 64-bit words of a descriptor, 0 for any number.
template <int32_t kWords>
inline void count_words(const uint8_t* own, const uint8_t* mask, int32_t bytes, const Candidates& candidates,
                        uint16_t* costs) {
  if constexpr (kWords == 0) {
    count_long(own, mask, bytes, candidates, costs);
  } else if (candidates.step < 0) {
    count_short<kWords, -8 * kWords>(own, mask, candidates, costs);
  } else {
    count_short<kWords, 8 * kWords>(own, mask, candidates, costs);
  }
}

// The levels of pixel x that are candidates.
struct LevelRange {
  int32_t first, last;  // none when first > last
};

inline LevelRange candidate_levels(const CostHammingArgs& args, int32_t x) {
  // Levels lead from the pixel that level 0 meets to the row's first pixel for the left view, to its last one for the right
  // view: `origin` pixels away.
  const int32_t origin = args.view == 0 ? x - args.min_disparity : args.width - 1 - x - args.min_disparity;
  return LevelRange{origin < args.width ? 0 : origin - args.width + 1,
                    origin < args.num_disparities - 1 ? origin : args.num_disparities - 1};
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_COST_HAMMING_WORDS_H
