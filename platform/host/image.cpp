// Conversions between the images that the program holds.
#include "host/image.h"

namespace bsm::host {

Image8 to_image8(const SampleImage& image) {
  Image8 result;
  result.width = image.width;
  result.height = image.height;
  result.channels = image.channels;
  result.pixels.resize(image.samples.size());
  const uint32_t max_value = static_cast<uint32_t>(image.max_value);
  for (size_t i = 0; i < image.samples.size(); ++i) {
    result.pixels[i] = static_cast<uint8_t>((image.samples[i] * 255u + max_value / 2) / max_value);
  }
  return result;
}

Image8 to_rgb(const Image8& image) {
  if (image.channels == 3) return image;
  Image8 result;
  result.width = image.width;
  result.height = image.height;
  result.channels = 3;
  result.pixels.resize(image.pixels.size() * 3);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    result.pixels[3 * i] = result.pixels[3 * i + 1] = result.pixels[3 * i + 2] = image.pixels[i];
  }
  return result;
}

}  // namespace bsm::host
