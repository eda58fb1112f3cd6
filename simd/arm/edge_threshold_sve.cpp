// edge_threshold, SVE: the SADs of a vector of pixels in 16 bits.
// Bound, per vector of 16-bit lanes and plane: 2 loads, 1 difference, 1 addition.
#include "platform/compiler.h"

#if BSM_ARCH_SVE
#include "simd/arm/sve.h"
#include "simd/kernels.h"

namespace bsm {

uint64_t edge_threshold_sve_scratch(const KernelShape&) {
  return 0;
}

void edge_threshold_sve(const EdgeThresholdArgs& args) {
  for (int32_t x = 0; x < args.width; x += lanes16()) {
    const svbool_t pixels = svwhilelt_b16(x, args.width);
    svuint16_t sad = svdup_u16(0);
    for (int32_t plane = 0; plane < args.planes; ++plane) {
      const ptrdiff_t at = plane * args.plane_stride + x;
      sad =
          svadd_x(pixels, sad, svabd_x(pixels, svld1ub_u16(pixels, args.lab + at), svld1ub_u16(pixels, args.previous + at)));
    }
    const svbool_t edges = svcmpgt(pixels, sad, static_cast<uint16_t>(args.threshold));
    svst1b(pixels, args.edge + x, svdup_u16_z(edges, 1));
  }
}

}  // namespace bsm
#endif
