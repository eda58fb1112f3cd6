// Reads PGM and PPM images: P2, P3 (ASCII), P5, P6 (binary), 8 and 16 bit, comments, several on one stream.
//
// Input is taken as hostile: every size is bounded before use and memory grows with the bytes that really arrive.
#ifndef BSM_HOST_PNM_READ_H
#define BSM_HOST_PNM_READ_H

#include <string>

#include "host/byte_source.h"
#include "host/image.h"

namespace bsm::host {

// What messages call standard input.
constexpr char kStandardInput[] = "standard input";

// Reads the next image of the source. `name` is what error messages call it: a path where there is one, for they may name
// the command that converts the file to one that ends in `wanted`. On failure *image is unspecified and *error says what is
// wrong and what to do.
bool read_pnm(ByteSource& source, const std::string& name, SampleImage* image, std::string* error,
              const char* wanted = "ppm");

// The same from a file, or from standard input when path is "-"; then the bytes after the image are left for the next call.
bool read_pnm_file(const std::string& path, SampleImage* image, std::string* error, const char* wanted = "ppm");

// What to tell someone whose file begins with these two bytes, which no PGM or PPM begins with.
std::string not_pnm_message(const std::string& name, int first, int second, const char* wanted);

}  // namespace bsm::host

#endif  // BSM_HOST_PNM_READ_H
