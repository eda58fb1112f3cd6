// mask_threshold, SSE4.2.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/lanes_sse42.h"

#include "simd/x86/mask_threshold_lanes.h"

namespace bsm {

uint64_t mask_threshold_sse42_scratch(const KernelShape&) {
  return sizeof(MaskScratch);
}

void mask_threshold_sse42(const MaskThresholdArgs& args) {
  threshold_masks(args);
}

}  // namespace bsm
#endif
