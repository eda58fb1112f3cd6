// winner_sums, WebAssembly's vectors.
#include "platform/compiler.h"

#if BSM_ARCH_SIMD128
#include "simd/wasm/lanes_simd128.h"

#include "simd/x86/winner_sums_lanes.h"

namespace bsm {

uint64_t winner_sums_simd128_scratch(const KernelShape&) {
  return 0;
}

void winner_sums_simd128(const WinnerSumsArgs& args) {
  find_winners(args);
}

}  // namespace bsm
#endif
