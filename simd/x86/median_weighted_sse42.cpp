// median_weighted, SSE4.2.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/levels_sse42.h"

#include "simd/x86/median_weighted_lanes.h"

namespace bsm {

uint64_t median_weighted_sse42_scratch(const KernelShape&) {
  return median_scratch();
}

void median_weighted_sse42(const MedianWeightedArgs& args) {
  smooth_levels(args);
}

}  // namespace bsm
#endif
