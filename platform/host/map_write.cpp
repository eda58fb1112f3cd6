// Writes disparity maps.
#include "host/map_write.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "bsm/bsm.h"
#include "host/colormap.h"
#include "host/png_write.h"
#include "host/text.h"

namespace bsm::host {
namespace {

constexpr char kNegativeAdvice[] = "holds no negative disparities; write a .pfm";

size_t pixel_count(const MapView& map) {
  return static_cast<size_t>(map.width) * static_cast<size_t>(map.height);
}

void append(std::vector<uint8_t>* bytes, const std::string& header) {
  bytes->insert(bytes->end(), header.begin(), header.end());
}

std::vector<uint8_t> encode_pfm(const MapView& map) {
  std::vector<uint8_t> bytes;
  bytes.reserve(pixel_count(map) * 4 + 40);
  append(&bytes, text("Pf\n%d %d\n-1.0\n", static_cast<int>(map.width), static_cast<int>(map.height)));
  for (int32_t y = map.height - 1; y >= 0; --y) {
    const int16_t* row = map.values + static_cast<size_t>(y) * static_cast<size_t>(map.width);
    for (int32_t x = 0; x < map.width; ++x) {
      const float value = row[x] == map.invalid ? std::numeric_limits<float>::infinity()
                                                : static_cast<float>(row[x]) / static_cast<float>(BSM_DISPARITY_SCALE);
      uint32_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<uint8_t>(bits >> shift));
    }
  }
  return bytes;
}

bool encode_pgm16(const MapView& map, std::vector<uint8_t>* bytes, std::string* error) {
  bytes->clear();
  bytes->reserve(pixel_count(map) * 2 + 40);
  append(bytes, text("P5\n%d %d\n65535\n", static_cast<int>(map.width), static_cast<int>(map.height)));
  for (size_t i = 0; i < pixel_count(map); ++i) {
    const int32_t value = map.values[i];
    if (value != map.invalid && value < 0) {
      *error = std::string("a .pgm ") + kNegativeAdvice;
      return false;
    }
    const int32_t sample = value == map.invalid ? 65535 : value;
    bytes->push_back(static_cast<uint8_t>(sample >> 8));
    bytes->push_back(static_cast<uint8_t>(sample & 255));
  }
  return true;
}

// 0 = invalid; valid values within 1..255.
bool to_levels(const MapView& map, const MapStyle& style, std::vector<uint8_t>* levels, std::string* error) {
  const double first = style.scale > 0.0 ? 0.0 : map.min_disparity;
  const double range = std::max(1, map.num_disparities - 1);
  levels->resize(pixel_count(map));
  for (size_t i = 0; i < pixel_count(map); ++i) {
    const int32_t value = map.values[i];
    if (value == map.invalid) {
      (*levels)[i] = 0;
      continue;
    }
    if (style.scale > 0.0 && value < 0) {
      *error = std::string("an 8-bit file with --scale ") + kNegativeAdvice;
      return false;
    }
    const double disparity = static_cast<double>(value) / BSM_DISPARITY_SCALE;
    const double level = style.scale > 0.0 ? disparity * style.scale : 1.0 + (disparity - first) * 254.0 / range;
    (*levels)[i] = static_cast<uint8_t>(std::min(255.0, std::max(1.0, std::floor(level + 0.5))));
  }
  return true;
}

}  // namespace

bool parse_map_output(const std::string& argument, MapOutput* output, std::string* error) {
  std::string extension = lower_extension(argument);
  output->path = argument;
  if (argument == "-") {
    extension = "pgm";
  } else if (argument == "pfm:-" || argument == "pgm:-" || argument == "png:-") {
    extension = argument.substr(0, 3);
    output->path = "-";
  }
  if (extension == "pfm") {
    output->format = MapFormat::kPfm;
  } else if (extension == "pgm") {
    output->format = MapFormat::kPgm;
  } else if (extension == "png") {
    output->format = MapFormat::kPng;
  } else {
    *error = "the name must end in .pfm, .pgm or .png, which says what is written (- is a PGM to standard output)";
    return false;
  }
  return true;
}

bool check_map_style(const MapOutput& output, const MapStyle& style, int32_t min_disparity, std::string* error) {
  if (style.color && output.format != MapFormat::kPng) {
    *error = "--color is for .png; leave it out or write a .png";
  } else if (style.scale > 0.0 && output.format == MapFormat::kPfm) {
    *error = "--scale is for .pgm and .png, a .pfm holds pixels; leave it out";
  } else if (min_disparity < 0 &&
             (output.format == MapFormat::kPgm || (output.format == MapFormat::kPng && style.scale > 0.0))) {
    *error = "the search begins at a negative disparity, but " +
             std::string(output.format == MapFormat::kPgm ? "a .pgm " : "a .png with --scale ") + kNegativeAdvice;
  } else {
    return true;
  }
  return false;
}

bool draw_map(const MapView& map, const MapStyle& style, Image8* image, std::string* error) {
  std::vector<uint8_t> levels;
  if (!to_levels(map, style, &levels, error)) return false;
  image->width = map.width;
  image->height = map.height;
  image->channels = style.color ? 3 : 1;
  if (!style.color) {
    image->pixels = std::move(levels);
    return true;
  }
  image->pixels.clear();
  image->pixels.reserve(levels.size() * 3);
  for (const uint8_t level : levels) {
    const Color color = level == 0 ? kInvalidColor : map_color(level);
    image->pixels.insert(image->pixels.end(), {color.r, color.g, color.b});
  }
  return true;
}

std::vector<uint8_t> encode_pnm(const Image8& image) {
  std::vector<uint8_t> bytes;
  append(&bytes, text("P%c\n%d %d\n255\n", image.channels == 3 ? '6' : '5', static_cast<int>(image.width),
                      static_cast<int>(image.height)));
  bytes.insert(bytes.end(), image.pixels.begin(), image.pixels.end());
  return bytes;
}

bool encode_map(const MapView& map, MapFormat format, const MapStyle& style, std::vector<uint8_t>* bytes,
                std::string* error) {
  if (format == MapFormat::kPfm) {
    *bytes = encode_pfm(map);
    return true;
  }
  if (format == MapFormat::kPgm && !(style.scale > 0.0)) return encode_pgm16(map, bytes, error);
  Image8 image;
  MapStyle drawn = style;
  if (format == MapFormat::kPgm) drawn.color = false;
  if (!draw_map(map, drawn, &image, error)) return false;
  *bytes = format == MapFormat::kPng ? encode_png(image) : encode_pnm(image);
  return true;
}

}  // namespace bsm::host
