// median_weighted, MVE: sixteen neighbouring pixels at once, tap by tap; groups whose pixels all keep their level are left
// out. From a pixel's own level the search goes from one level of its window to the next. Bound, per tap: for sixteen pixels
// 2 gathers, 1 store, 1 operation, and 1 load, 1 operation a plane, for the weights; for eight 2 loads, 4 operations for the
// sums, 3 loads and 6 operations for each step of the search.
#include "platform/compiler.h"

#if BSM_ARCH_MVE
#include "simd/arm/inside.h"
#include "simd/arm/mve.h"
#include "simd/build.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 16;
constexpr int32_t kMostSide = 2 * kMaxMedianRadius + 1;
constexpr int32_t kMostTaps = (kMostSide * kMostSide + 1) / 2;
constexpr uint32_t kMostExponent = 127;
constexpr uint32_t kExponents = kMostExponent + 1;

struct Scratch {
  uint8_t weights[kMostTaps][kLanes];
  uint8_t color_steps[256];           // exponents by colour difference, at most 127
  uint8_t weight_of[2 * kExponents];  // weights by the sum of two exponents
};

// color_scale is below 2^16 (smooth_color_scale), so that the upper half of a product by 256 i is the exponent.
void prepare(const MedianWeightedArgs& args, Scratch& scratch) {
  const uint8x16_t last = vdupq_n_u8(args.weights[kMostExponent]);
  for (uint32_t i = 0; i < kExponents; i += 16) {
    vstrbq_u8(scratch.weight_of + i, vldrbq_u8(args.weights + i));
    vstrbq_u8(scratch.weight_of + kExponents + i, last);
  }
  const uint16x8_t scale = vdupq_n_u16(static_cast<uint16_t>(args.color_scale));
  const uint16x8_t most = vdupq_n_u16(kMostExponent);
  uint16x8_t difference = places(256);
  for (uint32_t i = 0; i < sizeof scratch.color_steps; i += 8) {
    vstrbq_u16(scratch.color_steps + i, vminq_u16(vmulhq_u16(difference, scale), most));
    difference = vaddq_n_u16(difference, 8 * 256);
  }
}

// Calls function(row, x + dx, |dx|, i) for tap i of the window around x.
template <class Function>
inline void for_taps(const MedianWeightedArgs& args, int32_t x, const Function& function) {
  const int32_t radius = args.radius;
  int32_t i = 0;
  for (int32_t row = 0; row <= 2 * radius; ++row) {
    if (args.levels[row] == nullptr) continue;
    int32_t dx = -radius + (row & 1);
    for (int32_t taps = radius + 1 - (row & 1); taps != 0; --taps, dx += 2) function(row, x + dx, dx < 0 ? -dx : dx, i++);
  }
}

// A group near an end of the row has taps outside it, which weigh nothing and are not touched.
template <bool kEnd>
inline uint8x16_t load_lab(const uint8_t* lab, int32_t at, int32_t width) {
  return kEnd ? vldrbq_z_u8(lab + at, static_cast<mve_pred16_t>(columns_inside(at, width))) : vldrbq_u8(lab + at);
}

template <bool kEnd>
inline uint16x8_t load_levels(const uint16_t* levels, int32_t at, int32_t width) {
  return kEnd ? vldrhq_z_u16(levels + at, lanes_inside(at, width)) : vldrhq_u16(levels + at);
}

template <int32_t kPlanes, bool kEnd>
void weigh_taps(const MedianWeightedArgs& args, int32_t x, Scratch& scratch) {
  const int32_t radius = args.radius;
  const ptrdiff_t stride = args.plane_stride;
  uint8x16_t center[kPlanes];
  for (int32_t plane = 0; plane < kPlanes; ++plane) {
    center[plane] = load_lab<kEnd>(args.lab[radius] + plane * stride, x, args.width);
  }
  for_taps(args, x, [&](int32_t row, int32_t at, int32_t dx, int32_t i) {
    const int32_t dy = row < radius ? radius - row : row - radius;
    uint8x16_t sad = vabdq_u8(center[0], load_lab<kEnd>(args.lab[row], at, args.width));
    for (int32_t plane = 1; plane < kPlanes; ++plane) {
      sad = vqaddq_u8(sad, vabdq_u8(center[plane], load_lab<kEnd>(args.lab[row] + plane * stride, at, args.width)));
    }
    const uint8x16_t steps = vldrbq_gather_offset_u8(scratch.color_steps, sad);
    const uint8x16_t exponent = vaddq_n_u8(steps, args.distance_steps[dy * (radius + 1) + dx]);
    uint8x16_t weight = vldrbq_gather_offset_u8(scratch.weight_of, exponent);
    if (kEnd) {
      const mve_pred16_t inside = static_cast<mve_pred16_t>(columns_inside(at, args.width));
      weight = vpselq_u8(weight, vdupq_n_u8(0), inside);
    }
    vstrbq_u8(scratch.weights[i], weight);
  });
}

// Weighted medians of eight of a group's sixteen pixels, those from x on; `half` is 0 or 8.
template <bool kEnd>
uint16x8_t find_medians(const MedianWeightedArgs& args, int32_t x, const Scratch& scratch, int32_t half, uint16x8_t own,
                        uint16x8_t bonus) {
  uint16x8_t below = vdupq_n_u16(0);
  uint16x8_t above = below;
  uint16x8_t total = bonus;
  for_taps(args, x, [&](int32_t row, int32_t at, int32_t, int32_t i) {
    const uint16x8_t level = load_levels<kEnd>(args.levels[row], at, args.width);
    const uint16x8_t weight = vldrbq_u16(scratch.weights[i] + half);
    below = add_where_less(below, weight, level, own);
    above = add_where_less(above, weight, own, level);
    total = vaddq_u16(total, weight);
  });
  // The search goes down; where the median is above, in complemented levels. There, the weight below a level may be half.
  const uint16x8_t up = all_where_less(vsubq_u16(total, above), above);
  const uint16x8_t down = all_where_less(vsubq_u16(total, below), below);
  uint16x8_t searching = vorrq_u16(up, down);
  uint16x8_t current = veorq_u16(own, up);
  const uint16x8_t limit = vsubq_u16(total, up);  // total, or total + 1
  while (most16(searching) != 0) {
    uint16x8_t next = vdupq_n_u16(0);
    for_taps(args, x, [&](int32_t row, int32_t at, int32_t, int32_t) {
      next = most_where_less(next, veorq_u16(load_levels<kEnd>(args.levels[row], at, args.width), up), current);
    });
    current = vorrq_u16(vandq_u16(next, searching), vbicq_u16(current, searching));
    below = vdupq_n_u16(0);
    for_taps(args, x, [&](int32_t row, int32_t at, int32_t, int32_t i) {
      const uint16x8_t level = veorq_u16(load_levels<kEnd>(args.levels[row], at, args.width), up);
      below = add_where_less(below, vldrbq_u16(scratch.weights[i] + half), level, current);
    });
    // Goes on where below >= limit - below.
    searching = vbicq_u16(searching, all_where_less(below, vsubq_u16(limit, below)));
  }
  return veorq_u16(current, up);
}

// All ones where the pixel or one of its eight neighbours inside the image holds another level, for eight pixels.
template <bool kEnd>
inline uint16x8_t uneven_pixels(const MedianWeightedArgs& args, int32_t x, uint16x8_t own) {
  uint16x8_t differing = vdupq_n_u16(0);
  for (int32_t row = args.radius - 1; row <= args.radius + 1; ++row) {
    if (args.levels[row] == nullptr) continue;
    for (int32_t at = x - 1; at <= x + 1; ++at) {
      const uint16x8_t other = veorq_u16(load_levels<kEnd>(args.levels[row], at, args.width), own);
      if (kEnd) {
        differing = vorrq_m_u16(differing, differing, other, lanes_inside(at, args.width));
      } else {
        differing = vorrq_u16(differing, other);
      }
    }
  }
  return all_where_less(vdupq_n_u16(0), differing);
}

template <int32_t kPlanes, bool kEnd>
void smooth_group(const MedianWeightedArgs& args, int32_t x, Scratch& scratch) {
  bool weighed = false;
  for (int32_t half = 0; half < kLanes; half += 8) {
    const int32_t first = x + half;
    const mve_pred16_t inside = lanes_inside(first, args.width);
    if (inside == 0) break;
    const uint16x8_t own = vldrhq_z_u16(args.levels[args.radius] + first, inside);
    uint16x8_t level = own;
    uint16x8_t uneven = uneven_pixels<kEnd>(args, first, own);
    if (most16(uneven) != 0) {
      if (!weighed) weigh_taps<kPlanes, kEnd>(args, x, scratch);
      weighed = true;
      const uint16x8_t checked = vldrhq_z_u16(args.checked + first, inside);
      const uint16x8_t bonus = add_where_less(vdupq_n_u16(0), vdupq_n_u16(static_cast<uint16_t>(args.own_bonus)), checked,
                                              vdupq_n_u16(kOccluded));
      const uint16x8_t median = find_medians<kEnd>(args, first, scratch, half, own, bonus);
      level = vorrq_u16(vandq_u16(median, uneven), vbicq_u16(own, uneven));
    }
    vstrhq_p_u16(args.out + first, level, inside);
  }
}

template <int32_t kPlanes>
void smooth_row(const MedianWeightedArgs& args, Scratch& scratch) {
  for (int32_t x = 0; x < args.width; x += kLanes) {
    if (x < args.radius || x + kLanes + args.radius > args.width) {
      smooth_group<kPlanes, true>(args, x, scratch);
    } else {
      smooth_group<kPlanes, false>(args, x, scratch);
    }
  }
}

}  // namespace

uint64_t median_weighted_mve_scratch(const KernelShape&) {
  return sizeof(Scratch);
}

void median_weighted_mve(const MedianWeightedArgs& args) {
  Scratch& scratch = *static_cast<Scratch*>(args.scratch);
  prepare(args, scratch);
  if (kHasColor && args.planes == 3) {
    smooth_row<3>(args, scratch);
  } else {
    smooth_row<1>(args, scratch);
  }
}

}  // namespace bsm
#endif
