// fraction_smooth, WebAssembly's vectors.
#include "platform/compiler.h"

#if BSM_ARCH_SIMD128
#include "simd/wasm/lanes_simd128.h"

#include "simd/x86/fraction_smooth_lanes.h"

namespace bsm {

uint64_t fraction_smooth_simd128_scratch(const KernelShape&) {
  return 0;
}

void fraction_smooth_simd128(const FractionSmoothArgs& args) {
  smooth_fractions(args);
}

}  // namespace bsm
#endif
