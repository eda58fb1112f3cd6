// Images as the program holds them: samples as a file has them, and 8-bit pixels as the library takes them.
#ifndef BSM_HOST_IMAGE_H
#define BSM_HOST_IMAGE_H

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bsm::host {

// Samples of a PGM (1 channel) or PPM (3 channels, R G B) file, each within 0..max_value.
struct SampleImage {
  int32_t width = 0;
  int32_t height = 0;
  int32_t channels = 0;
  int32_t max_value = 0;  // 1..65535
  std::vector<uint16_t> samples;
};

// 8-bit pixels, 1 channel (gray) or 3 (R G B), rows without padding.
struct Image8 {
  int32_t width = 0;
  int32_t height = 0;
  int32_t channels = 0;
  std::vector<uint8_t> pixels;

  size_t row_bytes() const { return static_cast<size_t>(width) * static_cast<size_t>(channels); }
  const uint8_t* row(int32_t y) const { return pixels.data() + static_cast<size_t>(y) * row_bytes(); }
};

// Scales 0..max_value to 0..255, rounded to nearest.
Image8 to_image8(const SampleImage& image);

// Three equal channels from one; an image of three is returned as it is.
Image8 to_rgb(const Image8& image);

}  // namespace bsm::host

#endif  // BSM_HOST_IMAGE_H
