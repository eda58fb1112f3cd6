// Reads and writes rows of PNM files by semihosting.
#include "cortexm/pnm_rows.h"

#include "cortexm/semihosting.h"
#include "cortexm/text.h"

namespace bsm::cortexm {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

// The next number of a header, after white space and comments; the character after it is read as well. -1: no number.
int32_t read_number(int32_t file) {
  char c = 0;
  do {
    if (!host_read(file, &c, 1)) return -1;
    while (c == '#') {
      while (c != '\n') {
        if (!host_read(file, &c, 1)) return -1;
      }
    }
  } while (is_space(c));
  int32_t number = -1;
  while ('0' <= c && c <= '9' && number < 100000) {
    number = (number < 0 ? 0 : 10 * number) + (c - '0');
    if (!host_read(file, &c, 1)) return -1;
  }
  return is_space(c) ? number : -1;
}

}  // namespace

const char* open_image(const char* path, ImageRows* image) {
  image->file = host_open(path, OpenMode::kRead);
  if (image->file < 0) return "cannot be opened";
  char magic[2];
  if (!host_read(image->file, magic, sizeof magic) || magic[0] != 'P' || (magic[1] != '5' && magic[1] != '6')) {
    return "is no binary PGM or PPM";
  }
  image->channels = magic[1] == '5' ? 1 : 3;
  image->width = read_number(image->file);
  image->height = read_number(image->file);
  if (image->width < 1 || image->height < 1) return "has a damaged header";
  return read_number(image->file) == 255 ? nullptr : "does not have 8 bits a sample";
}

bool read_row(const ImageRows& image, uint8_t* row) {
  return host_read(image.file, row, static_cast<size_t>(image.channels * image.width));
}

const char* create_map(const char* path, int32_t width, int32_t height, int16_t invalid, MapRows* map) {
  map->file = host_open(path, OpenMode::kWrite);
  map->width = width;
  map->invalid = invalid;
  if (map->file < 0) return "cannot be created";
  char header[32];
  char* end = append_text(header, "P5\n");
  end = append_decimal(end, static_cast<uint32_t>(width));
  end = append_text(end, " ");
  end = append_decimal(end, static_cast<uint32_t>(height));
  end = append_text(end, "\n65535\n");
  return host_write(map->file, header, static_cast<size_t>(end - header)) ? nullptr : "cannot be written";
}

bool write_row(const MapRows& map, int16_t* row) {
  uint8_t* bytes = reinterpret_cast<uint8_t*>(row);
  for (int32_t x = 0; x < map.width; ++x) {
    const uint32_t sample = row[x] == map.invalid ? 65535u : static_cast<uint32_t>(row[x]);
    bytes[2 * x] = static_cast<uint8_t>(sample >> 8);
    bytes[2 * x + 1] = static_cast<uint8_t>(sample);
  }
  return host_write(map.file, bytes, sizeof *row * static_cast<size_t>(map.width));
}

}  // namespace bsm::cortexm
