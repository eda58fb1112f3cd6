// Colours for disparities.
#include "host/colormap.h"

namespace bsm::host {
namespace {

// Points at equal steps of OKLab lightness, 0.30 to 0.93, hue turning from violet to yellow; sRGB. Between them, linear.
constexpr int kPointCount = 9;
constexpr Color kPoints[kPointCount] = {{60, 4, 109},  {52, 38, 160},  {10, 89, 153},  {16, 123, 142}, {19, 154, 129},
                                        {62, 185, 76}, {154, 200, 36}, {214, 215, 36}, {254, 233, 130}};

uint8_t blend(uint8_t from, uint8_t to, int weight) {
  return static_cast<uint8_t>((from * (255 - weight) + to * weight + 127) / 255);
}

}  // namespace

Color map_color(uint8_t level) {
  const int scaled = level * (kPointCount - 1);
  const int index = scaled / 255;
  if (index == kPointCount - 1) return kPoints[index];
  const int weight = scaled % 255;
  const Color& from = kPoints[index];
  const Color& to = kPoints[index + 1];
  return {blend(from.r, to.r, weight), blend(from.g, to.g, weight), blend(from.b, to.b, weight)};
}

}  // namespace bsm::host
