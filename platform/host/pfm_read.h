// Reads PFM files of one channel: floating-point maps, rows from the bottom up, either byte order.
#ifndef BSM_HOST_PFM_READ_H
#define BSM_HOST_PFM_READ_H

#include <string>
#include <vector>

#include "host/byte_source.h"

namespace bsm::host {

struct FloatImage {
  int32_t width = 0;
  int32_t height = 0;
  std::vector<float> pixels;  // rows from the top down
};

// Reads the next PFM of the source; `name` is what error messages call it. Hostile input as in pnm_read.h.
bool read_pfm(ByteSource& source, const std::string& name, FloatImage* image, std::string* error);

}  // namespace bsm::host

#endif  // BSM_HOST_PFM_READ_H
