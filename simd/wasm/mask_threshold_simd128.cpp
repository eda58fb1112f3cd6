// mask_threshold, WebAssembly's vectors.
#include "platform/compiler.h"

#if BSM_ARCH_SIMD128
#include "simd/wasm/lanes_simd128.h"

#include "simd/x86/mask_threshold_lanes.h"

namespace bsm {

uint64_t mask_threshold_simd128_scratch(const KernelShape&) {
  return sizeof(MaskScratch);
}

void mask_threshold_simd128(const MaskThresholdArgs& args) {
  threshold_masks(args);
}

}  // namespace bsm
#endif
