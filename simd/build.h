// What this build of the library holds. CMake's options BSM_LOCAL, BSM_SGM and so on leave out what a small machine does not
// use; a configuration that asks for it is refused.
#ifndef BSM_SIMD_BUILD_H
#define BSM_SIMD_BUILD_H

#include "platform/compiler.h"

#ifndef BSM_BUILD_LOCAL
#define BSM_BUILD_LOCAL 1
#endif
#ifndef BSM_BUILD_SGM
#define BSM_BUILD_SGM 1
#endif
#ifndef BSM_BUILD_COLOR
#define BSM_BUILD_COLOR 1
#endif
#ifndef BSM_BUILD_REFINEMENT
#define BSM_BUILD_REFINEMENT 1
#endif
#ifndef BSM_BUILD_CONFIDENCE
#define BSM_BUILD_CONFIDENCE 1
#endif
#ifndef BSM_BUILD_TEXT
#define BSM_BUILD_TEXT 1
#endif
#ifndef BSM_BUILD_SCALAR
#define BSM_BUILD_SCALAR 1
#endif
// Operating systems have 36 KB to spare.
#ifndef BSM_BUILD_PATTERN_TABLES
#if defined(__linux__) || defined(__APPLE__) || defined(_WIN32)
#define BSM_BUILD_PATTERN_TABLES 1
#else
#define BSM_BUILD_PATTERN_TABLES 0
#endif
#endif

namespace bsm {

constexpr bool kHasLocal = BSM_BUILD_LOCAL != 0;
constexpr bool kHasSgm = BSM_BUILD_SGM != 0;
constexpr bool kHasColor = BSM_BUILD_COLOR != 0;  // else gray8 alone
constexpr bool kHasRefinement = BSM_BUILD_REFINEMENT != 0;
constexpr bool kHasConfidence = BSM_BUILD_CONFIDENCE != 0;
constexpr bool kHasText = BSM_BUILD_TEXT != 0;                     // sentences about statuses, names of kernels
constexpr bool kHasScalar = BSM_BUILD_SCALAR != 0;                 // else only for stages without another kernel
constexpr bool kHasPatternTables = BSM_BUILD_PATTERN_TABLES != 0;  // else a context makes its pairs: 4 bytes a bit
static_assert(kHasLocal || kHasSgm, "a library has a method");
static_assert(kHasScalar || BSM_ARCH_CORTEX_M, "other processors tell their instruction sets when the library runs");

}  // namespace bsm

#endif  // BSM_SIMD_BUILD_H
