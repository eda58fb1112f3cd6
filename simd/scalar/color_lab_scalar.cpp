// color_lab, scalar: input pixels to luma and CIELAB, one pixel at a time.
#include "bsm/bsm.h"
#include "simd/build.h"
#include "simd/kernels.h"
#include "simd/lab.h"
#include "simd/yuv.h"

namespace bsm {
namespace {

struct Rgb {
  uint8_t r, g, b;
};

template <int kBytes, int kRed, int kBlue>
struct Interleaved {
  static constexpr int32_t bytes = kBytes;
  static Rgb load(const uint8_t* p) { return Rgb{p[kRed], p[1], p[kBlue]}; }
};

// Bits are replicated downwards, so that full scale stays full scale.
struct Packed565 {
  static constexpr int32_t bytes = 2;
  static Rgb load(const uint8_t* p) {
    const uint32_t r = p[1] >> 3;
    const uint32_t g = ((p[1] & 7u) << 3) | (p[0] >> 5);
    const uint32_t b = p[0] & 31u;
    return Rgb{static_cast<uint8_t>((r << 3) | (r >> 2)), static_cast<uint8_t>((g << 2) | (g >> 4)),
               static_cast<uint8_t>((b << 3) | (b >> 2))};
  }
};

// Where Y of pixel x and the chroma of the pixels x and x + 1 lie, for even x.
template <int kU, int kV>
struct SemiPlanar {
  static constexpr int32_t step = 1, u = kU, v = kV;
  static const uint8_t* chroma(const ColorLabArgs& args, int32_t x) { return args.chroma + x; }
};

struct Yuyv {
  static constexpr int32_t step = 2, u = 1, v = 3;
  static const uint8_t* chroma(const ColorLabArgs& args, int32_t x) { return args.source + ptrdiff_t{x} * step; }
};

void store_lab(const ColorLabArgs& args, int32_t x, Rgb pixel) {
  const Lab lab = lab_from_rgb(pixel.r, pixel.g, pixel.b);
  args.lab[x] = lab.l;
  args.lab[args.plane_stride + x] = lab.a;
  args.lab[2 * args.plane_stride + x] = lab.b;
}

template <class Format>
void convert_color(const ColorLabArgs& args) {
  for (int32_t x = 0; x < args.width; ++x) {
    const Rgb pixel = Format::load(args.source + ptrdiff_t{x} * Format::bytes);
    if (args.luma != nullptr) args.luma[x] = luma_from_rgb(pixel.r, pixel.g, pixel.b);
    if (args.lab != nullptr) store_lab(args, x, pixel);
  }
}

template <class Format>
void convert_yuv(const ColorLabArgs& args) {
  for (int32_t begin = 0; begin < args.width; begin += 2) {
    const uint8_t* chroma = Format::chroma(args, begin);
    const ChromaTerms terms = chroma_terms(chroma[Format::u], chroma[Format::v]);
    const int32_t end = begin + 1 < args.width ? begin + 2 : args.width;
    for (int32_t x = begin; x < end; ++x) {
      const uint8_t y = args.source[ptrdiff_t{x} * Format::step];
      if (args.luma != nullptr) args.luma[x] = luma_from_y(y);
      if (args.lab == nullptr) continue;
      store_lab(args, x, Rgb{channel_from_yuv(y, terms.r), channel_from_yuv(y, terms.g), channel_from_yuv(y, terms.b)});
    }
  }
}

// L' of every gray: a build without colour needs no other part of CIELAB.
struct GrayTable {
  uint8_t l[256];
};

constexpr GrayTable make_gray_table() {
  GrayTable table{};
  for (uint32_t value = 0; value < 256; ++value) table.l[value] = lab_l_from_gray(static_cast<uint8_t>(value));
  return table;
}

constexpr GrayTable kGray = make_gray_table();

void convert_gray(const ColorLabArgs& args) {
  for (int32_t x = 0; x < args.width; ++x) {
    const uint8_t value = args.source[x];
    if (args.luma != nullptr) args.luma[x] = luma_from_y(value);
    if (args.lab != nullptr) args.lab[x] = kGray.l[value];
  }
}

}  // namespace

uint64_t color_lab_scalar_scratch(const KernelShape&) {
  return 0;
}

void color_lab_scalar(const ColorLabArgs& args) {
  if (!kHasColor) return convert_gray(args);
  switch (args.format) {
    case BSM_FORMAT_GRAY8:
      return convert_gray(args);
    case BSM_FORMAT_RGB24:
      return convert_color<Interleaved<3, 0, 2>>(args);
    case BSM_FORMAT_BGR24:
      return convert_color<Interleaved<3, 2, 0>>(args);
    case BSM_FORMAT_RGBA32:
      return convert_color<Interleaved<4, 0, 2>>(args);
    case BSM_FORMAT_BGRA32:
      return convert_color<Interleaved<4, 2, 0>>(args);
    case BSM_FORMAT_NV12:
      return convert_yuv<SemiPlanar<0, 1>>(args);
    case BSM_FORMAT_NV21:
      return convert_yuv<SemiPlanar<1, 0>>(args);
    case BSM_FORMAT_YUYV:
      return convert_yuv<Yuyv>(args);
    default:
      return convert_color<Packed565>(args);
  }
}

}  // namespace bsm
