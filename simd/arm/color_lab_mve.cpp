// color_lab, MVE: four pixels at once in the formats that interleave R, G and B; scalar in the others.
// Bound, per four pixels: 12 gathers, 4 stores, 92 operations.
#include "platform/compiler.h"

#if BSM_ARCH_MVE
#include "bsm/bsm.h"
#include "simd/arm/mve.h"
#include "simd/build.h"
#include "simd/kernels.h"
#include "simd/lab.h"

namespace bsm {
namespace {

constexpr int32_t kAtOnce = 4;

struct Rgb {
  uint32x4_t r, g, b;
};

inline uint32x4_t look_up(const uint32_t* table, uint32x4_t index) {
  return vldrwq_gather_shifted_offset_u32(table, index);
}

inline uint32x4_t weigh(const Rgb& color, uint32_t r, uint32_t g, uint32_t b) {
  return vmlaq_n_u32(vmlaq_n_u32(vmulq_n_u32(color.r, r), color.g, g), color.b, b);
}

// lab_f of simd/lab.h. Values that take the cube root have at most six leading zeros; others are raised to the least of
// them.
inline uint32x4_t curve(uint32x4_t t) {
  constexpr uint32_t kLeastRoot = 38037066;
  const uint32x4_t raised = vmaxq_u32(t, vdupq_n_u32(kLeastRoot));
  const uint32x4_t octaves = vshrq_n_u32(vmulq_n_u32(vclzq_u32(raised), 11), 5);  // a third of the zeros
  const uint32x4_t m = vshlq_u32(raised, vreinterpretq_s32_u32(vmulq_n_u32(octaves, 3)));
  const uint32x4_t i = vsubq_n_u32(vshrq_n_u32(m, 24), CubeRootTable::kFirst);
  const uint32x4_t fraction = vmovlbq_u16(vreinterpretq_u16_u32(vshrq_n_u32(m, 8)));
  const uint32x4_t low = look_up(kCubeRoot.value, i);
  const uint32x4_t rise = vsubq_u32(look_up(kCubeRoot.value + 1, i), low);
  const uint32x4_t root = vaddq_u32(low, vshrq_n_u32(vmulq_u32(rise, fraction), 16));
  const uint32x4_t line = vaddq_n_u32(vshrq_n_u32(vmulq_n_u32(vshrq_n_u32(t, 6), 3987), 15), 144631);
  return vpselq_u32(vshlq_u32(root, vnegq_s32(vreinterpretq_s32_u32(octaves))), line, vcmpcsq_n_u32(t, kLeastRoot));
}

// (factor * f + offset 2^20) / 2^20, rounded: never negative.
inline uint32x4_t channel(uint32x4_t f, uint32_t factor, int32_t offset) {
  return vshrq_n_u32(vaddq_n_u32(vmulq_n_u32(f, factor), static_cast<uint32_t>(offset * (1 << 20) + (1 << 19))), 20);
}

inline void store_lab(const Rgb& pixel, ptrdiff_t plane_stride, mve_pred16_t kept, uint8_t* lab) {
  const Rgb light{look_up(kLinearLight, pixel.r), look_up(kLinearLight, pixel.g), look_up(kLinearLight, pixel.b)};
  const uint32x4_t fy = curve(weigh(light, 6969, 23434, 2365));
  vstrbq_p_u32(lab, channel(fy, 145, -20), kept);
  const uint32x4_t fx = curve(weigh(light, 14219, 12328, 6221));
  vstrbq_p_u32(lab + plane_stride, channel(vsubq_u32(fx, fy), 625, 108), kept);
  const uint32x4_t fz = curve(weigh(light, 582, 3587, 28599));
  vstrbq_p_u32(lab + 2 * plane_stride, channel(vsubq_u32(fy, fz), 250, 135), kept);
}

// Pixels of `bytes` bytes, of which byte `red` is R and byte `blue` is B.
void convert(const ColorLabArgs& args, int32_t bytes, int32_t red, int32_t blue) {
  const uint8_t* source = args.source;
  const uint32x4_t places = vmulq_n_u32(vidupq_n_u32(0, 1), static_cast<uint32_t>(bytes));
  for (int32_t x = 0; x < args.width; x += kAtOnce, source += kAtOnce * bytes) {
    const mve_pred16_t kept = vctp32q(static_cast<uint32_t>(args.width - x));
    const Rgb pixel{vldrbq_gather_offset_z_u32(source + red, places, kept),
                    vldrbq_gather_offset_z_u32(source + 1, places, kept),
                    vldrbq_gather_offset_z_u32(source + blue, places, kept)};
    if (args.luma != nullptr) vstrhq_p_u32(args.luma + x, weigh(pixel, 76, 150, 29), kept);
    if (args.lab != nullptr) store_lab(pixel, args.plane_stride, kept, args.lab + x);
  }
}

}  // namespace

uint64_t color_lab_mve_scratch(const KernelShape&) {
  return 0;
}

void color_lab_mve(const ColorLabArgs& args) {
  if (!kHasColor) return color_lab_scalar(args);
  switch (args.format) {
    case BSM_FORMAT_RGB24:
      return convert(args, 3, 0, 2);
    case BSM_FORMAT_BGR24:
      return convert(args, 3, 2, 0);
    case BSM_FORMAT_RGBA32:
      return convert(args, 4, 0, 2);
    case BSM_FORMAT_BGRA32:
      return convert(args, 4, 2, 0);
    default:
      return color_lab_scalar(args);
  }
}

}  // namespace bsm
#endif
