// Compresses bytes into the zlib format (RFC 1950, 1951), so that pages with pictures stay small.
#ifndef BSM_BENCH_REPORT_DEFLATE_H
#define BSM_BENCH_REPORT_DEFLATE_H

#include <cstdint>
#include <vector>

namespace bsm::bench {

std::vector<uint8_t> zlib_compress(const std::vector<uint8_t>& bytes);

}  // namespace bsm::bench

#endif  // BSM_BENCH_REPORT_DEFLATE_H
