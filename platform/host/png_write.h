// Encodes PNG files: 8-bit gray or RGB, no compression.
#ifndef BSM_HOST_PNG_WRITE_H
#define BSM_HOST_PNG_WRITE_H

#include <cstdint>
#include <vector>

#include "host/image.h"

namespace bsm::host {

// The bytes of a PNG file. The image has 1 or 3 channels and at least one pixel.
std::vector<uint8_t> encode_png(const Image8& image);

}  // namespace bsm::host

#endif  // BSM_HOST_PNG_WRITE_H
