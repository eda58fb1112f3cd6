// edge_threshold, AVX2.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/lanes_avx2.h"

#include "simd/x86/edge_threshold_lanes.h"

namespace bsm {

uint64_t edge_threshold_avx2_scratch(const KernelShape&) {
  return 0;
}

void edge_threshold_avx2(const EdgeThresholdArgs& args) {
  threshold_edges(args);
}

}  // namespace bsm
#endif
