// aggregate_across, WebAssembly's vectors.
#include "platform/compiler.h"

#if BSM_ARCH_SIMD128
#include "simd/wasm/lanes_simd128.h"

#include "simd/x86/aggregate_across_lanes.h"

namespace bsm {

uint64_t aggregate_across_simd128_scratch(const KernelShape&) {
  return 0;
}

void aggregate_across_simd128(const AggregateAcrossArgs& args) {
  aggregate_across(args);
}

}  // namespace bsm
#endif
