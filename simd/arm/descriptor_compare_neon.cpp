// descriptor_compare, NEON: a pair is two compares of eight luma values each, eight pairs a byte of sixteen pixels.
// Bound, per pair and sixteen pixels: 4 loads, 2 compares, 2 operations to gather the bits.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "simd/arm/transpose.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kTile = 512;  // pixels whose bytes wait for their transposition

struct Scratch {
  uint8_t bytes[8][kTile];
};

// All ones where luma at p is above luma at q.
inline uint8x16_t compare(const uint16_t* p, const uint16_t* q) {
  const uint16x8_t low = vcgtq_u16(vld1q_u16(p), vld1q_u16(q));
  const uint16x8_t high = vcgtq_u16(vld1q_u16(p + 8), vld1q_u16(q + 8));
  return low_bytes(low, high);
}

// A byte of eight pairs for the pixels of a tile, kVectors vectors of sixteen at once.
template <int32_t kVectors>
inline void compare_eight_pairs(const uint16_t* const (&p)[8], const uint16_t* const (&q)[8], int32_t at, uint8_t* out) {
  uint8x16_t bytes[kVectors];
  BSM_UNROLL
  for (int32_t v = 0; v < kVectors; ++v) bytes[v] = compare(p[7] + at + v * kLanes, q[7] + at + v * kLanes);
  BSM_UNROLL_A64
  for (int32_t i = 6; i >= 0; --i) {
    const uint16_t* above = p[i] + at;
    const uint16_t* below = q[i] + at;
    BSM_UNROLL
    for (int32_t v = 0; v < kVectors; ++v) {
      bytes[v] = vsliq_n_u8(compare(above + v * kLanes, below + v * kLanes), bytes[v], 1);
    }
  }
  BSM_UNROLL
  for (int32_t v = 0; v < kVectors; ++v) vst1q_u8(out + at + v * kLanes, bytes[v]);
}

void compare_tile(const uint16_t* const* rows, const PixelPair* pairs, int32_t x, int32_t pixels, uint8_t* out) {
  const uint16_t* p[8];
  const uint16_t* q[8];
  BSM_UNROLL
  for (int32_t i = 0; i < 8; ++i) {
    p[i] = rows[pairs[i].py] + pairs[i].px + x;
    q[i] = rows[pairs[i].qy] + pairs[i].qx + x;
  }
  int32_t at = 0;
  for (; at + 3 * kLanes < pixels; at += 4 * kLanes) compare_eight_pairs<4>(p, q, at, out);
  for (; at < pixels; at += kLanes) compare_eight_pairs<1>(p, q, at, out);
}

}  // namespace

uint64_t descriptor_compare_neon_scratch(const KernelShape&) {
  return sizeof(Scratch);
}

void descriptor_compare_neon(const DescriptorCompareArgs& args) {
  Scratch& scratch = *static_cast<Scratch*>(args.scratch);
  const uint16_t* const* rows = args.rows + args.pattern.radius;
  const ptrdiff_t bytes = args.pattern.bits / 8;
  for (int32_t x = 0; x < args.width; x += kTile) {
    const int32_t pixels = args.width - x < kTile ? args.width - x : kTile;
    for (int32_t byte = 0; byte < bytes; byte += 8) {
      for (int32_t i = 0; i < 8; ++i) {
        compare_tile(rows, args.pattern.pairs + ptrdiff_t{8} * (byte + i), x, pixels, scratch.bytes[i]);
      }
      for (int32_t at = 0; at < pixels; at += kLanes) {
        uint8x16_t octets[8];
        BSM_UNROLL
        for (int32_t i = 0; i < 8; ++i) octets[i] = vld1q_u8(scratch.bytes[i] + at);
        store_octets(octets, pixels - at, args.out + (x + at) * bytes + byte, bytes);
      }
    }
  }
}

}  // namespace bsm
#endif
