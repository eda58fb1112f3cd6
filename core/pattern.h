// The pair patterns of the descriptors (section 3.1), the same on every machine: tables made at compile time, or with little
// flash (kHasPatternTables) written when a context opens, as the generator is shorter than its pairs.
#ifndef BSM_CORE_PATTERN_H
#define BSM_CORE_PATTERN_H

#include <stdint.h>

#include "simd/build.h"
#include "simd/kernels.h"

namespace bsm {

constexpr int32_t kLocalRadius = kMaxPatternRadius;
constexpr int32_t kNarrowRadius = 10;
constexpr int32_t kSgmRadius = 8;

// The first `bits` pairs of the local method, in a table or written to `pairs`, which has room for them then: isotropic
// Gaussian offsets of sigma 4, truncated toward zero, inside a window of 26 x 26 pixels (|offset| < 13), no pair of two
// equal points. Nested: a shorter descriptor is a prefix.
Pattern local_pattern(int32_t bits, PixelPair* pairs);

// The same with sigma 3 and offsets below 11.
Pattern narrow_pattern(int32_t bits, PixelPair* pairs);

// The same for sgm: sigma 2.5, offsets below 9.
Pattern sgm_pattern(int32_t bits, PixelPair* pairs);

}  // namespace bsm

#endif  // BSM_CORE_PATTERN_H
