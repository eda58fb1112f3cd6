// Writes disparity maps as .pfm, .pgm (8 or 16 bit) or .png (gray or colour).
#ifndef BSM_HOST_MAP_WRITE_H
#define BSM_HOST_MAP_WRITE_H

#include <cstdint>
#include <string>
#include <vector>

#include "host/image.h"

namespace bsm::host {

// A map of the library, rows without padding, and what was searched for it.
struct MapView {
  const int16_t* values = nullptr;  // 1/16 pixel
  int32_t width = 0;
  int32_t height = 0;
  int16_t invalid = 0;
  int32_t min_disparity = 0;
  int32_t num_disparities = 1;
};

enum class MapFormat { kPfm, kPgm, kPng };

struct MapOutput {
  std::string path;  // "-" = standard output
  MapFormat format = MapFormat::kPgm;
};

struct MapStyle {
  double scale = 0.0;  // > 0: 8-bit value = disparity * scale; 0: 16-bit PGM, or PNG that spreads the searched range
  bool color = false;  // PNG in colour
};

// Takes an output as the user names it: a path whose extension is .pfm, .pgm or .png; "-" (standard output, PGM); or
// "pfm:-", "pgm:-", "png:-".
bool parse_map_output(const std::string& argument, MapOutput* output, std::string* error);

// Refuses what the format cannot hold, before any work is done: a scale for PFM, colour outside PNG, negative disparities
// anywhere but in PFM and the PNG that spreads the range.
bool check_map_style(const MapOutput& output, const MapStyle& style, int32_t min_disparity, std::string* error);

// The bytes of the file.
//   PFM: pixels, +inf = invalid, little-endian.
//   8-bit PGM and PNG: 0 = invalid; valid: disparity * scale rounded, within 1..255.
//   16-bit PGM: 1/16 pixel; 65535 = invalid.
//   PNG without scale: 0 = invalid, 1 = the smallest disparity searched, 255 = the largest. In colour 0 is black.
// Fails when a valid disparity is negative where the format cannot hold it.
bool encode_map(const MapView& map, MapFormat format, const MapStyle& style, std::vector<uint8_t>* bytes,
                std::string* error);

// The picture that a PNG of the map holds.
bool draw_map(const MapView& map, const MapStyle& style, Image8* image, std::string* error);

// The bytes of a binary PGM or PPM file.
std::vector<uint8_t> encode_pnm(const Image8& image);

}  // namespace bsm::host

#endif  // BSM_HOST_MAP_WRITE_H
