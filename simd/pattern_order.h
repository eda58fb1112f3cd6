// A pattern as the kernels run through it that look at every window offset once, however many pairs it is in.
#ifndef BSM_SIMD_PATTERN_ORDER_H
#define BSM_SIMD_PATTERN_ORDER_H

#include <stdint.h>

#include "platform/compiler.h"
#include "simd/kernels.h"

namespace bsm {

constexpr int32_t kMaxPoints = kMaxWindowSide * kMaxWindowSide;

// The window offsets that a pattern uses, numbered row by row, and its pairs by those numbers.
struct PatternPoints {
  struct Point {
    int8_t dx, dy;
  };
  int32_t count;
  Point points[kMaxPoints];
  uint16_t number[kMaxPoints];  // by window offset
  uint32_t* pairs;              // 8 times the number of point p, 8 times that of q above it: one load for both
};

// Machines whose kernels read the pairs sorted.
#define BSM_SORTS_PAIRS (BSM_ARCH_X86_64 || BSM_ARCH_SIMD128)

#if BSM_SORTS_PAIRS
// The pairs once more, by the points that they share. Points are 8 times their numbers.
struct PatternOrder {
  // The pairs of a point p. Groups are in the order of their size: loops over them turn often, but seldom unforeseen.
  struct Group {
    uint16_t p, size;
  };

  // Up to three pairs that share a point. Where there is none, the point behind the last one stands.
  struct Triple {
    uint16_t shared;
    uint16_t others[3];
  };
  static constexpr int32_t kTripleGroup = 32, kSingleGroup = 64;

  PatternPoints points;
  Group groups[kMaxPoints];
  int32_t groups_count;
  uint32_t* partners;  // of all groups, one after the other: point q, the pair's bit above it
  // All pairs for counting, in threes and one by one (a point, the other one above it). The first ones count twice: many
  // pairs come more than once. Both parts of both lists are filled up to groups.
  Triple* triples;
  uint32_t* singles;
  int32_t triples_count, triples_twice;
  int32_t singles_count, singles_twice;
  // By number, while the order is made: pairs of a point, and the place of its next one.
  uint16_t shares[kMaxPoints];
  uint16_t next[kMaxPoints];
};
#else
struct PatternOrder {
  PatternPoints points;
};
#endif

// Kernels of these machines read Pattern::order.
constexpr bool kOrdersPatterns = BSM_SORTS_PAIRS || BSM_ARCH_NEON;

// Bytes of a pattern's order, and the order made there, 8-byte aligned.
uint64_t pattern_order_bytes(int32_t bits);
const PatternOrder* make_pattern_order(const Pattern& pattern, void* memory);

}  // namespace bsm

#endif  // BSM_SIMD_PATTERN_ORDER_H
