// Machines without a detection file of their own: no extension beyond the base instruction set and what the compiler
// targets.
#include "platform/compiler.h"
#include "platform/cpu.h"

namespace bsm {

#if !BSM_ARCH_X86 && !BSM_ARCH_ARM
uint32_t cpu_features() {
  return BSM_ARCH_SIMD128 ? uint32_t{kCpuSimd128} : 0;
}
#endif

}  // namespace bsm
