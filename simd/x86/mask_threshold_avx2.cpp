// mask_threshold, AVX2.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/lanes_avx2.h"

#include "simd/x86/mask_threshold_lanes.h"

namespace bsm {

uint64_t mask_threshold_avx2_scratch(const KernelShape&) {
  return sizeof(MaskScratch);
}

void mask_threshold_avx2(const MaskThresholdArgs& args) {
  threshold_masks(args);
}

}  // namespace bsm
#endif
