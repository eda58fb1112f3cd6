// median_weighted, AVX2.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/levels_avx2.h"

#include "simd/x86/median_weighted_lanes.h"

namespace bsm {

uint64_t median_weighted_avx2_scratch(const KernelShape&) {
  return median_scratch();
}

void median_weighted_avx2(const MedianWeightedArgs& args) {
  smooth_levels(args);
}

}  // namespace bsm
#endif
