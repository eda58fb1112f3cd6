// The contract of the kernels: for each hot stage one argument struct and one function type. The scalar kernels are the
// specification; a kernel of any other instruction set writes the same bytes.
//
// Rules for all kernels: no allocation, no state, no stack array beyond 512 bytes; `scratch` is 64-byte aligned and as large
// as the kernel's scratch function says. Inputs of `width` pixels inside the library may be read up to `width` rounded up to
// the kernel's block, rows of a pattern's window also by its radius on both sides; the caller's pixels (color_lab) and
// outputs are touched within `width` alone.
#ifndef BSM_SIMD_KERNELS_H
#define BSM_SIMD_KERNELS_H

#include <stddef.h>
#include <stdint.h>

#include "bsm/bsm.h"
#include "platform/compiler.h"
#include "simd/isa.h"

namespace bsm {

// A pixel pair of the pattern (eq. 2): offsets from the pixel described, in pixels.
struct PixelPair {
  int8_t px, py, qx, qy;
};

struct PatternOrder;

// The first `bits` pairs of a table; every offset is within -radius..radius.
struct Pattern {
  const PixelPair* pairs;
  int32_t bits;
  int32_t radius;
  const PatternOrder* order;  // for kernels of machines with kOrdersPatterns
};

constexpr int32_t kMaxPatternRadius = 12;
constexpr int32_t kMaxWindowSide = 2 * kMaxPatternRadius + 1;

// Largest SAD of two stored CIELAB colours (eq. 5).
constexpr int32_t kMaxSad = 3 * 255;

// A level is a disparity less min_disparity. Maps inside the library hold levels in 1/16 pixel. A pixel without a disparity
// holds kNoLevel, or kOccluded when it is known that the other view does not show it; the largest level, 4093 * 16 + 15,
// stays below both.
constexpr uint16_t kNoLevel = 0xffff;
constexpr uint16_t kOccluded = 0xfffe;
constexpr int32_t kLevelShift = 4;

// The whole level nearest to a level in 1/16 pixel, halves up. A fraction never leads past the last level.
static inline int32_t whole_level(uint16_t sixteenths) {
  return (sixteenths + 8) >> kLevelShift;
}

// color_lab: one row of input pixels to luma and CIELAB.
// Luma is 76 R + 150 G + 29 B, undivided, so that ties are rare; 255 Y for gray and YUV. CIELAB is stored in 8 bits a
// channel, see simd/lab.h; YUV becomes RGB first, see simd/yuv.h.
struct ColorLabArgs {
  const uint8_t* source;  // width pixels, plane 0; yuyv: width rounded up to even
  const uint8_t* chroma;  // nv12, nv21: (width + 1) / 2 pairs; other formats: not read
  int32_t format;         // bsm_format
  int32_t width;
  uint16_t* luma;          // width values; nullptr: not wanted
  uint8_t* lab;            // plane 0 (L); a and b follow plane_stride and 2 * plane_stride bytes later; nullptr: not wanted
  ptrdiff_t plane_stride;  // between the planes of lab
  int32_t planes;          // 3, or 1 for L alone
};

// descriptor_compare: bit i of pixel x is I(p_i) > I(q_i) (eq. 2, 3).
// A descriptor is bits / 8 bytes; bit i is bit i % 8 of byte i / 8, on every machine.
struct DescriptorCompareArgs {
  const uint16_t* const* rows;  // 2 radius + 1 luma rows, the middle one is the pixel's; x = 0 at the pointer
  int32_t width;
  Pattern pattern;
  uint8_t* out;  // width descriptors, 64-byte aligned
  void* scratch;
};

// mask_threshold: bit i of pixel x is w_i <= T, w_i = max(SAD(x, p_i), SAD(x, q_i)), T the bits/4-th smallest w_i (eq. 5-7).
struct MaskThresholdArgs {
  const uint8_t* const* rows;  // 2 radius + 1 CIELAB rows, planes as in ColorLabArgs; x = 0 at the pointer
  ptrdiff_t plane_stride;
  int32_t planes;
  int32_t width;
  Pattern pattern;
  uint8_t* out;  // width masks in the layout of descriptors, 64-byte aligned
  void* scratch;
};

// match_hamming: masked cost and winner-takes-all of one row, both views (eq. 1, 4, 8).
// Left pixel x and right pixel x - d are a candidate when both lie in the row. Each view counts under its own mask; the
// lowest level wins a tie; a pixel without candidates gets kNoLevel.
struct MatchHammingArgs {
  const uint8_t* left;        // width descriptors
  const uint8_t* right;       // width descriptors
  const uint8_t* left_mask;   // width masks, or nullptr: all bits count (eq. 4)
  const uint8_t* right_mask;  // nullptr exactly when left_mask is
  int32_t width;
  int32_t bits;
  int32_t min_disparity;
  int32_t num_disparities;
  uint16_t* left_level;   // out: width winning levels in 1/16 pixel
  uint16_t* right_level;  // out: width winning levels in 1/16 pixel
  void* scratch;
};

// Semi-global aggregation. Costs and sums of a row are arrays of 16-bit values, `stride` levels a pixel: the num_disparities
// levels of pixel x begin at x * stride. Levels that are no candidate, and those from num_disparities to stride, hold
// kNoCost.
constexpr uint16_t kNoCost = 0xffff;

// cost_hamming: masked costs of all candidates of one row, under the masks of one view (eq. 4, 8).
struct CostHammingArgs {
  const uint8_t* own;       // width descriptors of the view whose costs these are
  const uint8_t* own_mask;  // width masks, or nullptr: all bits count
  const uint8_t* other;     // width descriptors of the other view
  int32_t view;             // 0: own is the left view, pixel x meets x - d; 1: the right view, x meets x + d
  int32_t width;
  int32_t bits;
  int32_t min_disparity;
  int32_t num_disparities;
  int32_t stride;
  uint16_t* cost;  // out: width * stride
  void* scratch;
};

// edge_threshold: 1 where two rows' CIELAB colours differ by a SAD above a threshold, else 0.
struct EdgeThresholdArgs {
  const uint8_t* lab;       // width colours, planes as in ColorLabArgs
  const uint8_t* previous;  // the colours to compare with, pixel by pixel
  ptrdiff_t plane_stride;
  int32_t planes;
  int32_t width;
  int32_t threshold;
  uint8_t* edge;  // out: width flags
  void* scratch;
};

// Costs of a change of one level (p1) and of more (p2) from a pixel to the next of a path; p1 <= p2.
struct Penalties {
  uint16_t p1, p2;
};

// aggregate_along: the paths from the left and from the right,
// L(x, d) = C(x, d) + min(L(x - r, d), L(x - r, d +- 1) + P1, min_k L(x - r, k) + P2) - min_k L(x - r, k),
// added in 16 bits, saturating. A path begins with L = C; a predecessor without candidates adds nothing.
struct AggregateAlongArgs {
  const uint16_t* cost;
  const uint8_t* edge;     // width flags: x against x - 1; edge[0] is not read
  Penalties penalties[2];  // without and with an edge
  int32_t most_cost;       // costs of candidates are at most this
  int32_t width;
  int32_t num_disparities;
  int32_t stride;
  uint16_t* sum;  // out: width * stride, the two paths added
  void* scratch;
};

// aggregate_across: one path from the row before, for pixels begin..end-1; the predecessor of x is x - dx.
struct AggregateAcrossArgs {
  const uint16_t* cost;
  const uint16_t* previous;  // L of the row before; may be current; nullptr: the path begins in this row
  const uint8_t* edge;       // width flags: x against x - dx of the row before
  Penalties penalties[2];
  int32_t dx;  // -1, 0 or 1
  int32_t begin, end;
  int32_t width;
  int32_t num_disparities;
  int32_t stride;
  uint16_t* current;  // out: L of this row
  uint16_t* sum;      // in and out: L is added, saturating
  void* scratch;
};

// winner_sums: the level of the least sum of each pixel, the lowest wins a tie; kNoLevel where every sum is kNoCost.
// With subpixel, the equiangular fit through the neighbours' sums gives a fraction of -8..7 sixteenths:
// a = S(d - 1) - S(d), b = S(d + 1) - S(d), floor(8 (a - b) / max(a, b) + 1/2), at most 7; 0 without two neighbours or with
// a = b = 0. The whole level nearest to the result is the winner.
struct WinnerSumsArgs {
  const uint16_t* sum;
  int32_t width;
  int32_t num_disparities;
  int32_t stride;
  int32_t subpixel;
  uint16_t* level;  // out: width levels in 1/16 pixel
  void* scratch;
};

// vote_weigh: every pixel of a row without a level takes the one with the largest summed weight
// exp(-(c / color + e / distance)) over the pixels of the window that have one (eq. 9, 10); c is the SAD of the two CIELAB
// colours, e the Euclidean distance. All levels are rounded to whole ones first. The window's taps lie
// `step` pixels apart, the pixel itself among them. The lowest level wins a tie; without any vote the pixel gets kNoLevel.
// With `cap`, votes for levels above cap[x] (whole levels) do not count unless there are no others.
struct VoteWeighArgs {
  const uint16_t* const* levels;  // 2 radius + 1 rows of levels in 1/16 pixel; nullptr for rows outside the image
  const uint8_t* const* lab;      // the same rows' CIELAB, planes as in ColorLabArgs
  ptrdiff_t plane_stride;
  int32_t planes;
  int32_t width;
  int32_t radius;  // a multiple of step
  int32_t step;
  int32_t num_disparities;
  const uint16_t* cap;             // width whole levels, or nullptr
  uint32_t color_scale;            // exponent of a SAD c, in table steps: (c * color_scale + 512) >> 10; at most 65535
  const uint16_t* distance_steps;  // exponent of e, in table steps: [|dy| * (radius + 1) + |dx|]
  const uint16_t* weights;         // weight of an exponent in table steps
  int32_t weights_count;           // at most 1024; exponents at or above this weigh nothing
  uint16_t* out;                   // width levels in 1/16 pixel, all of them whole pixels
  void* scratch;
};

// median_weighted: the weighted median of a dense map over every second pixel of a window (dx + dy even), weights falling
// with the SAD of the CIELAB colours and the distance. A pixel keeps its level when the weights below and above it are each
// at most half of all; else it takes the least level up to which the weights add up to at least half. Outside the image
// nothing weighs. The own level of a trusted pixel weighs own_bonus more. A pixel whose 3x3 neighbourhood holds one level
// keeps it.
struct MedianWeightedArgs {
  const uint16_t* const* levels;  // 2 radius + 1 rows of levels, no pixel without one; nullptr for rows outside the image
  const uint8_t* const* lab;      // the same rows' CIELAB, planes as in ColorLabArgs
  ptrdiff_t plane_stride;
  int32_t planes;
  int32_t width;
  int32_t radius;                 // at most kMaxMedianRadius, so that the weights of a window fit 16 bits
  uint32_t color_scale;           // exponent of a SAD c, in table steps: (min(c, 255) * color_scale) >> 8; at most 65535
  const uint8_t* distance_steps;  // exponent of the distance, in table steps: [|dy| * (radius + 1) + |dx|], each at most 127
  const uint8_t* weights;         // 128 weights, none above the one before; an exponent is the sum of the two, at most 127
  const uint16_t* checked;        // width levels after check and border; below kOccluded: the pixel is trusted
  uint32_t own_bonus;             // at most 512
  uint16_t* out;
  void* scratch;
};
constexpr int32_t kMaxMedianRadius = 8;

// fraction_smooth: the weighted mean of the levels in a pixel's 5x5 neighbourhood that lie within one level of its own. With
// e = sum of weight * (level - own level) and w = sum of weight, the own level gets (e * r(w) + 2^14) >> 15 added,
// r(w) = min(2^15 - 1, round(2^15 / w)). Outside the image nothing weighs.
struct FractionSmoothArgs {
  const uint16_t* const* levels;  // 5 rows of levels in 1/16 pixel, no pixel without one; nullptr outside the image
  const uint8_t* const* weights;  // the same rows' weights, 1..kMaxFractionWeight
  int32_t width;
  uint16_t* out;
  void* scratch;
};
constexpr int32_t kFractionRadius = 2;
constexpr int32_t kMaxFractionWeight = 2;  // 25 * 2 * 16 and 2^15 - 1 fit 16 bits

// What a kernel's scratch depends on.
struct KernelShape {
  int32_t width;
  int32_t bits;
  int32_t radius;
  int32_t planes;
  int32_t num_disparities;
};

// What a kernel's block counts: pixels of a row or levels of a pixel.
enum Axis : int32_t { kPixels = 0, kLevels = 1, kAxes = 2 };

// A kernel's signature, written once per stage: color_lab_fn and so on.
#define BSM_STAGE(stage, operation, Args, axis) using stage##_##operation##_fn = void(const Args&);
#include "simd/stages.def"
#undef BSM_STAGE

// Every kernel: the function stage_operation_isa, and the bytes of scratch it needs.
using kernel_scratch_fn = uint64_t(const KernelShape& shape);
#define BSM_KERNEL(stage, operation, isa, required, block) \
  stage##_##operation##_fn stage##_##operation##_##isa;    \
  kernel_scratch_fn stage##_##operation##_##isa##_scratch;
#include "simd/kernels.def"
#undef BSM_KERNEL

// The kernels of one context: chosen once, then constant.
struct Kernels {
#define BSM_STAGE(stage, operation, Args, axis) stage##_##operation##_fn* stage##_##operation;
#include "simd/stages.def"
#undef BSM_STAGE
  const char* name[BSM_KERNEL_COUNT];  // "stage_operation_isa", in the order of simd/stages.def
  kernel_scratch_fn* scratch[BSM_KERNEL_COUNT];
  bool ordered;          // a kernel reads Pattern::order
  int32_t block[kAxes];  // pixels and levels that the widest kernel works on at once: rows are padded to multiples of them
};

// Chooses, for each stage, the last kernel of simd/kernels.def whose required features are all among `features`.
Kernels select_kernels(uint32_t features);

// False when `features` left a stage without a kernel, which takes a build without scalar kernels.
bool is_complete(const Kernels& kernels);

// Bytes of scratch that one job of these kernels needs, at most, for the stages of sgm or else of the local method.
uint64_t kernel_scratch_bytes(const Kernels& kernels, const KernelShape& shape, bool sgm);

}  // namespace bsm

#endif  // BSM_SIMD_KERNELS_H
