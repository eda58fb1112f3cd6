// median_weighted for AVX2 and SSE4.2: a vector of neighbouring pixels at once, colours and weights in bytes, sums in 16
// bits. Weights are looked up by colour difference in a table of their tap's distance, 16 entries at a time; what weighs
// nothing has no entries. Blocks at the ends of the row are copied, with their windows, to a tile whose columns outside the
// row weigh nothing. Blocks whose pixels all have flat neighbourhoods are passed over. Pixels that move walk up or down the
// levels of their window: a walk passes all taps once for each level between the old and the new. Bound, per tap and block
// of three planes: 11 operations for the colours, 4 for each 16 entries of the table, 18 for the sums. Include after the
// levels of one instruction set.
#ifndef BSM_SIMD_X86_MEDIAN_WEIGHTED_LANES_H
#define BSM_SIMD_X86_MEDIAN_WEIGHTED_LANES_H

#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kHalf = kLanes / 2;
constexpr int32_t kSide = 2 * kMaxMedianRadius + 1;
constexpr int32_t kMaxTaps = (kSide * kSide + 1) / 2;
constexpr int32_t kMaxTables = (kMaxMedianRadius + 1) * (kMaxMedianRadius + 2) / 2;
constexpr int32_t kColors = 256;  // colour differences that weights tell apart
constexpr int32_t kEntries = 16;  // of a table in a register
constexpr int32_t kTileColumns = kLanes + 2 * kMaxMedianRadius;

// A pixel of the window, inside the image's rows.
struct Tap {
  const uint16_t* levels;
  const uint8_t* lab;
  int32_t dx;
  int32_t table;
};

// Half a block: its levels, the weights not below and not above them, and of all.
struct Sums {
  Bytes own, not_below, not_above, all;
  Bytes bonus;  // of the own level, part of all
};

// A block at an end of the row and what lies around it.
struct Tile {
  uint16_t levels[kSide][kTileColumns];
  uint8_t lab[kSide][3][kTileColumns];
  uint8_t inside[kTileColumns];  // all bits: a column of the row
  uint16_t checked[kLanes];
  uint16_t out[kLanes];
};

struct Scratch {
  Sums sums[2];                         // of the block
  uint8_t weight[kMaxTaps][kLanes];     // of the block's pixels, by tap
  uint8_t tables[kMaxTables][kColors];  // weight of a colour difference, by distance
  uint8_t exponent[kColors];            // of a colour difference
  Tap taps[kMaxTaps];
  Tap tile_taps[kMaxTaps];
  const uint16_t* tile_levels[kSide];
  Tile tile;
};

// What stays the same for all pixels of a row.
struct Window {
  const MedianWeightedArgs& args;
  Scratch& scratch;
  int32_t count;   // taps
  int32_t colors;  // colour differences below this weigh something, a multiple of kEntries
};

// A block of pixels: of the row, or of the tile.
struct Block {
  const uint16_t* const* levels;  // 2 radius + 1 rows
  const uint8_t* center;          // CIELAB of the middle row
  const Tap* taps;
  ptrdiff_t plane_stride;
  const uint8_t* inside;    // nullptr: all columns are
  const uint16_t* checked;  // of pixel x
  int32_t x;
};

inline Bytes less_or_equal16(Bytes a, Bytes b) {
  return equal16(min16(a, b), a);
}
inline Bytes complement(Bytes a) {
  return differ(a, ones());
}
inline bool any(Bytes a) {
  return signs(a) != 0;
}

// Weights by colour difference for each distance, and how many differences weigh something.
inline void make_tables(Window& window) {
  const MedianWeightedArgs& args = window.args;
  Scratch& scratch = window.scratch;
  int32_t colors = 0;  // with exponents of their own
  for (; colors < kColors; ++colors) {
    const uint32_t exponent = (static_cast<uint32_t>(colors) * args.color_scale) >> 8;
    if (exponent >= 127 && args.weights[127] == 0) break;
    scratch.exponent[colors] = static_cast<uint8_t>(exponent < 127 ? exponent : 127);
  }
  int32_t weighing = 0;
  for (int32_t dy = 0; dy <= args.radius; ++dy) {
    for (int32_t dx = dy & 1; dx <= args.radius; dx += 2) {
      const uint32_t steps = args.distance_steps[dy * (args.radius + 1) + dx];
      uint8_t* table = scratch.tables[(dy * (args.radius + 2) + dx) / 2];
      for (int32_t color = 0; color < colors; ++color) {
        const uint32_t exponent = scratch.exponent[color] + steps;
        table[color] = args.weights[exponent < 127 ? exponent : 127];
        if (table[color] != 0 && color >= weighing) weighing = color + 1;
      }
      for (int32_t color = colors; color % kEntries != 0; ++color) table[color] = 0;
    }
  }
  window.colors = (weighing + kEntries - 1) / kEntries * kEntries;
}

// The taps inside the image's rows, of the row and of the tile.
inline void list_taps(Window& window) {
  const MedianWeightedArgs& args = window.args;
  Scratch& scratch = window.scratch;
  const int32_t radius = args.radius;
  window.count = 0;
  for (int32_t row = 0; row <= 2 * radius; ++row) {
    const bool exists = args.levels[row] != nullptr;
    scratch.tile_levels[row] = exists ? scratch.tile.levels[row] : nullptr;
    if (!exists) continue;
    const int32_t dy = row - radius;
    for (int32_t dx = -radius + (row & 1); dx <= radius; dx += 2) {
      const int32_t table = ((dy < 0 ? -dy : dy) * (radius + 2) + (dx < 0 ? -dx : dx)) / 2;
      scratch.taps[window.count] = Tap{args.levels[row], args.lab[row], dx, table};
      scratch.tile_taps[window.count++] = Tap{scratch.tile.levels[row], scratch.tile.lab[row][0], dx, table};
    }
  }
}

// Copies the block at x with its window; columns outside the row repeat its ends, which keeps flat neighbourhoods flat.
inline Block copy_block(const Window& window, int32_t x) {
  const MedianWeightedArgs& args = window.args;
  Tile& tile = window.scratch.tile;
  const int32_t radius = args.radius;
  const int32_t last = args.width - 1;
  for (int32_t i = 0; i < kLanes + 2 * radius; ++i) {
    const int32_t at = x - radius + i;
    tile.inside[i] = 0 <= at && at <= last ? 0xff : 0;
  }
  for (int32_t i = 0; i < kLanes; ++i) tile.checked[i] = args.checked[x + i <= last ? x + i : last];
  const int32_t before = x < radius ? radius - x : 0;  // columns before the row's first
  const int32_t end = last + 1 - (x - radius) < kLanes + 2 * radius ? last + 1 - (x - radius) : kLanes + 2 * radius;
  const ptrdiff_t first = x - radius + before;
  for (int32_t row = 0; row <= 2 * radius; ++row) {
    if (args.levels[row] == nullptr) continue;
    uint16_t* levels = tile.levels[row];
    BSM_MEMCPY(levels + before, args.levels[row] + first, static_cast<size_t>(end - before) * sizeof *levels);
    for (int32_t i = 0; i < before; ++i) levels[i] = levels[before];
    for (int32_t i = end; i < kLanes + 2 * radius; ++i) levels[i] = levels[end - 1];
    for (int32_t plane = 0; plane < args.planes; ++plane) {
      BSM_MEMCPY(tile.lab[row][plane] + before, args.lab[row] + plane * args.plane_stride + first,
                 static_cast<size_t>(end - before));
    }
  }
  return Block{window.scratch.tile_levels,
               tile.lab[radius][0],
               window.scratch.tile_taps,
               kTileColumns,
               tile.inside,
               tile.checked,
               radius};
}

// Weights of the colour differences from a table of `colors` entries. A difference outside 16 entries gets its top bit set,
// which looks up 0.
inline Bytes weights_of(const uint8_t* table, int32_t colors, Bytes color) {
  const Bytes range = set8(0x70);
  Bytes weight = zero();
  for (int32_t i = 0; i < colors; i += kEntries) {
    weight = either(weight, look_up(table16(table + i), add8_saturated(color, range)));
    color = sub8(color, set8(kEntries));
  }
  return weight;
}

inline Bytes distance8(Bytes a, Bytes b) {
  return sub8(max8(a, b), min8(a, b));
}

inline void add_tap(Bytes level, Bytes weight, Sums* sums) {
  sums->not_below = add16(sums->not_below, both(weight, less_or_equal16(sums->own, level)));
  sums->not_above = add16(sums->not_above, both(weight, less_or_equal16(level, sums->own)));
  sums->all = add16(sums->all, weight);
}

// Adds up the windows of a block's pixels and keeps their weights.
template <int32_t kPlanes, bool kInside>
BSM_NOINLINE void weigh_block(const Window& window, const Block& block) {
  const MedianWeightedArgs& args = window.args;
  Scratch& scratch = window.scratch;
  Bytes center[kPlanes];
  BSM_UNROLL
  for (int32_t plane = 0; plane < kPlanes; ++plane)
    center[plane] = load(block.center + plane * block.plane_stride + block.x);
  Sums sums[2];
  BSM_UNROLL
  for (int32_t half = 0; half < 2; ++half) {
    const Bytes checked = load(block.checked + half * kHalf);
    const Bytes trusted = less_or_equal16(checked, set16(kOccluded - 1));
    sums[half].own = load(block.levels[args.radius] + block.x + half * kHalf);
    sums[half].bonus = both(trusted, set16(static_cast<int32_t>(args.own_bonus)));
    sums[half].not_below = sums[half].not_above = sums[half].all = sums[half].bonus;
  }
  for (int32_t i = 0; i < window.count; ++i) {
    const Tap& tap = block.taps[i];
    const int32_t at = block.x + tap.dx;
    Bytes color = zero();
    BSM_UNROLL
    for (int32_t plane = 0; plane < kPlanes; ++plane) {
      color = add8_saturated(color, distance8(center[plane], load(tap.lab + plane * block.plane_stride + at)));
    }
    Bytes weight = weights_of(scratch.tables[tap.table], window.colors, color);
    if (!kInside) weight = both(weight, load(block.inside + at));
    store(scratch.weight[i], weight);
    add_tap(load(tap.levels + at), widen(scratch.weight[i]), &sums[0]);
    add_tap(load(tap.levels + at + kHalf), widen(scratch.weight[i] + kHalf), &sums[1]);
  }
  scratch.sums[0] = sums[0];
  scratch.sums[1] = sums[1];
}

// The weighted medians of the pixels of half a block that `moving` holds, the own levels of the others; `down`: the median
// lies below. Levels of pixels that move down are complemented, so that all walk up, until the weight up to their level is
// at least half of all; walking down, more than half, as the median is the least level up to which at least half lies.
BSM_NOINLINE Bytes walk(const Window& window, const Block& block, int32_t half, Bytes moving, Bytes down) {
  const Sums& sums = window.scratch.sums[half];
  const Bytes more = either(both(sums.all, set16(1)), both(down, set16(1)));
  const Bytes wanted = add16(right16<1>(sums.all), more);
  Bytes level = differ(sums.own, down);
  Bytes median = level;
  while (true) {
    Bytes weight = sums.bonus;
    Bytes next = ones();
    for (int32_t i = 0; i < window.count; ++i) {
      const Tap& tap = block.taps[i];
      const Bytes other = differ(load(tap.levels + block.x + half * kHalf + tap.dx), down);
      const Bytes within = less_or_equal16(other, level);
      weight = add16(weight, both(within, widen(window.scratch.weight[i] + half * kHalf)));
      next = min16(next, either(other, within));
    }
    const Bytes done = both(moving, less_or_equal16(wanted, weight));
    median = choose(median, level, done);
    moving = both(moving, complement(done));
    if (!any(moving)) return differ(median, down);
    level = next;
  }
}

// Where the 3x3 neighbourhood of half a block's pixels holds one level.
inline Bytes flat_pixels(const Block& block, int32_t radius, int32_t half) {
  const int32_t x = block.x + half * kHalf;
  const Bytes own = load(block.levels[radius] + x);
  Bytes flat = ones();
  for (int32_t row = radius - 1; row <= radius + 1; ++row) {
    const uint16_t* levels = block.levels[row];
    if (levels == nullptr) continue;
    BSM_UNROLL
    for (int32_t dx = -1; dx <= 1; ++dx) flat = both(flat, equal16(load(levels + x + dx), own));
  }
  return flat;
}

// kAll: blocks whose pixels all keep their levels are weighed as well, to measure what leaving them out saves.
template <int32_t kPlanes, bool kAll>
inline void smooth_block(const Window& window, const Block& block, uint16_t* out) {
  const int32_t radius = window.args.radius;
  Bytes uneven[2];
  BSM_UNROLL
  for (int32_t half = 0; half < 2; ++half) {
    uneven[half] = complement(flat_pixels(block, radius, half));
    store(out + half * kHalf, load(block.levels[radius] + block.x + half * kHalf));
  }
  if (!kAll && !any(either(uneven[0], uneven[1]))) return;
  if (block.inside == nullptr) {
    weigh_block<kPlanes, true>(window, block);
  } else {
    weigh_block<kPlanes, false>(window, block);
  }
  BSM_UNROLL
  for (int32_t half = 0; half < 2; ++half) {
    // One side weighs more than half when it weighs more than the rest; doubled, 16 bits would not hold it.
    const Sums& sums = window.scratch.sums[half];
    const Bytes below = sub16(sums.all, sums.not_below);
    const Bytes above = sub16(sums.all, sums.not_above);
    const Bytes down = both(uneven[half], complement(less_or_equal16(below, sums.not_below)));
    const Bytes up = both(uneven[half], complement(less_or_equal16(above, sums.not_above)));
    const Bytes moving = either(down, up);
    if (any(moving)) store(out + half * kHalf, walk(window, block, half, moving, down));
  }
}

template <int32_t kPlanes, bool kAll>
inline void smooth_blocks(const Window& window) {
  const MedianWeightedArgs& args = window.args;
  const int32_t radius = args.radius;
  for (int32_t x = 0; x < args.width; x += kLanes) {
    if (radius <= x && x + kLanes + radius <= args.width) {
      const Block block{args.levels, args.lab[radius], window.scratch.taps, args.plane_stride, nullptr, args.checked + x, x};
      smooth_block<kPlanes, kAll>(window, block, args.out + x);
    } else {
      const Block block = copy_block(window, x);
      uint16_t* out = window.scratch.tile.out;
      smooth_block<kPlanes, kAll>(window, block, out);
      const int32_t pixels = args.width - x < kLanes ? args.width - x : kLanes;
      BSM_MEMCPY(args.out + x, out, static_cast<size_t>(pixels) * sizeof *args.out);
    }
  }
}

inline uint64_t median_scratch() {
  return sizeof(Scratch);
}

template <bool kAll = false>
inline void smooth_levels(const MedianWeightedArgs& args) {
  Window window{args, *static_cast<Scratch*>(args.scratch), 0, 0};
  make_tables(window);
  list_taps(window);
  return args.planes == 3 ? smooth_blocks<3, kAll>(window) : smooth_blocks<1, kAll>(window);
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_MEDIAN_WEIGHTED_LANES_H
