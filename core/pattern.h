// The pair patterns of the descriptors (section 3.1), the same on every machine. They are made when a context opens: the
// generator is shorter than the pairs.
#ifndef BSM_CORE_PATTERN_H
#define BSM_CORE_PATTERN_H

#include <stdint.h>

#include "simd/kernels.h"

namespace bsm {

constexpr int32_t kLocalRadius = kMaxPatternRadius;
constexpr int32_t kNarrowRadius = 10;
constexpr int32_t kSgmRadius = 8;

// Writes the first `bits` pairs of the local method: isotropic Gaussian offsets of sigma 4, truncated toward zero, inside a
// window of 26 x 26 pixels (|offset| < 13), no pair of two equal points. Nested: a shorter descriptor is a prefix.
Pattern local_pattern(int32_t bits, PixelPair* pairs);

// The same with sigma 3 and offsets below 11.
Pattern narrow_pattern(int32_t bits, PixelPair* pairs);

// The same for sgm: sigma 2.5, offsets below 9.
Pattern sgm_pattern(int32_t bits, PixelPair* pairs);

}  // namespace bsm

#endif  // BSM_CORE_PATTERN_H
