// edge_threshold, scalar: where two rows' colours differ.
#include "simd/kernels.h"
#include "simd/scalar/sad.h"

namespace bsm {

uint64_t edge_threshold_scalar_scratch(const KernelShape&) {
  return 0;
}

void edge_threshold_scalar(const EdgeThresholdArgs& args) {
  const uint32_t threshold = static_cast<uint32_t>(args.threshold);
  for (int32_t x = 0; x < args.width; ++x) {
    args.edge[x] = sad(args.lab + x, args.previous + x, args.plane_stride, args.planes) > threshold ? 1 : 0;
  }
}

}  // namespace bsm
