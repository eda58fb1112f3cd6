// winner_sums for AVX2 and SSE4.2: the minimum of the levels in registers, its first place from a word of compare results.
// Bound, per pixel and register: 2 loads, 1 minimum, 1 compare and its move to a word; a division per pixel for the
// fraction. Include after the levels of one instruction set.
#ifndef BSM_SIMD_X86_WINNER_SUMS_LANES_H
#define BSM_SIMD_X86_WINNER_SUMS_LANES_H

#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLevelsInWord = 32;                     // two bits each
constexpr int32_t kInWord = kLevelsInWord / kLevelLanes;  // registers

// Equiangular fit in sixteenths: floor(8 (a - b) / larger + 1/2), at most 7.
inline int32_t fraction(int32_t left, int32_t center, int32_t right) {
  const int32_t a = left - center;
  const int32_t b = right - center;
  const int32_t larger = a < b ? b : a;
  if (larger == 0) return 0;
  // The numerator is never negative: a - b >= -larger.
  const int32_t rounded = (16 * (a - b) + 17 * larger) / (2 * larger) - 8;
  return rounded < 7 ? rounded : 7;
}

// The levels of one pixel; kRegisters: how many they take, 0: any number.
template <int32_t kRegisters>
struct Finder {
  int32_t count;  // registers
  LastLanes last;

  explicit Finder(int32_t num_disparities)
      : count(kRegisters != 0 ? kRegisters : (num_disparities + kLevelLanes - 1) / kLevelLanes),
        last(num_disparities - (count - 1) * kLevelLanes) {}

  Bytes load_register(const uint16_t* sums, int32_t i) const {
    return i + 1 < count ? load(sums + i * kLevelLanes) : last.load_from(sums + i * kLevelLanes);
  }

  // Two bits for each of the 32 levels from register `first` on that equal `wanted`.
  uint64_t places(const uint16_t* sums, int32_t first, Bytes wanted) const {
    uint64_t word = 0;
    BSM_UNROLL
    for (int32_t i = 0; i < kInWord; ++i) {
      if (first + i >= count) break;
      word |= uint64_t{static_cast<Word>(signs(equal16(load_register(sums, first + i), wanted)))} << (i * kLanes);
    }
    return word;
  }

  int32_t find(const uint16_t* sums, uint32_t* smallest) const {
    Bytes least = load_register(sums, 0);
    BSM_UNROLL
    for (int32_t i = 1; i < count; ++i) least = min16(least, load_register(sums, i));
    *smallest = least_lane(least);
    const Bytes wanted = set16(static_cast<int32_t>(*smallest));
    if (kRegisters != 0) {  // at most 64 levels: no branch that depends on the winner
      const uint64_t low = places(sums, 0, wanted);
      const uint64_t high = places(sums, kInWord, wanted);
      return (low != 0 ? 0 : kLevelsInWord) + (__builtin_ctzll(low != 0 ? low : high) >> 1);
    }
    for (int32_t i = 0;; i += kInWord) {
      const uint64_t word = places(sums, i, wanted);
      if (word != 0) return i * kLevelLanes + (__builtin_ctzll(word) >> 1);
    }
  }
};

template <int32_t kRegisters>
BSM_NOINLINE void find_row(const WinnerSumsArgs& args) {
  const Finder<kRegisters> finder(args.num_disparities);
  for (int32_t x = 0; x < args.width; ++x) {
    const uint16_t* sums = args.sum + ptrdiff_t{x} * args.stride;
    uint32_t smallest;
    const int32_t winner = finder.find(sums, &smallest);
    int32_t sixteenths = winner << kLevelShift;
    if (smallest == kNoCost) {
      sixteenths = kNoLevel;
    } else if (args.subpixel != 0 && 0 < winner && winner + 1 < args.num_disparities && sums[winner - 1] != kNoCost &&
               sums[winner + 1] != kNoCost) {
      sixteenths += fraction(sums[winner - 1], static_cast<int32_t>(smallest), sums[winner + 1]);
    }
    args.level[x] = static_cast<uint16_t>(sixteenths);
  }
}

template <int32_t kRegisters = 1>
inline void find_winners(const WinnerSumsArgs& args) {
  constexpr int32_t kMost = 2 * kInWord;
  const int32_t registers = (args.num_disparities + kLevelLanes - 1) / kLevelLanes;
  if constexpr (kRegisters > kMost) {
    find_row<0>(args);
  } else {
    if (registers == kRegisters) return find_row<kRegisters>(args);
    find_winners<kRegisters + 1>(args);
  }
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_WINNER_SUMS_LANES_H
