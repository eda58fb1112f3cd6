// edge_threshold, SSE4.2.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/lanes_sse42.h"

#include "simd/x86/edge_threshold_lanes.h"

namespace bsm {

uint64_t edge_threshold_sse42_scratch(const KernelShape&) {
  return 0;
}

void edge_threshold_sse42(const EdgeThresholdArgs& args) {
  threshold_edges(args);
}

}  // namespace bsm
#endif
