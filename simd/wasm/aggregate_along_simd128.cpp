// aggregate_along, WebAssembly's vectors.
#include "platform/compiler.h"

#if BSM_ARCH_SIMD128
#include "simd/wasm/lanes_simd128.h"

#include "simd/x86/aggregate_along_lanes.h"

namespace bsm {

uint64_t aggregate_along_simd128_scratch(const KernelShape& shape) {
  return along_scratch(shape);
}

void aggregate_along_simd128(const AggregateAlongArgs& args) {
  aggregate_along(args);
}

}  // namespace bsm
#endif
