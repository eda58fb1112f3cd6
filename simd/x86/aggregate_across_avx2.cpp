// aggregate_across, AVX2.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/levels_avx2.h"

#include "simd/x86/aggregate_across_lanes.h"

namespace bsm {

uint64_t aggregate_across_avx2_scratch(const KernelShape&) {
  return 0;
}

void aggregate_across_avx2(const AggregateAcrossArgs& args) {
  aggregate_across(args);
}

}  // namespace bsm
#endif
