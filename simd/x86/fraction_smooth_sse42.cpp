// fraction_smooth, SSE4.2.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/levels_sse42.h"

#include "simd/x86/fraction_smooth_lanes.h"

namespace bsm {

uint64_t fraction_smooth_sse42_scratch(const KernelShape&) {
  return 0;
}

void fraction_smooth_sse42(const FractionSmoothArgs& args) {
  smooth_fractions(args);
}

}  // namespace bsm
#endif
