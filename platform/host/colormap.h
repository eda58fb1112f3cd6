// Colours for disparities: from dark violet (far) through blue and green to pale yellow (near), lightness rising evenly so
// that the picture reads the same in print and for the colour-blind.
#ifndef BSM_HOST_COLORMAP_H
#define BSM_HOST_COLORMAP_H

#include <cstdint>

namespace bsm::host {

struct Color {
  uint8_t r, g, b;
};

// Colour of level 0..255.
Color map_color(uint8_t level);

// Colour of a pixel without a disparity.
constexpr Color kInvalidColor{0, 0, 0};

}  // namespace bsm::host

#endif  // BSM_HOST_COLORMAP_H
