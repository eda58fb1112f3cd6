// edge_threshold, MVE: eight pixels at once.
// Bound, per eight pixels: 1 store, 2 operations, and 2 loads and 2 operations a plane.
#include "platform/compiler.h"

#if BSM_ARCH_MVE
#include "simd/arm/mve.h"
#include "simd/build.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 8;

template <int32_t kPlanes>
void find_edges(const EdgeThresholdArgs& args) {
  const uint16x8_t threshold = vdupq_n_u16(static_cast<uint16_t>(args.threshold));
  for (int32_t x = 0; x < args.width; x += kLanes) {
    const mve_pred16_t inside = vctp16q(static_cast<uint32_t>(args.width - x));
    uint16x8_t sad = vdupq_n_u16(0);
    BSM_UNROLL
    for (int32_t plane = 0; plane < kPlanes; ++plane) {
      const ptrdiff_t at = plane * args.plane_stride + x;
      sad = vaddq_u16(sad, vabdq_u16(vldrbq_z_u16(args.lab + at, inside), vldrbq_z_u16(args.previous + at, inside)));
    }
    // Above the threshold, the halved difference is negative.
    vstrbq_p_u16(args.edge + x, vshrq_n_u16(vhsubq_u16(threshold, sad), 15), inside);
  }
}

}  // namespace

uint64_t edge_threshold_mve_scratch(const KernelShape&) {
  return 0;
}

void edge_threshold_mve(const EdgeThresholdArgs& args) {
  if (kHasColor && args.planes == 3) {
    find_edges<3>(args);
  } else {
    find_edges<1>(args);
  }
}

}  // namespace bsm
#endif
