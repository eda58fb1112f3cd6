// Reads PFM files of one channel.
#include "host/pfm_read.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "bsm/bsm.h"
#include "host/pnm_read.h"
#include "host/text.h"

namespace bsm::host {
namespace {

constexpr size_t kMaxWord = 40;  // characters of a header number

// A word of the header and the one white-space character after it. False at the end, or when a word is too long.
bool read_word(ByteSource& source, std::string* word) {
  word->clear();
  int c = source.get();
  for (size_t skipped = 0; is_space(c) && skipped < kMaxWord; ++skipped) c = source.get();
  for (; c >= 0 && !is_space(c); c = source.get()) {
    if (word->size() == kMaxWord) return false;
    word->push_back(static_cast<char>(c));
  }
  return c >= 0 && !word->empty();
}

bool parse_size(const std::string& word, int32_t* value) {
  int32_t number = 0;
  for (const char c : word) {
    if (c < '0' || c > '9') return false;
    number = number * 10 + (c - '0');
    if (number > BSM_MAX_SIZE) return false;
  }
  *value = number;
  return number > 0;
}

bool parse_scale(const std::string& word, double* scale) {
  char* end = nullptr;
  *scale = std::strtod(word.c_str(), &end);
  return *end == '\0' && (*scale < 0.0 || *scale > 0.0);
}

}  // namespace

bool read_pfm(ByteSource& source, const std::string& name, FloatImage* image, std::string* error) {
  *image = FloatImage();
  const int first = source.get();
  const int second = first < 0 ? -1 : source.get();
  if (first == 'P' && second == 'F') {
    *error = name + ": a colour PFM (PF); a disparity map has one channel (Pf)";
    return false;
  }
  if (first != 'P' || second != 'f') {
    *error = source.error().empty() ? name + ": not a PFM file" : name + ": cannot read: " + source.error();
    return false;
  }
  std::string width, height, scale_word;
  double scale = 0.0;
  if (!read_word(source, &width) || !read_word(source, &height) || !read_word(source, &scale_word) ||
      !parse_size(width, &image->width) || !parse_size(height, &image->height) || !parse_scale(scale_word, &scale)) {
    *error =
        name + text(": damaged PFM header; expected width and height within 1..%d and a byte-order number", BSM_MAX_SIZE);
    return false;
  }
  const bool little = scale < 0.0;  // its sign gives the byte order; its size is a unit that disparity maps do not use

  const size_t row_pixels = static_cast<size_t>(image->width);
  std::vector<uint8_t> bytes(row_pixels * 4);
  for (int32_t y = 0; y < image->height; ++y) {
    if (source.read(bytes.data(), bytes.size()) != bytes.size()) {
      *error = source.error().empty() ? name + text(": the file ends after %d of %d rows; it is truncated",
                                                    static_cast<int>(y), static_cast<int>(image->height))
                                      : name + ": cannot read: " + source.error();
      return false;
    }
    for (size_t x = 0; x < row_pixels; ++x) {
      const uint8_t* b = &bytes[4 * x];
      const uint32_t bits = little ? b[0] | uint32_t{b[1]} << 8 | uint32_t{b[2]} << 16 | uint32_t{b[3]} << 24
                                   : b[3] | uint32_t{b[2]} << 8 | uint32_t{b[1]} << 16 | uint32_t{b[0]} << 24;
      float value = 0.0f;
      std::memcpy(&value, &bits, sizeof value);
      image->pixels.push_back(value);
    }
  }
  for (size_t top = 0, bottom = static_cast<size_t>(image->height) - 1; top < bottom; ++top, --bottom) {
    std::swap_ranges(image->pixels.begin() + static_cast<ptrdiff_t>(top * row_pixels),
                     image->pixels.begin() + static_cast<ptrdiff_t>((top + 1) * row_pixels),
                     image->pixels.begin() + static_cast<ptrdiff_t>(bottom * row_pixels));
  }
  return true;
}

}  // namespace bsm::host
