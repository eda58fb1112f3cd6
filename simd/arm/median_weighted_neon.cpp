// median_weighted, NEON: sixteen neighbouring pixels at once, tap by tap; groups whose pixels all keep their level are left
// out. Where colours that differ by 64 or more weigh nothing, a tap's weights by colour are a table; else they take an
// exponent. From a pixel's own level the search goes from one level of its window to the next. Bound, per tap and sixteen
// pixels: 7 operations and 7 loads for the weights from tables, else 18 and 4; 12 and 4 for the sums, 12 and 4 for each step
// of the search.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "simd/arm/columns.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 16;
constexpr int32_t kMostSide = 2 * kMaxMedianRadius + 1;
constexpr int32_t kMostTaps = (kMostSide * kMostSide + 1) / 2;
constexpr int32_t kColumns = kLanes + 2 * kMaxMedianRadius + kColumnsAtOnce;  // that a group looks at
constexpr ptrdiff_t kPlane = kMostSide * kColumns;                            // of a group's own colours

constexpr int32_t kEvenTaps = kMostTaps + kMostTaps % 2;  // the sums take two at once
constexpr int32_t kColors = 64;                           // of a tap's table

// The pixels of the window: levels and colours of their rows, moved by dx.
struct Taps {
  const uint16_t* levels[kEvenTaps];
  const uint8_t* lab[kMostTaps];
  const uint8_t* inside[kMostTaps];  // of a group at an end of the row: all bits set where the tap is in the image
};

struct Scratch {
  uint8_t weights[kEvenTaps * kLanes];                                       // by tap, then by pixel
  uint8_t tables[(kMaxMedianRadius + 1) * (kMaxMedianRadius + 1)][kColors];  // as distance_steps
  const uint8_t* table[kMostTaps];
  uint8_t distance[kMostTaps];
  Taps row_taps;  // in the rows, at x = 0
  Taps end_taps;  // in the copies below, at the first pixel of the group
  uint16_t levels[kMostSide][kColumns];
  uint8_t lab[3 * kPlane];
  uint8_t inside[kColumns];
  uint16_t out[kLanes];
};

// How colours become weights.
struct Weighing {
  Table128 table;
  bool short_reach;  // the taps' tables hold the weights
};

// The pixels that a group works on: pointers of taps are `x` pixels before the group's own.
struct Group {
  const Taps* taps;
  int32_t count;
  ptrdiff_t x;
  ptrdiff_t plane_stride;
  const uint16_t* rows[3];  // levels above, at and below the group's first pixel; nullptr outside the image
  const uint8_t* lab;       // colours of the group's first pixel
};

// All ones where the pixel and its eight neighbours hold one level, for eight pixels.
inline uint16x8_t flat_pixels(const Group& group, int32_t at) {
  const uint16x8_t own = vld1q_u16(group.rows[1] + at);
  uint16x8_t flat = vdupq_n_u16(0xffff);
  for (const uint16_t* row : group.rows) {
    if (row == nullptr) continue;
    flat = vandq_u16(flat, vceqq_u16(own, vld1q_u16(row + at - 1)));
    flat = vandq_u16(flat, vceqq_u16(own, vld1q_u16(row + at)));
    flat = vandq_u16(flat, vceqq_u16(own, vld1q_u16(row + at + 1)));
  }
  return flat;
}

// Exponents of eight colour differences: floor(c * scale / 256); the doubled product's upper half of c * 128 and scale.
inline uint16x8_t color_steps(uint8x8_t sad, int16_t scale) {
  const int16x8_t shifted = vreinterpretq_s16_u16(vshll_n_u8(sad, 7));
  return vreinterpretq_u16_s16(vqdmulhq_n_s16(shifted, scale));
}

// Weights by SAD, saturated at 255.
struct ByExponent {
  const Table128& table;
  const uint8_t* distance;  // by tap
  int16_t scale;
  inline uint8x16_t operator()(int32_t tap, uint8x16_t sad) const {
    const uint8x16_t steps =
        vcombine_u8(vqmovn_u16(color_steps(vget_low_u8(sad), scale)), vqmovn_u16(color_steps(vget_high_u8(sad), scale)));
    return look_up(table, vminq_u8(vqaddq_u8(steps, vdupq_n_u8(distance[tap])), vdupq_n_u8(127)));
  }
};

struct ByColor {
  const uint8_t* const* table;  // by tap
  inline uint8x16_t operator()(int32_t tap, uint8x16_t sad) const { return look_up(load_table64(table[tap]), sad); }
};

template <int32_t kPlanes, bool kEnd, class Weigh>
inline void weigh_taps_by(const Group& group, const Weigh& weigh, uint8_t* weights) {
  uint8x16_t center[kPlanes];
  ptrdiff_t offset[kPlanes];
  BSM_UNROLL
  for (int32_t plane = 0; plane < kPlanes; ++plane) {
    center[plane] = vld1q_u8(group.lab + plane * group.plane_stride);
    offset[plane] = group.x + plane * group.plane_stride;
  }
  const Taps& taps = *group.taps;
  const auto weight_of = [&](int32_t i) {
    const uint8_t* lab = taps.lab[i];
    uint8x16_t sad = vabdq_u8(center[0], vld1q_u8(lab + offset[0]));
    BSM_UNROLL
    for (int32_t plane = 1; plane < kPlanes; ++plane) {
      sad = vqaddq_u8(sad, vabdq_u8(center[plane], vld1q_u8(lab + offset[plane])));
    }
    const uint8x16_t weight = weigh(i, sad);
    return kEnd ? vandq_u8(weight, vld1q_u8(taps.inside[i])) : weight;
  };
  int32_t i = 0;
  for (; i + 1 < group.count; i += 2, weights += 2 * kLanes) {
    const uint8x16_t first = weight_of(i);
    const uint8x16_t second = weight_of(i + 1);
    vst1q_u8(weights, first);
    vst1q_u8(weights + kLanes, second);
  }
  if (i < group.count) {
    vst1q_u8(weights, weight_of(i));
    vst1q_u8(weights + kLanes, vdupq_n_u8(0));
  }
}

template <int32_t kPlanes, bool kEnd>
void weigh_taps(const MedianWeightedArgs& args, const Group& group, const Weighing& weighing, Scratch& scratch) {
  if (weighing.short_reach) {
    weigh_taps_by<kPlanes, kEnd>(group, ByColor{scratch.table}, scratch.weights);
  } else {
    const int16_t scale = static_cast<int16_t>(args.color_scale);
    weigh_taps_by<kPlanes, kEnd>(group, ByExponent{weighing.table, scratch.distance, scale}, scratch.weights);
  }
}

// Adds the weight where the flags are set.
inline uint16x8_t add_where(uint16x8_t sum, uint16x8_t flags, uint16x8_t weight) {
  return vmlsq_u16(sum, flags, weight);
}

// Sums of the weights by their levels: below and above the pixel's own.
struct Sums {
  uint16x8_t below, above, total;

  inline void add(uint16x8_t own, uint16x8_t level, uint16x8_t weight) {
    below = add_where(below, vcltq_u16(level, own), weight);
    above = add_where(above, vcgtq_u16(level, own), weight);
    total = vaddq_u16(total, weight);
  }
};

// A step of the search: the weights below the current level, the next lower level.
struct Lower {
  uint16x8_t weight, level;

  inline void add(uint16x8_t current, uint16x8_t other, uint16x8_t its_weight) {
    const uint16x8_t lower = vcltq_u16(other, current);
    weight = add_where(weight, lower, its_weight);
    level = vmaxq_u16(level, vandq_u16(other, lower));
  }
};

// Weighted medians of eight pixels.
uint16x8_t find_medians(const Group& group, const Scratch& scratch, int32_t at, uint16x8_t bonus) {
  const uint16x8_t own = vld1q_u16(group.rows[1] + at);
  const ptrdiff_t offset = group.x + at;
  const uint16_t* const* levels = group.taps->levels;
  const uint16_t* const* const end = levels + group.count;
  const auto level_at = [offset](const uint16_t* tap) { return vld1q_u16(tap + offset); };
  const auto weight_at = [](const uint8_t* weight) { return vmovl_u8(vld1_u8(weight)); };
  const uint16x8_t zero = vdupq_n_u16(0);
  Sums sums{zero, zero, bonus};
  const uint8_t* weight = scratch.weights + at;
  for (const uint16_t* const* tap = levels; tap < end; tap += 2, weight += 2 * kLanes) {
    sums.add(own, level_at(tap[0]), weight_at(weight));
    sums.add(own, level_at(tap[1]), weight_at(weight + kLanes));
  }
  // The search goes down; where the median is above, in complemented levels. There, the weight below a level may be half.
  const uint16x8_t up = vcgtq_u16(sums.above, vsubq_u16(sums.total, sums.above));
  const uint16x8_t down = vcgtq_u16(sums.below, vsubq_u16(sums.total, sums.below));
  uint16x8_t searching = vorrq_u16(up, down);
  uint16x8_t current = veorq_u16(own, up);
  if (most16(searching) == 0) return own;
  const uint16x8_t limit = vsubq_u16(sums.total, up);  // total, or total + 1
  uint16x8_t next = zero;
  for (const uint16_t* const* tap = levels; tap < end; tap += 2) {
    const uint16x8_t a = veorq_u16(level_at(tap[0]), up);
    const uint16x8_t b = veorq_u16(level_at(tap[1]), up);
    next = vmaxq_u16(next, vmaxq_u16(vandq_u16(a, vcltq_u16(a, current)), vandq_u16(b, vcltq_u16(b, current))));
  }
  do {
    current = vbslq_u16(searching, next, current);
    Lower lower{zero, zero};
    weight = scratch.weights + at;
    for (const uint16_t* const* tap = levels; tap < end; tap += 2, weight += 2 * kLanes) {
      lower.add(current, veorq_u16(level_at(tap[0]), up), weight_at(weight));
      lower.add(current, veorq_u16(level_at(tap[1]), up), weight_at(weight + kLanes));
    }
    next = lower.level;
    searching = vandq_u16(searching, vcgeq_u16(lower.weight, vsubq_u16(limit, lower.weight)));
  } while (most16(searching) != 0);
  return veorq_u16(current, up);
}

// All ones in the lanes of `checked` that hold a level.
inline uint16x8_t trusted(const uint16_t* checked) {
  return vcltq_u16(vld1q_u16(checked), vdupq_n_u16(kOccluded));
}

// Sixteen pixels to out; checked: sixteen values.
template <int32_t kPlanes, bool kEnd>
void smooth_group(const MedianWeightedArgs& args, const Group& group, const uint16_t* checked, const Weighing& weighing,
                  Scratch& scratch, uint16_t* out) {
  bool weighed = false;
  for (int32_t at = 0; at < kLanes; at += 8) {
    const uint16x8_t own = vld1q_u16(group.rows[1] + at);
    const uint16x8_t flat = flat_pixels(group, at);
    if (least16(flat) != 0) {
      vst1q_u16(out + at, own);
      continue;
    }
    if (!weighed) weigh_taps<kPlanes, kEnd>(args, group, weighing, scratch);
    weighed = true;
    const uint16x8_t bonus = vandq_u16(trusted(checked + at), vdupq_n_u16(static_cast<uint16_t>(args.own_bonus)));
    vst1q_u16(out + at, vbslq_u16(flat, own, find_medians(group, scratch, at, bonus)));
  }
}

// The window's taps in the rows and in a group's copies of them.
int32_t list_taps(const MedianWeightedArgs& args, Scratch& scratch) {
  const int32_t radius = args.radius;
  int32_t count = 0;
  for (int32_t dy = -radius; dy <= radius; ++dy) {
    const int32_t row = dy + radius;
    if (args.levels[row] == nullptr) continue;
    const int32_t first_step = (dy < 0 ? -dy : dy) * (radius + 1);
    for (int32_t dx = -radius + (row & 1); dx <= radius; dx += 2, ++count) {
      const int32_t step = first_step + (dx < 0 ? -dx : dx);
      const ptrdiff_t column = dx + radius;
      scratch.distance[count] = args.distance_steps[step];
      scratch.table[count] = scratch.tables[step];
      scratch.row_taps.levels[count] = args.levels[row] + dx;
      scratch.row_taps.lab[count] = args.lab[row] + dx;
      scratch.end_taps.levels[count] = scratch.levels[row] + column;
      scratch.end_taps.lab[count] = scratch.lab + row * kColumns + column;
      scratch.end_taps.inside[count] = scratch.inside + column;
    }
  }
  if (count % 2 != 0) {  // one more, that weighs nothing
    scratch.row_taps.levels[count] = scratch.row_taps.levels[0];
    scratch.end_taps.levels[count] = scratch.end_taps.levels[0];
  }
  return count;
}

// True where colours from kColors on weigh nothing: weights fall with their exponents.
inline bool has_short_reach(const MedianWeightedArgs& args) {
  const uint32_t steps = (kColors * args.color_scale) >> 8;
  return args.weights[steps < 127 ? steps : 127] == 0;
}

// The weights of all colours by distance, for the distances of taps: columns and rows away add up to an even number.
void fill_tables(const MedianWeightedArgs& args, const Table128& table, Scratch& scratch) {
  alignas(16) static constexpr uint8_t kLane[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  const ByExponent weigh{table, args.distance_steps, static_cast<int16_t>(args.color_scale)};
  const int32_t side = args.radius + 1;
  for (int32_t dy = 0; dy < side; ++dy) {
    for (int32_t dx = dy & 1; dx < side; dx += 2) {
      const int32_t step = dy * side + dx;
      uint8x16_t weights[kColors / kLanes];
      uint8x16_t color = vld1q_u8(kLane);
      for (uint8x16_t& weight : weights) {
        weight = weigh(step, color);
        color = vaddq_u8(color, vdupq_n_u8(kLanes));
      }
      store_table64(weights, scratch.tables[step]);
    }
  }
}

// Outside the row its last pixel is repeated.
template <class T>
inline void copy_row(const T* row, int32_t width, int32_t first, int32_t count, T* out) {
  copy_columns(row, width, first, count, row[0], row[width - 1], out);
}

inline int32_t within_lanes(int32_t count) {
  return count < 0 ? 0 : count < kLanes ? count : kLanes;
}

void copy_window(const MedianWeightedArgs& args, int32_t x, Scratch& scratch) {
  const int32_t radius = args.radius;
  const int32_t count = kLanes + 2 * radius;
  for (int32_t row = 0; row <= 2 * radius; ++row) {
    if (args.levels[row] == nullptr) continue;
    copy_row(args.levels[row], args.width, x - radius, count, scratch.levels[row]);
    for (int32_t plane = 0; plane < args.planes; ++plane) {
      copy_row(args.lab[row] + plane * args.plane_stride, args.width, x - radius, count,
               scratch.lab + plane * kPlane + row * kColumns);
    }
  }
  for (int32_t i = 0; i < count; i += kLanes) {
    const int32_t first = x - radius + i;
    vst1q_u8(scratch.inside + i, vbicq_u8(first_lanes(within_lanes(args.width - first)), first_lanes(within_lanes(-first))));
  }
}

// Some of the pixels of a group that needs pixels beyond the row.
template <int32_t kPlanes>
void smooth_end(const MedianWeightedArgs& args, int32_t x, int32_t pixels, int32_t taps, const Weighing& weighing,
                Scratch& scratch) {
  copy_window(args, x, scratch);
  const int32_t radius = args.radius;
  Group group{&scratch.end_taps, taps, 0, kPlane, {}, scratch.lab + radius * kColumns + radius};
  for (int32_t i = 0; i < 3; ++i) {
    const int32_t row = radius - 1 + i;
    group.rows[i] = args.levels[row] == nullptr ? nullptr : scratch.levels[row] + radius;
  }
  uint16_t checked[kLanes] = {};
  BSM_MEMCPY(checked, args.checked + x, static_cast<size_t>(pixels) * sizeof *checked);
  smooth_group<kPlanes, true>(args, group, checked, weighing, scratch, scratch.out);
  BSM_MEMCPY(args.out + x, scratch.out, static_cast<size_t>(pixels) * sizeof *args.out);
}

template <int32_t kPlanes>
void smooth_row(const MedianWeightedArgs& args, Scratch& scratch) {
  const Weighing weighing{load_table128(args.weights), has_short_reach(args)};
  if (weighing.short_reach) fill_tables(args, weighing.table, scratch);
  const int32_t taps = list_taps(args, scratch);
  const int32_t radius = args.radius;
  int32_t pixels;
  for (int32_t x = 0; x < args.width; x += pixels) {
    // The first group ends where the next one looks at the row's first pixel.
    pixels = x < radius ? radius : kLanes;
    if (x < radius || x + kLanes + radius > args.width) {
      if (pixels > args.width - x) pixels = args.width - x;
      smooth_end<kPlanes>(args, x, pixels, taps, weighing, scratch);
      continue;
    }
    Group group{&scratch.row_taps, taps, x, args.plane_stride, {}, args.lab[radius] + x};
    for (int32_t i = 0; i < 3; ++i) {
      const uint16_t* row = args.levels[radius - 1 + i];
      group.rows[i] = row == nullptr ? nullptr : row + x;
    }
    smooth_group<kPlanes, false>(args, group, args.checked + x, weighing, scratch, args.out + x);
  }
}

}  // namespace

uint64_t median_weighted_neon_scratch(const KernelShape&) {
  return sizeof(Scratch);
}

void median_weighted_neon(const MedianWeightedArgs& args) {
  Scratch& scratch = *static_cast<Scratch*>(args.scratch);
  if (args.planes == 3) {
    smooth_row<3>(args, scratch);
  } else {
    smooth_row<1>(args, scratch);
  }
}

}  // namespace bsm
#endif
