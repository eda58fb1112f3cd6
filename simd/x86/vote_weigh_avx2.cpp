// vote_weigh, AVX2.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/lanes_avx2.h"

#include "simd/x86/vote_weigh_lanes.h"

namespace bsm {

uint64_t vote_weigh_avx2_scratch(const KernelShape& shape) {
  return vote_scratch_bytes(shape);
}

void vote_weigh_avx2(const VoteWeighArgs& args) {
  vote_weighed(args);
}

}  // namespace bsm
#endif
