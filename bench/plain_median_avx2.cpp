// The plain form of median_weighted_avx2, made of the kernel's own parts.
#include "bench/plain_forms.h"
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/levels_avx2.h"

#include "simd/x86/median_weighted_lanes.h"

namespace bsm::bench {

void median_of_all_blocks_avx2(const MedianWeightedArgs& args) {
  smooth_levels<true>(args);
}

}  // namespace bsm::bench
#endif
