// cost_hamming, POPCNT: 64-bit words, a candidate at a time.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/cost_hamming_row.h"

namespace bsm {

uint64_t cost_hamming_sse42_scratch(const KernelShape&) {
  return 0;
}

void cost_hamming_sse42(const CostHammingArgs& args) {
  count_costs(args);
}

}  // namespace bsm
#endif
