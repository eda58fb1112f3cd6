// Draws maps in colours.
#include "bench/experiments/pictures.h"

#include <algorithm>
#include <cmath>

#include "host/colormap.h"

namespace bsm::bench {
namespace {

host::Image8 draw(const Pair& pair, const host::DisparityMap& map) {
  host::Image8 picture{map.width, map.height, 3, {}};
  picture.pixels.reserve(3 * map.pixels.size());
  const double unit = 255.0 / std::max(1, pair.num_disparities - 1);
  for (const float d : map.pixels) {
    const double level = std::clamp(std::round(static_cast<double>(d) * unit), 0.0, 255.0);
    const host::Color color = std::isfinite(d) ? host::map_color(static_cast<uint8_t>(level)) : host::kInvalidColor;
    picture.pixels.insert(picture.pixels.end(), {color.r, color.g, color.b});
  }
  return picture;
}

}  // namespace

host::Image8 draw_match(const Pair& pair, const Match& match) {
  return draw(pair, match.map);
}

host::Image8 draw_truth(const Pair& pair) {
  return draw(pair, pair.truth);
}

}  // namespace bsm::bench
