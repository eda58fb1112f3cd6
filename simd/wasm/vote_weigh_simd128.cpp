// vote_weigh, WebAssembly's vectors.
#include "platform/compiler.h"

#if BSM_ARCH_SIMD128
#include "simd/wasm/lanes_simd128.h"

#include "simd/x86/vote_weigh_lanes.h"

namespace bsm {

uint64_t vote_weigh_simd128_scratch(const KernelShape& shape) {
  return vote_scratch_bytes(shape);
}

void vote_weigh_simd128(const VoteWeighArgs& args) {
  vote_weighed(args);
}

}  // namespace bsm
#endif
