// descriptor_compare, WebAssembly's vectors.
#include "platform/compiler.h"

#if BSM_ARCH_SIMD128
#include "simd/wasm/lanes_simd128.h"

#include "simd/x86/descriptor_compare_lanes.h"

namespace bsm {

uint64_t descriptor_compare_simd128_scratch(const KernelShape& shape) {
  return descriptor_scratch(shape);
}

void descriptor_compare_simd128(const DescriptorCompareArgs& args) {
  compare_descriptors(args);
}

}  // namespace bsm
#endif
