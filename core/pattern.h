// The pair pattern of the descriptors (section 3.1): a table made at compile time, the same on every machine.
#ifndef BSM_CORE_PATTERN_H
#define BSM_CORE_PATTERN_H

#include <stdint.h>

#include "simd/kernels.h"

namespace bsm {

// The first `bits` pairs of the local method's table: isotropic Gaussian offsets of sigma 4, truncated toward zero, inside a
// window of 26 x 26 pixels (|offset| < 13), no pair of two equal points. Nested: a shorter descriptor is a prefix.
Pattern local_pattern(int32_t bits);

// The same for sgm: sigma 2.5, offsets below 9, 1024 pairs.
Pattern sgm_pattern(int32_t bits);

}  // namespace bsm

#endif  // BSM_CORE_PATTERN_H
