// winner_sums, AVX2.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/levels_avx2.h"

#include "simd/x86/winner_sums_lanes.h"

namespace bsm {

uint64_t winner_sums_avx2_scratch(const KernelShape&) {
  return 0;
}

void winner_sums_avx2(const WinnerSumsArgs& args) {
  find_winners(args);
}

}  // namespace bsm
#endif
