// The arithmetic of the bounds. Every number of operations below is that of one vector (or word, or pixel) of work.
#include "bench/kernel_bounds.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "simd/pattern_points.h"

namespace bsm::bench {
namespace {

// scalar: 4 integer ALUs. SSE4.2, AVX2: 3 vector ALUs. AVX-512: 2, one of which alone counts bits and moves lanes (Ice Lake
// to Sapphire Rapids). NEON: 2 vector pipes. x86 and ARM differ in |a - b|: a maximum, a minimum and a subtraction, or one.
constexpr Core kCores[] = {{"scalar", 8, 4.0, 2.0, 1.0, 3.0},
                           {"sse42", 16, 3.0, 2.0, 1.0, 3.0},
                           {"avx2", 32, 3.0, 2.0, 1.0, 3.0},
                           {"avx512", 64, 2.0, 2.0, 1.0, 3.0},
                           {"neon", 16, 2.0, 2.0, 1.0, 1.0}};

// Operations; `single` are those of `alu` that one ALU alone can do.
struct Effort {
  double alu = 0.0, load = 0.0, store = 0.0, single = 0.0;
};

Effort operator+(const Effort& a, const Effort& b) {
  return {a.alu + b.alu, a.load + b.load, a.store + b.store, a.single + b.single};
}
Effort operator*(double times, const Effort& a) {
  return {times * a.alu, times * a.load, times * a.store, times * a.single};
}

double cycles(const Core& core, const Effort& effort) {
  return std::max({effort.alu / core.alus, effort.load / core.loads, effort.store / core.stores, effort.single});
}

bool is(const Core& core, const char* isa) {
  return std::string(core.isa) == isa;
}

// Elements of `bytes` bytes in a vector.
double lanes(const Core& core, int32_t bytes) {
  return is(core, "scalar") ? 1.0 : static_cast<double>(core.bytes) / bytes;
}

// Candidates of a row: pixel x meets x, x - 1 .. within the row.
double candidates(int32_t width, int32_t disparities) {
  const double shown = std::min(width, disparities);
  return width * shown - shown * (shown - 1) / 2;
}

// Words of a vector's pixels to descriptors, per word: signs and a shift for each pixel's share; AVX-512 transposes 64 x 64
// bits by 3 byte operations for each 8 words; a scalar kernel shifts each bit in.
Effort transposed(const Core& core) {
  if (is(core, "scalar")) return {1, 0, 0, 0};
  if (is(core, "avx512")) return {3.0 / 8, 1.0 / 8, 1.0 / 8, 2.0 / 8};
  return {2, 1, 1, 0};
}

// Colours of a window's point against the centre.
Effort sad_of_point(const Core& core, int32_t planes) {
  return {planes * core.distance + planes - 1, 1.0 * planes, 1, 0};
}

// One step of a path per register: two neighbours (moves between lanes), minimum, addition, two more minima, subtraction,
// addition of the cost, minimum for the next step.
constexpr Effort kPathStep = {9, 1, 0, 2};
// Per pixel and path: the least of a register's lanes everywhere (halves are folded down to 128 bits, whose least lane takes
// one operation, and spread again by two), and three operations with it.
Effort path_pixel(const Core& core) {
  if (is(core, "scalar")) return {3, 1, 0, 0};
  double folds = 0.0;
  for (int32_t width = core.bytes; width > 16; width /= 2) ++folds;
  return {2 * folds + 3 + 3, 1, 0, is(core, "avx512") ? folds + 1 : 0};
}

}  // namespace

const Core* core_of(const std::string& isa) {
  for (const Core& core : kCores) {
    if (isa == core.isa) return &core;
  }
  return nullptr;
}

// Three channels of source, three of linear light and two neighbouring cube roots of three: 12 loads a pixel. Vectors load
// the tables lane by lane as well, but both roots as one value: 6 loads. Luma 5, matrix 15 and 3 shifts, three roots of 8,
// three roundings of 3: 56 operations, which vectors share.
double bound_cycles(const Core& core, const ColorLabArgs& args) {
  if (is(core, "scalar")) return cycles(core, args.width * Effort{56, 12, 4, 0});
  return cycles(core, args.width * Effort{56 / lanes(core, 4), 6, 4 / lanes(core, 4), 0});
}

// Per pair: two vectors of luma (one on x86, where the other stays in a register for all pairs of its point) and a compare
// (minimum and equality before AVX-512, whose compares are done by one ALU); two vectors pack to a word of signs.
double bound_cycles(const Core& core, const DescriptorCompareArgs& args) {
  if (is(core, "scalar"))
    return cycles(core, 1.0 * args.width * args.pattern.bits * (Effort{2, 2, 0, 0} + transposed(core)));
  const Effort compares = is(core, "avx512") ? Effort{2 + 1, 2, 1, 2 + 1}
                          : is(core, "neon") ? Effort{2 + 1, 4, 1, 0}
                                             : Effort{4 + 2, 2, 1, 0};
  return cycles(core, args.width / lanes(core, 1) * args.pattern.bits * (compares + transposed(core)));
}

// Every point of the window in use once, two passes of eight thresholds (a byte of results a point: 4 operations; a pair: an
// AND and a carry-save addition of 5; of 2 with three-operand logic, and 2 ANDs and 4 loads for three pairs that share a
// point), a compare with the threshold for each point, an AND for each pair. Scalar: a histogram of the pairs' larger SADs
// instead of the passes, an AND of two results a pair.
double bound_cycles(const Core& core, const MaskThresholdArgs& args) {
  const auto points = std::make_unique<PatternPoints>();
  std::vector<uint32_t> pairs(static_cast<size_t>(args.pattern.bits));
  points->pairs = pairs.data();
  number_points(args.pattern, *points);
  const double n = args.pattern.bits;
  const Effort sads = 1.0 * points->count * sad_of_point(core, args.planes);
  if (is(core, "scalar")) return cycles(core, args.width * (sads + n * (Effort{2 + 1, 3, 1, 0} + Effort{2 + 1, 2, 0, 0})));
  const Effort pair = is(core, "avx512") ? Effort{2 + 2 / 3.0, 4 / 3.0, 0, 0} : Effort{1 + 5, 2, 0, 0};
  const Effort pass = 1.0 * points->count * Effort{4, 1, 1, 0} + n * pair;
  const Effort bits = 1.0 * points->count * Effort{2, 1, 1, 0} + n * (Effort{1, 2, 1, 0} + transposed(core));
  return cycles(core, args.width / lanes(core, 1) * (sads + 2.0 * pass + bits));
}

// Of a vector or word of both views: an XOR, and for each view an AND, the count and an addition; the other view's bits and
// mask are loaded. A count: 12 operations by parallel sums; POPCNT, which one ALU does; 6 with a table of half bytes (AVX2);
// VPOPCNTQ, which one ALU does, with XOR and AND in one three-operand operation. Per candidate: cost and level to one word
// and the lesser of two, in both views. AVX2 and AVX-512: a lane for each of four or eight candidates, so that counts add up
// in place (the first ones need no addition). AVX2 takes 1 more a view to sum bytes; or with long descriptors, for four
// words and a view, 3 carry-save additions of 5, a count and an addition, and 18 a view at the end. Of both views: 4
// operations to make keys (3 with three operands), 2 minima, 1 for the next levels.
double bound_cycles(const Core& core, const MatchHammingArgs& args) {
  const double count = candidates(args.width, args.num_disparities);
  const double words = args.bits / 64.0;
  const Effort winners = {6, 1, 1, 0};
  if (is(core, "scalar")) return cycles(core, count * (words * Effort{1 + 2 * 14, 2, 0, 0} + winners));
  const Core& scalar = kCores[0];
  if (is(core, "sse42")) return cycles(scalar, count * (words * Effort{1 + 2 * 3, 2, 0, 2} + winners));
  if (is(core, "avx2")) {
    const Effort keys = {4 + 2 + 1, 1, 1, 0};
    if (args.bits <= 256) return cycles(core, count / 4 * (words * Effort{1 + 2 * 8, 4, 0, 0} + keys));
    const Effort four = {4 + 2 * (4 + 3 * 5 + 7), 16, 0, 0};
    return cycles(core, count / 4 * (words / 4 * four + Effort{2 * 18, 0, 0, 0} + keys));
  }
  if (is(core, "avx512")) {
    return cycles(core, count / 8 * (words * Effort{2 * 3, 2, 0, 2} + Effort{6 - 2, 1, 1, 0}));
  }
  return cycles(core, count * (words / 2 * Effort{1 + 2 * 3, 2, 0, 0} + 0.25 * winners));
}

// The same under one view's mask, every cost written. SSE4.2: four costs of up to 192 bits to one word by 6 operations.
// AVX-512: a lane for each of eight candidates, whose sums one move puts into 16 bits and in order. AVX2: every 8 vectors of
// counts of 16 candidates are packed to one by 7 moves and added in pairs by 1, 4 vectors of 64 bits packed by 3 moves; in
// the mean of both views 5 operations bring the 16 costs in order, 2 those of 64 bits. Other lengths take four candidates at
// once as in match_hamming, below four words without carry-save additions, and 3 operations to put their sums into 16 bits
// and in order.
double bound_cycles(const Core& core, const CostHammingArgs& args) {
  const double count = candidates(args.width, args.num_disparities);
  const double words = args.bits / 64.0;
  const Core& scalar = kCores[0];
  if (is(core, "scalar")) return cycles(core, count * (words * Effort{15, 1, 0, 0} + Effort{1, 0, 1, 0}));
  const double loads = args.bits <= 256 ? 1 : 3;  // longer descriptors and masks do not stay in registers
  if (is(core, "sse42")) {
    const Effort written = args.bits <= 192 ? Effort{6 / 4.0, 0, 1 / 4.0, 0} : Effort{0, 0, 1, 0};
    return cycles(scalar, count * (words * Effort{4, loads, 0, 1} + Effort{-1, 0, 0, 0} + written));
  }
  const double vectors = 8.0 * args.bits / core.bytes / 64.0;  // of a candidate
  const double per_store = lanes(core, 2);
  if (is(core, "avx512")) return cycles(core, count / 8 * (words * Effort{3, 1, 0, 1} + Effort{1 - 1, 0, 1, 1}));
  if (is(core, "avx2")) {
    if (args.bits == 192) return cycles(core, count / 4 * (words * Effort{9, 3, 0, 0} + Effort{3, 0, 1, 0}));
    if (args.bits > 256)
      return cycles(core, count / 4 * (words / 4 * Effort{8 + 3 * 5 + 7, 12, 0, 0} + Effort{18 + 3, 0, 1, 0}));
    const double packed = args.bits == 64 ? 3 + 2 : 8 * args.bits / 128.0 + 5;
    return cycles(core, count / per_store * (per_store * vectors * Effort{9, 1, 0, 0} + Effort{packed, 0, 1, 0}));
  }
  return cycles(core, count / per_store * (per_store * vectors * Effort{4, 1, 0, 0} + Effort{8, 0, 1, 0}));
}

// Two rows' planes, their distances, two saturating additions, a compare of two operations.
double bound_cycles(const Core& core, const EdgeThresholdArgs& args) {
  const Effort pixel = {args.planes * core.distance + args.planes - 1 + 2, 2.0 * args.planes, 1, 0};
  return cycles(core, args.width / lanes(core, 1) * pixel);
}

// Both paths, each with its costs; their sum is written, read, added to and written again. NEON in bytes, where the largest
// cost and twice P2 fit one: costs are narrowed, the first path waits in bytes, sums are made once, by 2 operations.
double bound_cycles(const Core& core, const AggregateAlongArgs& args) {
  if (is(core, "neon") && args.most_cost + 2 * std::max(args.penalties[0].p2, args.penalties[1].p2) <= 254) {
    const Effort sixteen = 2.0 * (kPathStep + Effort{1, 1, 0, 0}) + Effort{2, 1, 3, 0};
    return cycles(core, args.width * (args.num_disparities / lanes(core, 1) * sixteen + 2.0 * path_pixel(core)));
  }
  const double registers = args.num_disparities / lanes(core, 2);
  const Effort pixel = registers * (2.0 * kPathStep + Effort{1, 1, 2, 0}) + 2.0 * path_pixel(core);
  return cycles(core, args.width * pixel);
}

// One path: its row before and its costs are read, the path written, the sum read and written.
double bound_cycles(const Core& core, const AggregateAcrossArgs& args) {
  const double registers = args.num_disparities / lanes(core, 2);
  const Effort pixel = registers * (kPathStep + Effort{1, 2, 2, 0}) + path_pixel(core);
  return cycles(core, (args.end - args.begin) * pixel);
}

// A minimum, a compare and its move to a word for each register; per pixel the least lane, its place (3) and the fraction
// (12 and a division of 6 cycles), which AVX-512 and NEON share among the pixels of a vector.
double bound_cycles(const Core& core, const WinnerSumsArgs& args) {
  const double registers = args.num_disparities / lanes(core, 2);
  const double division = args.subpixel != 0 ? 6.0 : 0.0;
  if (is(core, "scalar"))
    return args.width * (cycles(core, registers * Effort{2, 1, 0, 0} + Effort{12, 3, 1, 0}) + division);
  const Effort vectors = registers * Effort{3, 2, 0, 0} + Effort{path_pixel(core).alu - 3, 0, 0, path_pixel(core).single};
  if (is(core, "avx512") || is(core, "neon")) return args.width * cycles(core, vectors + Effort{3, 3, 1, 0});
  return args.width * (cycles(core, vectors) + cycles(kCores[0], Effort{3 + 12, 3, 1, 0}) + division);
}

// For each neighbour with a level in the window of each pixel without: colours, level, weight and votes are loaded, the
// votes written again; votes of one pixel go to memory one by one in every instruction set. Weights may be found by vectors.
double bound_cycles(const Core& core, const VoteWeighArgs& args) {
  double neighbours = 0.0;
  for (int32_t x = 0; x < args.width; ++x) {
    if (args.levels[args.radius][x] < kOccluded) continue;
    for (int32_t y = 0; y <= 2 * args.radius; y += args.step) {
      for (int32_t dx = -args.radius; dx <= args.radius; dx += args.step) {
        const bool inside = 0 <= x + dx && x + dx < args.width;
        if (inside && args.levels[y][x + dx] < kOccluded) ++neighbours;
      }
    }
  }
  if (is(core, "scalar")) return cycles(core, neighbours * Effort{3 * 3 + 2 + 4, 3 + 4, 1, 0});
  return cycles(core, neighbours * Effort{2, 3, 1, 0});
}

// Every second pixel of the window, were all blocks looked at and all levels right: colours (three distances, two
// additions), a look-up of 4 (a table of 64 in a register) or 16 (four of 16), of 1 from the tap's own table on NEON, two
// compares, two masked additions and one more in both halves of a vector. Blocks that are flat are passed over, pixels that
// move walk on: rows decide which weighs more.
double bound_cycles(const Core& core, const MedianWeightedArgs& args) {
  const int32_t side = 2 * args.radius + 1;
  const double taps = (side * side + 1) / 2;
  const double colours = args.planes * core.distance + args.planes - 1;
  if (is(core, "scalar")) return cycles(core, args.width * taps * Effort{colours + 3 + 5, 1.0 * args.planes + 3, 0, 0});
  const double look_up = is(core, "avx512") ? 4 : is(core, "neon") ? 1 : 16;
  const double loads = args.planes + (is(core, "neon") ? 4 + 3.0 : 3.0);
  return cycles(core, args.width / lanes(core, 1) * taps * Effort{colours + look_up + 2 * 5, loads, 0, 0});
}

// 25 neighbours: 2 loads, and widening, difference, range (3), two masks, product and two additions; the reciprocal (by
// tables of bytes) and the rounding take 25 more. NEON takes sixteen at once: differences (2), their bytes (2), range (2),
// mask, two products and an addition.
double bound_cycles(const Core& core, const FractionSmoothArgs& args) {
  constexpr double kTaps = (2 * kFractionRadius + 1) * (2 * kFractionRadius + 1);
  if (is(core, "scalar")) return cycles(core, args.width * (kTaps * Effort{6, 2, 0, 0} + Effort{4, 1, 1, 0}));
  if (is(core, "neon"))
    return cycles(core, args.width / lanes(core, 1) * (kTaps * Effort{10, 3, 0, 0} + Effort{25, 8, 2, 0}));
  return cycles(core, args.width / lanes(core, 2) * (kTaps * Effort{8, 2, 0, 0} + Effort{25, 8, 1, 0}));
}

}  // namespace bsm::bench
