// descriptor_compare, DSP: two pixels in a register, eight at once; sixteen pairs fill the halves of a descriptor.
// Bound, per pair and two pixels: 2 loads, 3 operations.
#include "platform/compiler.h"

#if BSM_ARCH_DSP
#include "simd/arm/dsp.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kPairs = 16;
constexpr int32_t kLanes = 8;
constexpr int32_t kWords = kLanes / 2;

// The points of sixteen pairs at x = 0.
struct Points {
  const uint16_t* p;
  const uint16_t* q;
};

void compare_pairs(const Points (&points)[kPairs], int32_t x, uint32_t (&bits)[kWords]) {
  BSM_UNROLL
  for (int32_t k = 0; k < kWords; ++k) bits[k] = 0;
  for (const Points& point : points) {
    const uint16_t* p = point.p + x;
    const uint16_t* q = point.q + x;
    BSM_UNROLL
    for (int32_t k = 0; k < kWords; ++k) {
      // The halved difference is negative where luma at p is above luma at q.
      bits[k] = bits[k] >> 1 | (__uhsub16(load32(q + 2 * k), load32(p + 2 * k)) & kHalfSigns);
    }
  }
}

}  // namespace

uint64_t descriptor_compare_dsp_scratch(const KernelShape&) {
  return 0;
}

void descriptor_compare_dsp(const DescriptorCompareArgs& args) {
  const uint16_t* const* rows = args.rows + args.pattern.radius;
  const ptrdiff_t bytes = args.pattern.bits / 8;
  const PixelPair* pairs = args.pattern.pairs;
  for (int32_t byte = 0; byte < bytes; byte += kPairs / 8, pairs += kPairs) {
    Points points[kPairs];
    for (int32_t i = 0; i < kPairs; ++i) {
      points[i] = Points{rows[pairs[i].py] + pairs[i].px, rows[pairs[i].qy] + pairs[i].qx};
    }
    uint8_t* out = args.out + byte;
    for (int32_t x = 0; x < args.width; x += kLanes) {
      uint32_t bits[kWords];
      compare_pairs(points, x, bits);
      for (int32_t i = 0; i < kLanes && x + i < args.width; ++i, out += bytes) {
        const uint16_t half = static_cast<uint16_t>((i & 1) == 0 ? bits[i / 2] : bits[i / 2] >> 16);
        BSM_MEMCPY(out, &half, sizeof half);
      }
    }
  }
}

}  // namespace bsm
#endif
