// color_lab, NEON: eight pixels at once; the last ones of a row and gray, which is one look-up, go one by one.
// Bound, per pixel: its look-ups, three of linear light and three of cube roots, 5 instructions each.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "bsm/bsm.h"
#include "simd/arm/pixels_neon.h"
#include "simd/build.h"
#include "simd/kernels.h"
#include "simd/lab.h"

namespace bsm {
namespace {

constexpr uint32_t kLineEnd = 38037066u;  // below it CIELAB's f is a line

// Linear light of four pixels.
inline uint32x4_t linear_light(const uint8_t* channel) {
  uint32x4_t light = vld1q_dup_u32(kLinearLight + channel[0]);
  light = vld1q_lane_u32(kLinearLight + channel[1], light, 1);
  light = vld1q_lane_u32(kLinearLight + channel[2], light, 2);
  return vld1q_lane_u32(kLinearLight + channel[3], light, 3);
}

// An entry of the table and the next; `at` is 4 times the entry's number.
inline uint32x2_t two_roots(size_t at) {
  const uint8_t* table = reinterpret_cast<const uint8_t*>(kCubeRoot.value);
  return vreinterpret_u32_u8(vld1_u8(table + (at - 4 * CubeRootTable::kFirst)));
}

// lab_f of simd/lab.h for values from kLineEnd on, so that at most two octaves are left out.
inline uint32x4_t cube_root(uint32x4_t t) {
  const uint32x4_t out = vaddq_u32(vcltq_u32(t, vdupq_n_u32(1u << 29)), vcltq_u32(t, vdupq_n_u32(1u << 26)));
  const int32x4_t octaves = vreinterpretq_s32_u32(out);  // less those left out
  const uint32x4_t m = vshlq_u32(t, vsubq_s32(octaves, vshlq_n_s32(octaves, 2)));
  const uint32x4_t at = vbicq_u32(vshrq_n_u32(m, 22), vdupq_n_u32(3));
  const uint32x4_t fraction = vandq_u32(vshrq_n_u32(m, 8), vdupq_n_u32(0xffff));
  const uint32x4x2_t roots = vuzpq_u32(vcombine_u32(two_roots(vgetq_lane_u32(at, 0)), two_roots(vgetq_lane_u32(at, 1))),
                                       vcombine_u32(two_roots(vgetq_lane_u32(at, 2)), two_roots(vgetq_lane_u32(at, 3))));
  const uint32x4_t rise = vsubq_u32(roots.val[1], roots.val[0]);
  return vshlq_u32(vsraq_n_u32(roots.val[0], vmulq_u32(rise, fraction), 16), octaves);
}

inline uint32x4_t lab_f_line(uint32x4_t t) {
  return vsraq_n_u32(vdupq_n_u32(144631), vmulq_n_u32(vshrq_n_u32(t, 6), 3987), 15);
}

// XYZ over the white point of four pixels, then f of it.
struct Xyz {
  uint32x4_t x, y, z;
};

inline uint32x4_t weigh(const uint32x4_t (&light)[3], uint32_t r, uint32_t g, uint32_t b) {
  return vmlaq_n_u32(vmlaq_n_u32(vmulq_n_u32(light[0], r), light[1], g), light[2], b);
}

inline Xyz xyz_of(const uint8_t (&channels)[3][kPixelsAtOnce], int32_t first) {
  uint32x4_t light[3];
  for (int32_t i = 0; i < 3; ++i) light[i] = linear_light(channels[i] + first);
  return Xyz{weigh(light, 14219, 12328, 6221), weigh(light, 6969, 23434, 2365), weigh(light, 582, 3587, 28599)};
}

inline uint32x4_t least(const Xyz& t) {
  return vminq_u32(vminq_u32(t.x, t.y), t.z);
}

inline uint32x4_t lab_f_of(uint32x4_t t, bool dark) {
  if (!dark) return cube_root(t);
  const uint32x4_t line_end = vdupq_n_u32(kLineEnd);
  return vbslq_u32(vcltq_u32(t, line_end), lab_f_line(t), cube_root(vmaxq_u32(t, line_end)));
}

inline Xyz lab_f_of(const Xyz& t, bool dark) {
  return Xyz{lab_f_of(t.x, dark), lab_f_of(t.y, dark), lab_f_of(t.z, dark)};
}

// (factor * f + offset 2^20) / 2^20, rounded, of eight pixels: within a byte.
inline void store_channel(uint32x4_t low, uint32x4_t high, uint32_t factor, int32_t offset, uint8_t* out) {
  const uint32x4_t bias = vdupq_n_u32(static_cast<uint32_t>(offset * (1 << 20) + (1 << 19)));
  const uint16x4_t a = vshrn_n_u32(vmlaq_n_u32(bias, low, factor), 16);
  const uint16x4_t b = vshrn_n_u32(vmlaq_n_u32(bias, high, factor), 16);
  vst1_u8(out, vshrn_n_u16(vcombine_u16(a, b), 4));
}

void store_lab(const ColorLabArgs& args, int32_t x, const Rgb& pixel) {
  uint8_t channels[3][kPixelsAtOnce];
  vst1_u8(channels[0], pixel.r);
  vst1_u8(channels[1], pixel.g);
  vst1_u8(channels[2], pixel.b);
  const Xyz low = xyz_of(channels, 0);
  const Xyz high = xyz_of(channels, 4);
  const bool dark = least32(vminq_u32(least(low), least(high))) < kLineEnd;
  const Xyz a = lab_f_of(low, dark);
  const Xyz b = lab_f_of(high, dark);
  uint8_t* out = args.lab + x;
  store_channel(a.y, b.y, 145, -20, out);
  store_channel(vsubq_u32(a.x, a.y), vsubq_u32(b.x, b.y), 625, 108, out + args.plane_stride);
  store_channel(vsubq_u32(a.y, a.z), vsubq_u32(b.y, b.z), 250, 135, out + 2 * args.plane_stride);
}

// The pixels from x on, one by one.
void convert_rest(const ColorLabArgs& args, int32_t x, int32_t bytes) {
  ColorLabArgs rest = args;
  rest.source += ptrdiff_t{x} * bytes;
  if (rest.chroma != nullptr) rest.chroma += x;
  if (rest.luma != nullptr) rest.luma += x;
  if (rest.lab != nullptr) rest.lab += x;
  rest.width -= x;
  color_lab_scalar(rest);
}

template <class Format>
void convert(const ColorLabArgs& args) {
  int32_t x = 0;
  for (; x + kPixelsAtOnce <= args.width; x += kPixelsAtOnce) {
    const Rgb pixel = Format::load(args, x);
    if (args.luma != nullptr) vst1q_u16(args.luma + x, Format::luma(args, x, pixel));
    if (args.lab != nullptr) store_lab(args, x, pixel);
  }
  convert_rest(args, x, Format::bytes);
}

}  // namespace

uint64_t color_lab_neon_scratch(const KernelShape&) {
  return 0;
}

void color_lab_neon(const ColorLabArgs& args) {
  if (!kHasColor) return color_lab_scalar(args);
  switch (args.format) {
    case BSM_FORMAT_GRAY8:
      return color_lab_scalar(args);
    case BSM_FORMAT_RGB24:
      return convert<Rgb24<0, 2>>(args);
    case BSM_FORMAT_BGR24:
      return convert<Rgb24<2, 0>>(args);
    case BSM_FORMAT_RGBA32:
      return convert<Rgba32<0, 2>>(args);
    case BSM_FORMAT_BGRA32:
      return convert<Rgba32<2, 0>>(args);
    case BSM_FORMAT_NV12:
      return convert<SemiPlanar<0>>(args);
    case BSM_FORMAT_NV21:
      return convert<SemiPlanar<1>>(args);
    case BSM_FORMAT_YUYV:
      return convert<Yuyv>(args);
    default:
      return convert<Rgb565>(args);
  }
}

}  // namespace bsm
#endif
