// descriptor_compare, scalar: I(p_i) > I(q_i) for each pair and pixel (eq. 2, 3).
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kTile = 32;  // pixels whose descriptors stay in the first-level cache while the pairs run

// Byte `byte` of the descriptors of pixels begin..end-1: eight pairs, whose points stay at hand while x runs.
void compare_eight_pairs(const DescriptorCompareArgs& args, int32_t byte, int32_t begin, int32_t end) {
  const PixelPair* pairs = args.pattern.pairs + ptrdiff_t{byte} * 8;
  const uint16_t* const* rows = args.rows + args.pattern.radius;
  const uint16_t* p[8];
  const uint16_t* q[8];
  for (int32_t i = 0; i < 8; ++i) {
    p[i] = rows[pairs[i].py] + pairs[i].px;
    q[i] = rows[pairs[i].qy] + pairs[i].qx;
  }
  const int32_t bytes = args.pattern.bits / 8;
  uint8_t* out = args.out + ptrdiff_t{begin} * bytes + byte;
  for (int32_t x = begin; x < end; ++x, out += bytes) {
    uint32_t bits = 0;
    for (int32_t i = 7; i >= 0; --i) bits = 2 * bits + (p[i][x] > q[i][x] ? 1u : 0u);
    *out = static_cast<uint8_t>(bits);
  }
}

}  // namespace

uint64_t descriptor_compare_scalar_scratch(const KernelShape&) {
  return 0;
}

void descriptor_compare_scalar(const DescriptorCompareArgs& args) {
  for (int32_t begin = 0; begin < args.width; begin += kTile) {
    const int32_t end = begin + kTile < args.width ? begin + kTile : args.width;
    for (int32_t byte = 0; byte < args.pattern.bits / 8; ++byte) compare_eight_pairs(args, byte, begin, end);
  }
}

}  // namespace bsm
