// descriptor_compare, AVX2.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/lanes_avx2.h"

#include "simd/x86/descriptor_compare_lanes.h"

namespace bsm {

uint64_t descriptor_compare_avx2_scratch(const KernelShape& shape) {
  return descriptor_scratch(shape);
}

void descriptor_compare_avx2(const DescriptorCompareArgs& args) {
  compare_descriptors(args);
}

}  // namespace bsm
#endif
