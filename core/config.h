// Checks a configuration and answers what follows from it alone.
#ifndef BSM_CORE_CONFIG_H
#define BSM_CORE_CONFIG_H

#include <stdint.h>

#include "bsm/bsm.h"

namespace bsm {

// BSM_OK, or the status of the first field that is out of its range.
bsm_status validate_config(const bsm_config* config);

// Bytes of a pixel of plane 0.
int32_t pixel_bytes(int32_t format);

}  // namespace bsm

#endif  // BSM_CORE_CONFIG_H
