// fraction_smooth, AVX2.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/levels_avx2.h"

#include "simd/x86/fraction_smooth_lanes.h"

namespace bsm {

uint64_t fraction_smooth_avx2_scratch(const KernelShape&) {
  return 0;
}

void fraction_smooth_avx2(const FractionSmoothArgs& args) {
  smooth_fractions(args);
}

}  // namespace bsm
#endif
