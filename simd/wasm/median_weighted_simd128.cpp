// median_weighted, WebAssembly's vectors.
#include "platform/compiler.h"

#if BSM_ARCH_SIMD128
#include "simd/wasm/lanes_simd128.h"

#include "simd/x86/median_weighted_lanes.h"

namespace bsm {

uint64_t median_weighted_simd128_scratch(const KernelShape&) {
  return median_scratch();
}

void median_weighted_simd128(const MedianWeightedArgs& args) {
  smooth_levels(args);
}

}  // namespace bsm
#endif
