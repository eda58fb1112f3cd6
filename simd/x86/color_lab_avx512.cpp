// color_lab, AVX-512 BW, VBMI: sixteen pixels at once, nothing read or written beyond them.
// Bound: the tables, three gathers of linear light and three of cube roots for sixteen pixels.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include <immintrin.h>

#include "bsm/bsm.h"
#include "simd/kernels.h"
#include "simd/lab.h"
#include "simd/yuv.h"

namespace bsm {
namespace {

constexpr int32_t kPixelsAtOnce = 16;

struct Rgb {
  __m512i r, g, b;  // 32-bit
};

inline __m512i set(uint32_t value) {
  return _mm512_set1_epi32(static_cast<int32_t>(value));
}

inline __m512i gather(const uint32_t* table, __m512i index) {
  return _mm512_i32gather_epi32(index, reinterpret_cast<const int*>(table), 4);
}

// Bits set for the first `count` bytes or lanes.
inline __mmask64 first_bytes(int32_t count) {
  return count == 0 ? 0 : ~uint64_t{0} >> (64 - count);
}

template <int32_t kBytes, int32_t kRed, int32_t kBlue>
struct Interleaved {
  static constexpr int32_t bytes = kBytes;
  static Rgb load(const uint8_t* source, int32_t pixels) {
    const __m512i packed = _mm512_maskz_loadu_epi8(first_bytes(kBytes * pixels), source);
    // Byte 0 of lane i comes from byte kBytes * i + channel.
    const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const __m512i at = _mm512_mullo_epi32(lanes, set(kBytes));
    constexpr __mmask64 kLowBytes = 0x1111111111111111u;
    return Rgb{_mm512_maskz_permutexvar_epi8(kLowBytes, _mm512_add_epi32(at, set(kRed)), packed),
               _mm512_maskz_permutexvar_epi8(kLowBytes, _mm512_add_epi32(at, set(1)), packed),
               _mm512_maskz_permutexvar_epi8(kLowBytes, _mm512_add_epi32(at, set(kBlue)), packed)};
  }
};

struct Packed565 {
  static constexpr int32_t bytes = 2;
  static Rgb load(const uint8_t* source, int32_t pixels) {
    const __m256i packed = _mm256_maskz_loadu_epi16(static_cast<__mmask16>(first_bytes(pixels)), source);
    const __m512i pixel = _mm512_cvtepu16_epi32(packed);
    const __m512i r = _mm512_srli_epi32(pixel, 11);
    const __m512i g = _mm512_and_si512(_mm512_srli_epi32(pixel, 5), set(63));
    const __m512i b = _mm512_and_si512(pixel, set(31));
    return Rgb{_mm512_or_si512(_mm512_slli_epi32(r, 3), _mm512_srli_epi32(r, 2)),
               _mm512_or_si512(_mm512_slli_epi32(g, 2), _mm512_srli_epi32(g, 4)),
               _mm512_or_si512(_mm512_slli_epi32(b, 3), _mm512_srli_epi32(b, 2))};
  }
};

struct Gray {
  static constexpr int32_t bytes = 1;
  static Rgb load(const uint8_t* source, int32_t pixels) {
    const __m512i value = _mm512_cvtepu8_epi32(_mm_maskz_loadu_epi8(static_cast<__mmask16>(first_bytes(pixels)), source));
    return Rgb{value, value, value};
  }
};

// channel_from_yuv of simd/yuv.h.
inline __m512i add_chroma(__m512i y, __m512i term) {
  const __m512i value = _mm512_add_epi32(_mm512_slli_epi32(y, 16), term);
  return _mm512_srli_epi32(_mm512_min_epi32(_mm512_max_epi32(value, _mm512_setzero_si512()), set(0xffffff)), 16);
}

// y, u and v of each lane, as 32-bit values.
inline Rgb rgb_from_yuv(__m512i y, __m512i u, __m512i v) {
  const __m512i cu = _mm512_sub_epi32(u, set(128));
  const __m512i cv = _mm512_sub_epi32(v, set(128));
  const __m512i half = set(1 << 15);
  const __m512i r = _mm512_add_epi32(_mm512_mullo_epi32(cv, set(kRedOfV)), half);
  const __m512i g = _mm512_sub_epi32(
      half, _mm512_add_epi32(_mm512_mullo_epi32(cu, set(kGreenOfU)), _mm512_mullo_epi32(cv, set(kGreenOfV))));
  const __m512i b = _mm512_add_epi32(_mm512_mullo_epi32(cu, set(kBlueOfU)), half);
  return Rgb{add_chroma(y, r), add_chroma(y, g), add_chroma(y, b)};
}

// Y of sixteen pixels and the chroma that each shares with its neighbour.
struct Yuv {
  __m512i y, u, v;
};

template <int32_t kU, int32_t kV>
struct SemiPlanar {
  static Yuv load(const ColorLabArgs& args, int32_t x, int32_t pixels) {
    const __mmask16 kept = static_cast<__mmask16>(first_bytes(pixels));
    const __mmask16 pairs = static_cast<__mmask16>(first_bytes(pixels + (pixels & 1)));
    const __m512i y = _mm512_cvtepu8_epi32(_mm_maskz_loadu_epi8(kept, args.source + x));
    const __m512i chroma = _mm512_cvtepu8_epi32(_mm_maskz_loadu_epi8(pairs, args.chroma + x));
    return Yuv{y, _mm512_shuffle_epi32(chroma, kU == 0 ? _MM_PERM_CCAA : _MM_PERM_DDBB),
               _mm512_shuffle_epi32(chroma, kV == 0 ? _MM_PERM_CCAA : _MM_PERM_DDBB)};
  }
};

struct Yuyv {
  static Yuv load(const ColorLabArgs& args, int32_t x, int32_t pixels) {
    const __mmask16 kept = static_cast<__mmask16>(first_bytes(pixels + (pixels & 1)));
    const __m256i packed = _mm256_maskz_loadu_epi16(kept, args.source + ptrdiff_t{2} * x);
    const __m512i pixel = _mm512_cvtepu16_epi32(packed);  // Y and, in even lanes, U, in odd ones V
    const __m512i chroma = _mm512_srli_epi32(pixel, 8);
    return Yuv{_mm512_and_si512(pixel, set(255)), _mm512_shuffle_epi32(chroma, _MM_PERM_CCAA),
               _mm512_shuffle_epi32(chroma, _MM_PERM_DDBB)};
  }
};

// The table of cube roots with the step to the next one: a root from 2^19 on takes 19 bits, a step 13.
struct PackedCubeRoots {
  static constexpr int32_t kStepBits = 13;
  static constexpr uint32_t kLeast = 1u << 19;
  uint32_t value[224];
};

constexpr PackedCubeRoots make_packed_cube_roots() {
  PackedCubeRoots table{};
  for (int32_t i = 0; i < 224; ++i) {
    const uint32_t step = kCubeRoot.value[i + 1] - kCubeRoot.value[i];
    table.value[i] = (kCubeRoot.value[i] - PackedCubeRoots::kLeast) << PackedCubeRoots::kStepBits | step;
  }
  return table;
}

constexpr PackedCubeRoots kPackedCubeRoots = make_packed_cube_roots();
static_assert(kCubeRoot.value[0] == PackedCubeRoots::kLeast && kCubeRoot.value[224] == 2 * PackedCubeRoots::kLeast &&
                  kCubeRoot.value[1] - kCubeRoot.value[0] < 1u << PackedCubeRoots::kStepBits,
              "roots and their falling steps fit");

// lab_f of simd/lab.h. Values that take the cube root are at least 2^25, so that at most two octaves are left out.
inline __m512i cube_root(__m512i t) {
  const __m512i line =
      _mm512_add_epi32(_mm512_srli_epi32(_mm512_mullo_epi32(_mm512_srli_epi32(t, 6), set(3987)), 15), set(144631));
  const __mmask16 linear = _mm512_cmplt_epu32_mask(t, set(38037066));
  const __mmask16 one = _mm512_cmplt_epu32_mask(t, set(1u << 29));
  const __mmask16 two = _mm512_cmplt_epu32_mask(t, set(1u << 26));
  __m512i m = _mm512_mask_slli_epi32(t, one, t, 3);
  m = _mm512_mask_slli_epi32(m, two, m, 3);
  m = _mm512_mask_mov_epi32(m, linear, set(1u << 29));
  const __m512i i = _mm512_sub_epi32(_mm512_srli_epi32(m, 24), set(CubeRootTable::kFirst));
  const __m512i fraction = _mm512_and_si512(_mm512_srli_epi32(m, 8), set(0xffff));
  const __m512i packed = gather(kPackedCubeRoots.value, i);
  const __m512i low = _mm512_add_epi32(_mm512_srli_epi32(packed, PackedCubeRoots::kStepBits), set(PackedCubeRoots::kLeast));
  const __m512i rise = _mm512_and_si512(packed, set((1u << PackedCubeRoots::kStepBits) - 1));
  __m512i root = _mm512_add_epi32(low, _mm512_srli_epi32(_mm512_mullo_epi32(rise, fraction), 16));
  root = _mm512_mask_srli_epi32(root, one, root, 1);
  root = _mm512_mask_srli_epi32(root, two, root, 1);
  return _mm512_mask_mov_epi32(root, linear, line);
}

inline __m512i weigh(const Rgb& light, uint32_t r, uint32_t g, uint32_t b) {
  const __m512i rg = _mm512_add_epi32(_mm512_mullo_epi32(light.r, set(r)), _mm512_mullo_epi32(light.g, set(g)));
  return _mm512_add_epi32(rg, _mm512_mullo_epi32(light.b, set(b)));
}

// (factor * f + offset 2^20) / 2^20, rounded: never negative.
inline void store_channel(__m512i f, uint32_t factor, int32_t offset, __mmask16 kept, uint8_t* out) {
  const __m512i bias = _mm512_set1_epi32(offset * (1 << 20) + (1 << 19));
  const __m512i value = _mm512_srai_epi32(_mm512_add_epi32(_mm512_mullo_epi32(f, set(factor)), bias), 20);
  _mm512_mask_cvtepi32_storeu_epi8(out, kept, value);
}

void store_lab(const ColorLabArgs& args, const Rgb& pixel, __mmask16 kept, uint8_t* out) {
  const Rgb light{gather(kLinearLight, pixel.r), gather(kLinearLight, pixel.g), gather(kLinearLight, pixel.b)};
  const __m512i fx = cube_root(weigh(light, 14219, 12328, 6221));
  const __m512i fy = cube_root(weigh(light, 6969, 23434, 2365));
  const __m512i fz = cube_root(weigh(light, 582, 3587, 28599));
  store_channel(fy, 145, -20, kept, out);
  store_channel(_mm512_sub_epi32(fx, fy), 625, 108, kept, out + args.plane_stride);
  store_channel(_mm512_sub_epi32(fy, fz), 250, 135, kept, out + 2 * args.plane_stride);
}

template <class Format>
void convert(const ColorLabArgs& args) {
  for (int32_t x = 0; x < args.width; x += kPixelsAtOnce) {
    const int32_t pixels = args.width - x < kPixelsAtOnce ? args.width - x : kPixelsAtOnce;
    const __mmask16 kept = static_cast<__mmask16>(first_bytes(pixels));
    const Rgb pixel = Format::load(args.source + ptrdiff_t{x} * Format::bytes, pixels);
    if (args.luma != nullptr) _mm512_mask_cvtepi32_storeu_epi16(args.luma + x, kept, weigh(pixel, 76, 150, 29));
    if (args.lab == nullptr) continue;
    if (Format::bytes == 1) {
      const __m512i light = gather(kLinearLight, pixel.g);
      store_channel(cube_root(_mm512_slli_epi32(light, 15)), 145, -20, kept, args.lab + x);
    } else {
      store_lab(args, pixel, kept, args.lab + x);
    }
  }
}

template <class Format>
void convert_yuv(const ColorLabArgs& args) {
  for (int32_t x = 0; x < args.width; x += kPixelsAtOnce) {
    const int32_t pixels = args.width - x < kPixelsAtOnce ? args.width - x : kPixelsAtOnce;
    const __mmask16 kept = static_cast<__mmask16>(first_bytes(pixels));
    const Yuv yuv = Format::load(args, x, pixels);
    if (args.luma != nullptr) {
      _mm512_mask_cvtepi32_storeu_epi16(args.luma + x, kept, _mm512_mullo_epi32(yuv.y, set(255)));
    }
    if (args.lab != nullptr) store_lab(args, rgb_from_yuv(yuv.y, yuv.u, yuv.v), kept, args.lab + x);
  }
}

}  // namespace

uint64_t color_lab_avx512_scratch(const KernelShape&) {
  return 0;
}

void color_lab_avx512(const ColorLabArgs& args) {
  switch (args.format) {
    case BSM_FORMAT_GRAY8:
      return convert<Gray>(args);
    case BSM_FORMAT_RGB24:
      return convert<Interleaved<3, 0, 2>>(args);
    case BSM_FORMAT_BGR24:
      return convert<Interleaved<3, 2, 0>>(args);
    case BSM_FORMAT_RGBA32:
      return convert<Interleaved<4, 0, 2>>(args);
    case BSM_FORMAT_BGRA32:
      return convert<Interleaved<4, 2, 0>>(args);
    case BSM_FORMAT_NV12:
      return convert_yuv<SemiPlanar<0, 1>>(args);
    case BSM_FORMAT_NV21:
      return convert_yuv<SemiPlanar<1, 0>>(args);
    case BSM_FORMAT_YUYV:
      return convert_yuv<Yuyv>(args);
    default:
      return convert<Packed565>(args);
  }
}

}  // namespace bsm
#endif
