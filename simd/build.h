// What this build of the library holds. CMake's options BSM_LOCAL, BSM_SGM and BSM_COLOR leave out what a small machine does
// not use; a configuration that asks for it is refused.
#ifndef BSM_SIMD_BUILD_H
#define BSM_SIMD_BUILD_H

#ifndef BSM_BUILD_LOCAL
#define BSM_BUILD_LOCAL 1
#endif
#ifndef BSM_BUILD_SGM
#define BSM_BUILD_SGM 1
#endif
#ifndef BSM_BUILD_COLOR
#define BSM_BUILD_COLOR 1
#endif

namespace bsm {

constexpr bool kHasLocal = BSM_BUILD_LOCAL != 0;
constexpr bool kHasSgm = BSM_BUILD_SGM != 0;
constexpr bool kHasColor = BSM_BUILD_COLOR != 0;  // else gray8 alone
static_assert(kHasLocal || kHasSgm, "a library has a method");

}  // namespace bsm

#endif  // BSM_SIMD_BUILD_H
