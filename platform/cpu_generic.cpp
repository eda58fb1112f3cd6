// Machines without a detection file of their own: no extension beyond the base instruction set.
#include "platform/compiler.h"
#include "platform/cpu.h"

namespace bsm {

#if !BSM_ARCH_X86 && !BSM_ARCH_ARM
uint32_t cpu_features() {
  return 0;
}
#endif

}  // namespace bsm
