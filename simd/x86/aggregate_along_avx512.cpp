// aggregate_along, AVX-512 BW.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/levels_avx512.h"

#include "simd/x86/aggregate_along_lanes.h"

namespace bsm {

uint64_t aggregate_along_avx512_scratch(const KernelShape& shape) {
  return along_scratch(shape);
}

void aggregate_along_avx512(const AggregateAlongArgs& args) {
  aggregate_along(args);
}

}  // namespace bsm
#endif
