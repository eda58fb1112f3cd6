// edge_threshold, NEON: sixteen pixels at once; the last ones of a row one by one.
// Bound, per sixteen pixels: 6 loads, 3 absolute differences, 4 sums, 2 compares, 1 store.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "simd/arm/neon.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 16;

// 1 where the SAD of eight pixels is above the threshold; it needs 10 bits.
inline uint8x8_t above(uint16x8_t sad, uint16x8_t threshold) {
  return vmovn_u16(vshrq_n_u16(vcgtq_u16(sad, threshold), 15));
}

template <int32_t kPlanes>
inline uint8x16_t sixteen_edges(const uint8_t* a, const uint8_t* b, ptrdiff_t stride, uint16x8_t threshold) {
  const uint8x16_t first = vabdq_u8(vld1q_u8(a), vld1q_u8(b));
  uint16x8_t low = vmovl_u8(vget_low_u8(first));
  uint16x8_t high = vmovl_u8(vget_high_u8(first));
  for (int32_t plane = 1; plane < kPlanes; ++plane) {
    const uint8x16_t difference = vabdq_u8(vld1q_u8(a + plane * stride), vld1q_u8(b + plane * stride));
    low = vaddw_u8(low, vget_low_u8(difference));
    high = vaddw_u8(high, vget_high_u8(difference));
  }
  return vcombine_u8(above(low, threshold), above(high, threshold));
}

template <int32_t kPlanes>
void find_edges(const EdgeThresholdArgs& args) {
  const uint16x8_t threshold = vdupq_n_u16(static_cast<uint16_t>(args.threshold));
  int32_t x = 0;
  for (; x + kLanes <= args.width; x += kLanes) {
    vst1q_u8(args.edge + x, sixteen_edges<kPlanes>(args.lab + x, args.previous + x, args.plane_stride, threshold));
  }
  for (; x < args.width; ++x) {
    int32_t sad = 0;
    for (int32_t plane = 0; plane < kPlanes; ++plane) {
      const int32_t difference = args.lab[plane * args.plane_stride + x] - args.previous[plane * args.plane_stride + x];
      sad += difference < 0 ? -difference : difference;
    }
    args.edge[x] = sad > args.threshold ? 1 : 0;
  }
}

}  // namespace

uint64_t edge_threshold_neon_scratch(const KernelShape&) {
  return 0;
}

void edge_threshold_neon(const EdgeThresholdArgs& args) {
  if (args.planes == 3) {
    find_edges<3>(args);
  } else {
    find_edges<1>(args);
  }
}

}  // namespace bsm
#endif
