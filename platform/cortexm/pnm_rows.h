// Images of the computer at the other end of the probe, row by row: what stands in for cameras and a display in the example.
#ifndef BSM_CORTEXM_PNM_ROWS_H
#define BSM_CORTEXM_PNM_ROWS_H

#include <stdint.h>

namespace bsm::cortexm {

// A binary PGM or PPM of 8 bits a sample.
struct ImageRows {
  int32_t file;
  int32_t width, height;
  int32_t channels;  // 1: PGM, 3: PPM
};

// nullptr, or what is wrong with the file.
const char* open_image(const char* path, ImageRows* image);
bool read_row(const ImageRows& image, uint8_t* row);

// A 16-bit PGM that holds disparities in 1/16 pixel, as the program bsm writes it. Negative disparities have no place in it.
struct MapRows {
  int32_t file;
  int32_t width;
  int16_t invalid;
};

const char* create_map(const char* path, int32_t width, int32_t height, int16_t invalid, MapRows* map);
// Turns the row into the file's bytes in place.
bool write_row(const MapRows& map, int16_t* row);

}  // namespace bsm::cortexm

#endif  // BSM_CORTEXM_PNM_ROWS_H
