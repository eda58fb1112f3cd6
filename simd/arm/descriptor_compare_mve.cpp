// descriptor_compare, MVE: eight pixels in a vector, sixteen at once; sixteen pairs fill the halves of a descriptor.
// Bound, per pair and eight pixels: 2 loads, 2 operations.
#include "platform/compiler.h"

#if BSM_ARCH_MVE
#include "simd/arm/mve.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kPairs = 16;
constexpr int32_t kLanes = 8;

// The points of sixteen pairs at x = 0.
struct Points {
  const uint16_t* p;
  const uint16_t* q;
};

// Where luma at p is above luma at q, the halved difference is negative: its sign becomes the highest bit.
inline uint16x8_t insert_bit(uint16x8_t bits, const uint16_t* p, const uint16_t* q) {
  return vsriq_n_u16(vhsubq_u16(vldrhq_u16(q), vldrhq_u16(p)), bits, 1);
}

}  // namespace

uint64_t descriptor_compare_mve_scratch(const KernelShape&) {
  return 0;
}

void descriptor_compare_mve(const DescriptorCompareArgs& args) {
  const uint16_t* const* rows = args.rows + args.pattern.radius;
  const ptrdiff_t bytes = args.pattern.bits / 8;
  const PixelPair* pairs = args.pattern.pairs;
  const uint16x8_t offsets = places(static_cast<uint32_t>(bytes));
  for (int32_t byte = 0; byte < bytes; byte += kPairs / 8, pairs += kPairs) {
    Points points[kPairs];
    for (int32_t i = 0; i < kPairs; ++i) {
      points[i] = Points{rows[pairs[i].py] + pairs[i].px, rows[pairs[i].qy] + pairs[i].qx};
    }
    uint8_t* out = args.out + byte;
    for (int32_t x = 0; x < args.width; x += 2 * kLanes, out += 2 * kLanes * bytes) {
      uint16x8_t low = vdupq_n_u16(0);
      uint16x8_t high = low;
      for (const Points& point : points) {
        low = insert_bit(low, point.p + x, point.q + x);
        high = insert_bit(high, point.p + x + kLanes, point.q + x + kLanes);
      }
      const uint32_t left = static_cast<uint32_t>(args.width - x);
      uint16_t* const to = reinterpret_cast<uint16_t*>(out);
      vstrhq_scatter_offset_p_u16(to, offsets, low, vctp16q(left));
      if (left > kLanes) vstrhq_scatter_offset_p_u16(to + kLanes * bytes / 2, offsets, high, vctp16q(left - kLanes));
    }
  }
}

}  // namespace bsm
#endif
