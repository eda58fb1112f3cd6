// Checks a configuration and answers what follows from it alone.
#ifndef BSM_CORE_CONFIG_H
#define BSM_CORE_CONFIG_H

#include <stdint.h>

#include "bsm/bsm.h"
#include "simd/build.h"

namespace bsm {

// BSM_OK, or the status of the first field that is out of its range.
bsm_status validate_config(const bsm_config* config);

// Whether the format has a second plane: one chroma row for two rows of pixels.
inline bool has_chroma_plane(int32_t format) {
  return kHasColor && (format == BSM_FORMAT_NV12 || format == BSM_FORMAT_NV21);
}

// Bytes of a row of plane 0 or, in a format that has it, of the chroma plane.
int32_t row_bytes(const bsm_config& config);
int32_t chroma_row_bytes(const bsm_config& config);

}  // namespace bsm

#endif  // BSM_CORE_CONFIG_H
