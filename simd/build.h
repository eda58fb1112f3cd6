// What this build of the library holds. CMake's options BSM_LOCAL, BSM_SGM, BSM_COLOR and BSM_MAX_BITS leave out what a
// small machine does not use; a configuration that asks for it is refused.
#ifndef BSM_SIMD_BUILD_H
#define BSM_SIMD_BUILD_H

#include <stdint.h>

#include "bsm/bsm.h"

#ifndef BSM_BUILD_LOCAL
#define BSM_BUILD_LOCAL 1
#endif
#ifndef BSM_BUILD_SGM
#define BSM_BUILD_SGM 1
#endif
#ifndef BSM_BUILD_COLOR
#define BSM_BUILD_COLOR 1
#endif
#ifndef BSM_BUILD_BITS
#define BSM_BUILD_BITS BSM_MAX_BITS
#endif

namespace bsm {

constexpr bool kHasLocal = BSM_BUILD_LOCAL != 0;
constexpr bool kHasSgm = BSM_BUILD_SGM != 0;
constexpr bool kHasColor = BSM_BUILD_COLOR != 0;  // else gray8 alone
static_assert(kHasLocal || kHasSgm, "a library has a method");
static_assert(BSM_BUILD_BITS % BSM_MIN_BITS == 0 && BSM_BUILD_BITS >= BSM_MIN_BITS && BSM_BUILD_BITS <= BSM_MAX_BITS,
              "the longest descriptor is a multiple of 64 within 64..4096");

// The longest descriptors of each method.
constexpr int32_t kMostLocalBits = BSM_BUILD_BITS;
constexpr int32_t kMostSgmBits = BSM_BUILD_BITS < BSM_MAX_SGM_BITS ? BSM_BUILD_BITS : BSM_MAX_SGM_BITS;

}  // namespace bsm

#endif  // BSM_SIMD_BUILD_H
