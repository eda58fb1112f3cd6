// median_weighted, NEON: sixteen neighbouring pixels at once, tap by tap; groups whose pixels all keep their level are left
// out. From a pixel's own level the search goes from one level of its window to the next. Bound, per tap and sixteen pixels:
// 18 operations and 4 loads for the weights, 16 and 4 for the sums, 20 and 8 for each step of the search.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "simd/arm/neon.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 16;
constexpr int32_t kMostSide = 2 * kMaxMedianRadius + 1;
constexpr int32_t kMostTaps = (kMostSide * kMostSide + 1) / 2;
constexpr int32_t kColumns = kLanes + 2 * kMaxMedianRadius;  // that a group looks at
constexpr ptrdiff_t kPlane = kMostSide * kColumns;           // of a group's own colours

// A pixel of the window: levels and colours of its row, moved by dx.
struct Tap {
  const uint16_t* levels;
  const uint8_t* lab;
  const uint8_t* inside;  // of a group at an end of the row: all bits set where the tap is in the image
  uint8_t distance;
};

struct Scratch {
  uint8_t weights[kMostTaps][kLanes];
  Tap row_taps[kMostTaps];  // in the rows, at x = 0
  Tap end_taps[kMostTaps];  // in the copies below, at the first pixel of the group
  uint16_t levels[kMostSide][kColumns];
  uint8_t lab[3 * kPlane];
  uint8_t inside[kColumns];
  uint16_t out[kLanes];
};

// The pixels that a group works on: pointers of taps are `x` pixels before the group's own.
struct Group {
  const Tap* taps;
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

template <int32_t kPlanes, bool kEnd>
void weigh_taps(const MedianWeightedArgs& args, const Group& group, const Table128& table, Scratch& scratch) {
  const int16_t scale = static_cast<int16_t>(args.color_scale);
  uint8x16_t center[kPlanes];
  for (int32_t plane = 0; plane < kPlanes; ++plane) center[plane] = vld1q_u8(group.lab + plane * group.plane_stride);
  for (int32_t i = 0; i < group.count; ++i) {
    const Tap& tap = group.taps[i];
    const uint8_t* lab = tap.lab + group.x;
    uint8x16_t sad = vabdq_u8(center[0], vld1q_u8(lab));
    for (int32_t plane = 1; plane < kPlanes; ++plane) {
      sad = vqaddq_u8(sad, vabdq_u8(center[plane], vld1q_u8(lab + plane * group.plane_stride)));
    }
    const uint8x16_t steps =
        vcombine_u8(vqmovn_u16(color_steps(vget_low_u8(sad), scale)), vqmovn_u16(color_steps(vget_high_u8(sad), scale)));
    const uint8x16_t exponent = vminq_u8(vqaddq_u8(steps, vdupq_n_u8(tap.distance)), vdupq_n_u8(127));
    uint8x16_t weight = look_up(table, exponent);
    if (kEnd) weight = vandq_u8(weight, vld1q_u8(tap.inside));
    vst1q_u8(scratch.weights[i], weight);
  }
}

// Weighted medians of eight pixels.
uint16x8_t find_medians(const Group& group, const Scratch& scratch, int32_t at, uint16x8_t bonus) {
  const uint16x8_t own = vld1q_u16(group.rows[1] + at);
  const ptrdiff_t offset = group.x + at;
  uint16x8_t below = vdupq_n_u16(0);
  uint16x8_t above = below;
  uint16x8_t total = bonus;
  for (int32_t i = 0; i < group.count; ++i) {
    const uint16x8_t level = vld1q_u16(group.taps[i].levels + offset);
    const uint16x8_t weight = vmovl_u8(vld1_u8(scratch.weights[i] + at));
    below = vaddq_u16(below, vandq_u16(weight, vcltq_u16(level, own)));
    above = vaddq_u16(above, vandq_u16(weight, vcgtq_u16(level, own)));
    total = vaddq_u16(total, weight);
  }
  // The search goes down; where the median is above, in complemented levels. There, the weight below a level may be half.
  const uint16x8_t up = vcgtq_u16(above, vsubq_u16(total, above));
  const uint16x8_t down = vcgtq_u16(below, vsubq_u16(total, below));
  uint16x8_t searching = vorrq_u16(up, down);
  uint16x8_t current = veorq_u16(own, up);
  const uint16x8_t limit = vsubq_u16(total, up);  // total, or total + 1
  while (most16(searching) != 0) {
    uint16x8_t next = vdupq_n_u16(0);
    for (int32_t i = 0; i < group.count; ++i) {
      const uint16x8_t level = veorq_u16(vld1q_u16(group.taps[i].levels + offset), up);
      next = vmaxq_u16(next, vandq_u16(level, vcltq_u16(level, current)));
    }
    current = vbslq_u16(searching, next, current);
    below = vdupq_n_u16(0);
    for (int32_t i = 0; i < group.count; ++i) {
      const uint16x8_t level = veorq_u16(vld1q_u16(group.taps[i].levels + offset), up);
      const uint16x8_t weight = vmovl_u8(vld1_u8(scratch.weights[i] + at));
      below = vaddq_u16(below, vandq_u16(weight, vcltq_u16(level, current)));
    }
    searching = vandq_u16(searching, vcgeq_u16(below, vsubq_u16(limit, below)));
  }
  return veorq_u16(current, up);
}

// All ones in the lanes of `checked` that hold a level.
inline uint16x8_t trusted(const uint16_t* checked) {
  return vcltq_u16(vld1q_u16(checked), vdupq_n_u16(kOccluded));
}

// Sixteen pixels to out; checked: sixteen values.
template <int32_t kPlanes, bool kEnd>
void smooth_group(const MedianWeightedArgs& args, const Group& group, const uint16_t* checked, const Table128& table,
                  Scratch& scratch, uint16_t* out) {
  bool weighed = false;
  for (int32_t at = 0; at < kLanes; at += 8) {
    const uint16x8_t own = vld1q_u16(group.rows[1] + at);
    const uint16x8_t flat = flat_pixels(group, at);
    if (least16(flat) != 0) {
      vst1q_u16(out + at, own);
      continue;
    }
    if (!weighed) weigh_taps<kPlanes, kEnd>(args, group, table, scratch);
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
    const uint8_t* steps = args.distance_steps + ptrdiff_t{dy < 0 ? -dy : dy} * (radius + 1);
    for (int32_t dx = -radius + (row & 1); dx <= radius; dx += 2, ++count) {
      const uint8_t distance = steps[dx < 0 ? -dx : dx];
      const ptrdiff_t column = dx + radius;
      scratch.row_taps[count] = Tap{args.levels[row] + dx, args.lab[row] + dx, nullptr, distance};
      scratch.end_taps[count] =
          Tap{scratch.levels[row] + column, scratch.lab + row * kColumns + column, scratch.inside + column, distance};
    }
  }
  return count;
}

// Copies the columns first..first + count - 1 of a row; outside the row its last pixel is repeated.
template <class T>
inline void copy_columns(const T* row, int32_t width, int32_t first, int32_t count, T* out) {
  const int32_t begin = first < 0 ? -first : 0;
  const int32_t end = first + count > width ? width - first : count;
  for (int32_t i = 0; i < begin; ++i) out[i] = row[0];
  BSM_MEMCPY(out + begin, row + first + begin, static_cast<size_t>(end - begin) * sizeof(T));
  for (int32_t i = end; i < count; ++i) out[i] = row[width - 1];
}

void copy_window(const MedianWeightedArgs& args, int32_t x, Scratch& scratch) {
  const int32_t radius = args.radius;
  const int32_t count = kLanes + 2 * radius;
  for (int32_t row = 0; row <= 2 * radius; ++row) {
    if (args.levels[row] == nullptr) continue;
    copy_columns(args.levels[row], args.width, x - radius, count, scratch.levels[row]);
    for (int32_t plane = 0; plane < args.planes; ++plane) {
      copy_columns(args.lab[row] + plane * args.plane_stride, args.width, x - radius, count,
                   scratch.lab + plane * kPlane + row * kColumns);
    }
  }
  for (int32_t i = 0; i < count; ++i) {
    scratch.inside[i] = x - radius + i >= 0 && x - radius + i < args.width ? 0xff : 0;
  }
}

// A group that needs pixels beyond the row.
template <int32_t kPlanes>
void smooth_end(const MedianWeightedArgs& args, int32_t x, int32_t taps, const Table128& table, Scratch& scratch) {
  copy_window(args, x, scratch);
  const int32_t radius = args.radius;
  Group group{scratch.end_taps, taps, 0, kPlane, {}, scratch.lab + radius * kColumns + radius};
  for (int32_t i = 0; i < 3; ++i) {
    const int32_t row = radius - 1 + i;
    group.rows[i] = args.levels[row] == nullptr ? nullptr : scratch.levels[row] + radius;
  }
  const int32_t pixels = args.width - x < kLanes ? args.width - x : kLanes;
  uint16_t checked[kLanes] = {};
  BSM_MEMCPY(checked, args.checked + x, static_cast<size_t>(pixels) * sizeof *checked);
  smooth_group<kPlanes, true>(args, group, checked, table, scratch, scratch.out);
  BSM_MEMCPY(args.out + x, scratch.out, static_cast<size_t>(pixels) * sizeof *args.out);
}

template <int32_t kPlanes>
void smooth_row(const MedianWeightedArgs& args, Scratch& scratch) {
  const Table128 table = load_table128(args.weights);
  const int32_t taps = list_taps(args, scratch);
  const int32_t radius = args.radius;
  for (int32_t x = 0; x < args.width; x += kLanes) {
    if (x < radius || x + kLanes + radius > args.width) {
      smooth_end<kPlanes>(args, x, taps, table, scratch);
      continue;
    }
    Group group{scratch.row_taps, taps, x, args.plane_stride, {}, args.lab[radius] + x};
    for (int32_t i = 0; i < 3; ++i) {
      const uint16_t* row = args.levels[radius - 1 + i];
      group.rows[i] = row == nullptr ? nullptr : row + x;
    }
    smooth_group<kPlanes, false>(args, group, args.checked + x, table, scratch, args.out + x);
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
