// Encodes PNG files with filters and compression.
#ifndef BSM_BENCH_REPORT_COMPACT_PNG_H
#define BSM_BENCH_REPORT_COMPACT_PNG_H

#include <cstdint>
#include <vector>

#include "host/image.h"

namespace bsm::bench {

// The bytes of a PNG file. The image has 1 or 3 channels and at least one pixel.
std::vector<uint8_t> encode_compact_png(const host::Image8& image);

}  // namespace bsm::bench

#endif  // BSM_BENCH_REPORT_COMPACT_PNG_H
