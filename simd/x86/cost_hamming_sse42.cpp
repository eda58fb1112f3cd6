// cost_hamming, POPCNT: 64-bit words, four candidates at a time up to 192 bits, else one.
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
