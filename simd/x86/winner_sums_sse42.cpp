// winner_sums, SSE4.2.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/levels_sse42.h"

#include "simd/x86/winner_sums_lanes.h"

namespace bsm {

uint64_t winner_sums_sse42_scratch(const KernelShape&) {
  return 0;
}

void winner_sums_sse42(const WinnerSumsArgs& args) {
  find_winners(args);
}

}  // namespace bsm
#endif
