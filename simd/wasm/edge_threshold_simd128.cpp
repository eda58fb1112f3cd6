// edge_threshold, WebAssembly's vectors.
#include "platform/compiler.h"

#if BSM_ARCH_SIMD128
#include "simd/wasm/lanes_simd128.h"

#include "simd/x86/edge_threshold_lanes.h"

namespace bsm {

uint64_t edge_threshold_simd128_scratch(const KernelShape&) {
  return 0;
}

void edge_threshold_simd128(const EdgeThresholdArgs& args) {
  threshold_edges(args);
}

}  // namespace bsm
#endif
