// Input pixels of every format to RGB, eight at once, for color_lab.
#ifndef BSM_SIMD_ARM_PIXELS_NEON_H
#define BSM_SIMD_ARM_PIXELS_NEON_H

#include "simd/arm/neon.h"
#include "simd/kernels.h"
#include "simd/yuv.h"

namespace bsm {
namespace {

constexpr int32_t kPixelsAtOnce = 8;

struct Rgb {
  uint8x8_t r, g, b;
};

// 76 R + 150 G + 29 B, as luma_from_rgb.
inline uint16x8_t weigh_luma(const Rgb& pixel) {
  const uint16x8_t rg = vmlal_u8(vmull_u8(pixel.r, vdup_n_u8(76)), pixel.g, vdup_n_u8(150));
  return vmlal_u8(rg, pixel.b, vdup_n_u8(29));
}

// Formats: `bytes` of a pixel in plane 0; pixels x..x + 7, x a multiple of 8; their luma.
template <int32_t kRed, int32_t kBlue>
struct Rgb24 {
  static constexpr int32_t bytes = 3;
  static Rgb load(const ColorLabArgs& args, int32_t x) {
    const uint8x8x3_t pixel = vld3_u8(args.source + ptrdiff_t{x} * bytes);
    return Rgb{pixel.val[kRed], pixel.val[1], pixel.val[kBlue]};
  }
  static uint16x8_t luma(const ColorLabArgs&, int32_t, const Rgb& pixel) { return weigh_luma(pixel); }
};

template <int32_t kRed, int32_t kBlue>
struct Rgba32 {
  static constexpr int32_t bytes = 4;
  static Rgb load(const ColorLabArgs& args, int32_t x) {
    const uint8x8x4_t pixel = vld4_u8(args.source + ptrdiff_t{x} * bytes);
    return Rgb{pixel.val[kRed], pixel.val[1], pixel.val[kBlue]};
  }
  static uint16x8_t luma(const ColorLabArgs&, int32_t, const Rgb& pixel) { return weigh_luma(pixel); }
};

// Bits are replicated downwards, so that full scale stays full scale.
struct Rgb565 {
  static constexpr int32_t bytes = 2;
  static Rgb load(const ColorLabArgs& args, int32_t x) {
    const uint8x8x2_t pixel = vld2_u8(args.source + ptrdiff_t{x} * bytes);
    const uint8x8_t r = vand_u8(pixel.val[1], vdup_n_u8(0xf8));
    const uint8x8_t g = vand_u8(vsri_n_u8(vshl_n_u8(pixel.val[1], 5), pixel.val[0], 3), vdup_n_u8(0xfc));
    const uint8x8_t b = vshl_n_u8(pixel.val[0], 3);
    return Rgb{vorr_u8(r, vshr_n_u8(r, 5)), vorr_u8(g, vshr_n_u8(g, 6)), vorr_u8(b, vshr_n_u8(b, 5))};
  }
  static uint16x8_t luma(const ColorLabArgs&, int32_t, const Rgb& pixel) { return weigh_luma(pixel); }
};

// channel_from_yuv of four pixels: the conversion clamps at 0, the next one at 255.
inline uint16x4_t add_chroma(uint16x4_t y, int32x4_t term) {
  return vqshrun_n_s32(vaddq_s32(vreinterpretq_s32_u32(vshll_n_u16(y, 16)), term), 16);
}

// Chroma of eight pixels: u and v of each pair in turn.
inline Rgb rgb_from_yuv(uint8x8_t y, uint8x8_t u, uint8x8_t v) {
  const int16x8_t cu = vreinterpretq_s16_u16(vsubl_u8(u, vdup_n_u8(128)));
  const int16x8_t cv = vreinterpretq_s16_u16(vsubl_u8(v, vdup_n_u8(128)));
  const uint16x8_t whole = vmovl_u8(y);
  const int32x4_t half = vdupq_n_s32(1 << 15);
  uint16x4_t r[2], g[2], b[2];
  BSM_UNROLL
  for (int32_t i = 0; i < 2; ++i) {
    const int32x4_t u4 = vmovl_s16(i == 0 ? vget_low_s16(cu) : vget_high_s16(cu));
    const int32x4_t v4 = vmovl_s16(i == 0 ? vget_low_s16(cv) : vget_high_s16(cv));
    const uint16x4_t y4 = i == 0 ? vget_low_u16(whole) : vget_high_u16(whole);
    r[i] = add_chroma(y4, vmlaq_n_s32(half, v4, kRedOfV));
    g[i] = add_chroma(y4, vmlaq_n_s32(vmlaq_n_s32(half, u4, -kGreenOfU), v4, -kGreenOfV));
    b[i] = add_chroma(y4, vmlaq_n_s32(half, u4, kBlueOfU));
  }
  return Rgb{vqmovn_u16(vcombine_u16(r[0], r[1])), vqmovn_u16(vcombine_u16(g[0], g[1])),
             vqmovn_u16(vcombine_u16(b[0], b[1]))};
}

inline uint16x8_t luma_of_y(uint8x8_t y) {
  return vmull_u8(y, vdup_n_u8(255));
}

template <int32_t kU>
struct SemiPlanar {
  static constexpr int32_t bytes = 1;
  static Rgb load(const ColorLabArgs& args, int32_t x) {
    const uint8x8_t chroma = vld1_u8(args.chroma + x);
    const uint8x8x2_t each = vtrn_u8(chroma, chroma);  // of both pixels of a pair
    return rgb_from_yuv(vld1_u8(args.source + x), each.val[kU], each.val[1 - kU]);
  }
  static uint16x8_t luma(const ColorLabArgs& args, int32_t x, const Rgb&) { return luma_of_y(vld1_u8(args.source + x)); }
};

struct Yuyv {
  static constexpr int32_t bytes = 2;
  static Rgb load(const ColorLabArgs& args, int32_t x) {
    const uint8x8x2_t pixel = vld2_u8(args.source + ptrdiff_t{x} * bytes);
    const uint8x8x2_t each = vtrn_u8(pixel.val[1], pixel.val[1]);
    return rgb_from_yuv(pixel.val[0], each.val[0], each.val[1]);
  }
  static uint16x8_t luma(const ColorLabArgs& args, int32_t x, const Rgb&) {
    return luma_of_y(vld2_u8(args.source + ptrdiff_t{x} * bytes).val[0]);
  }
};

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_PIXELS_NEON_H
