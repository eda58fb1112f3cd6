// BT.601 in full range (JFIF): one 8-bit YUV colour to 8-bit RGB, in 32-bit integer arithmetic.
//
//   R = Y + 1.402 (V - 128), G = Y - 0.344136 (U - 128) - 0.714136 (V - 128), B = Y + 1.772 (U - 128),
// each rounded and clamped. Coefficients have 16 fractional bits: every colour is rounded as in exact arithmetic unless it
// lies within 0.001 of the middle between two values. A test measures it.
#ifndef BSM_SIMD_YUV_H
#define BSM_SIMD_YUV_H

#include <stdint.h>

namespace bsm {

constexpr int32_t kRedOfV = 91881;
constexpr int32_t kGreenOfU = 22553;
constexpr int32_t kGreenOfV = 46802;
constexpr int32_t kBlueOfU = 116130;

// What the chroma that pixels share adds to Y in each channel, in 2^-16, with the half that rounds; at most 2^24 in
// magnitude.
struct ChromaTerms {
  int32_t r, g, b;
};

static inline ChromaTerms chroma_terms(uint8_t u, uint8_t v) {
  const int32_t cu = u - 128, cv = v - 128;
  constexpr int32_t kHalf = 1 << 15;
  return ChromaTerms{kRedOfV * cv + kHalf, kHalf - kGreenOfU * cu - kGreenOfV * cv, kBlueOfU * cu + kHalf};
}

static inline uint8_t channel_from_yuv(uint8_t y, int32_t term) {
  const int32_t value = (y << 16) + term;
  return static_cast<uint8_t>(value < 0 ? 0 : value > 0xffffff ? 255 : value >> 16);
}

// 255 Y, at most 65025: the luma of gray pixels, in the unit of luma_from_rgb.
static inline uint16_t luma_from_y(uint8_t y) {
  return static_cast<uint16_t>(255 * y);
}

}  // namespace bsm

#endif  // BSM_SIMD_YUV_H
