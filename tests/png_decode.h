// png_decode.h - a decoder for the PNG files that the program writes: 8 bit, gray or RGB, stored deflate blocks, filter 0.
// It checks every checksum and length, so that other readers will take the files too.
#ifndef BSM_TESTS_PNG_DECODE_H
#define BSM_TESTS_PNG_DECODE_H

#include <cstdint>
#include <string>
#include <vector>

#include "host/image.h"

namespace bsm::test {

// Fails the case when anything in the file is not as the PNG specification says.
host::Image8 decode_png(const std::string& bytes);

}  // namespace bsm::test

#endif  // BSM_TESTS_PNG_DECODE_H
