// From bytes of eight bits of sixteen pixels to the pixels' descriptors.
#ifndef BSM_SIMD_ARM_TRANSPOSE_H
#define BSM_SIMD_ARM_TRANSPOSE_H

#include "simd/arm/neon.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 16;  // pixels in a vector of bytes

// Bit i of each byte of the result: the byte of bits[i] is all ones.
inline uint8x16_t gather_bits(const uint8x16_t (&bits)[8]) {
  uint8x16_t byte = bits[7];
  byte = vsriq_n_u8(byte, bits[6], 1);
  byte = vsriq_n_u8(byte, bits[5], 2);
  byte = vsriq_n_u8(byte, bits[4], 3);
  byte = vsriq_n_u8(byte, bits[3], 4);
  byte = vsriq_n_u8(byte, bits[2], 5);
  byte = vsriq_n_u8(byte, bits[1], 6);
  return vsriq_n_u8(byte, bits[0], 7);
}

// Eight vectors, of byte i of sixteen pixels each, to eight bytes of each pixel, `stride` bytes apart.
inline void store_octets(const uint8x16_t (&bytes)[8], int32_t pixels, uint8_t* out, ptrdiff_t stride) {
  uint16x8x2_t pairs[4];  // two bytes of pixels 0..7 and 8..15
  BSM_UNROLL
  for (int32_t i = 0; i < 4; ++i) {
    const uint8x16x2_t zipped = vzipq_u8(bytes[2 * i], bytes[2 * i + 1]);
    pairs[i].val[0] = vreinterpretq_u16_u8(zipped.val[0]);
    pairs[i].val[1] = vreinterpretq_u16_u8(zipped.val[1]);
  }
  uint8x16_t eights[8];  // eight bytes of two pixels
  BSM_UNROLL
  for (int32_t half = 0; half < 2; ++half) {
    const uint16x8x2_t low = vzipq_u16(pairs[0].val[half], pairs[1].val[half]);
    const uint16x8x2_t high = vzipq_u16(pairs[2].val[half], pairs[3].val[half]);
    BSM_UNROLL
    for (int32_t i = 0; i < 2; ++i) {
      const uint32x4x2_t all = vzipq_u32(vreinterpretq_u32_u16(low.val[i]), vreinterpretq_u32_u16(high.val[i]));
      eights[4 * half + 2 * i] = vreinterpretq_u8_u32(all.val[0]);
      eights[4 * half + 2 * i + 1] = vreinterpretq_u8_u32(all.val[1]);
    }
  }
  if (pixels >= kLanes) {
    BSM_UNROLL
    for (int32_t i = 0; i < 8; ++i) {
      vst1_u8(out + 2 * i * stride, vget_low_u8(eights[i]));
      vst1_u8(out + (2 * i + 1) * stride, vget_high_u8(eights[i]));
    }
    return;
  }
  BSM_UNROLL
  for (int32_t i = 0; i < 8; ++i) {
    if (2 * i < pixels) vst1_u8(out + 2 * i * stride, vget_low_u8(eights[i]));
    if (2 * i + 1 < pixels) vst1_u8(out + (2 * i + 1) * stride, vget_high_u8(eights[i]));
  }
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_TRANSPOSE_H
