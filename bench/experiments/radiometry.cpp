// Changes images in linear light.
#include "bench/experiments/radiometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace bsm::bench {
namespace {

constexpr double kGains[kConditions] = {0.25, 1.0, 4.0};
constexpr double kNoise = 2.0;  // levels
constexpr double kTurn = 6.283185307179586;
// The bright spot, as shares of the image.
constexpr double kSpotX = 0.35, kSpotY = 0.4, kSpotRadius = 0.25;
constexpr double kSpotGain = 2.0, kAroundSpot = 0.6;

std::array<double, 256> linear_table() {
  std::array<double, 256> table{};
  for (size_t level = 0; level < table.size(); ++level) {
    const double v = static_cast<double>(level) / 255.0;
    table[level] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  }
  return table;
}

// The sRGB level of a light, not rounded; light above white is clipped.
double level_of(double linear) {
  const double v = std::min(linear, 1.0);
  return 255.0 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055);
}

uint8_t quantize(double level) {
  return static_cast<uint8_t>(std::lround(std::clamp(level, 0.0, 255.0)));
}

// Standard normal numbers, two at a time; the generator's sequence is the same everywhere.
class Noise {
 public:
  explicit Noise(uint32_t seed) : generator_(seed) {}
  double next() {
    if (has_second_) {
      has_second_ = false;
      return second_;
    }
    const double radius = std::sqrt(-2.0 * std::log(uniform())), angle = kTurn * uniform();
    second_ = radius * std::sin(angle);
    has_second_ = true;
    return radius * std::cos(angle);
  }

 private:
  double uniform() { return (static_cast<double>(generator_()) + 0.5) / 4294967296.0; }
  std::mt19937 generator_;
  double second_ = 0.0;
  bool has_second_ = false;
};

double lighting_gain(int lighting, double x, double y) {
  if (lighting == 1) return 1.5 - x;
  if (lighting != 2) return 1.0;
  const double u = (x - kSpotX) / kSpotRadius, v = (y - kSpotY) / kSpotRadius;
  return kAroundSpot + (kSpotGain - kAroundSpot) * std::exp(-0.5 * (u * u + v * v));
}

}  // namespace

host::Image8 expose(const host::Image8& image, int exposure, uint32_t seed, bool noisy) {
  const std::array<double, 256> linear = linear_table();
  std::array<double, 256> levels{};
  for (size_t level = 0; level < levels.size(); ++level) levels[level] = level_of(kGains[exposure] * linear[level]);
  host::Image8 result = image;
  Noise noise(seed);
  for (uint8_t& sample : result.pixels) sample = quantize(levels[sample] + (noisy ? kNoise * noise.next() : 0.0));
  return result;
}

host::Image8 light(const host::Image8& image, int lighting) {
  if (lighting == 0) return image;
  const std::array<double, 256> linear = linear_table();
  host::Image8 result = image;
  const double x_unit = 1.0 / std::max(1, image.width - 1), y_unit = 1.0 / std::max(1, image.height - 1);
  size_t i = 0;
  for (int32_t y = 0; y < image.height; ++y) {
    for (int32_t x = 0; x < image.width; ++x) {
      const double gain = lighting_gain(lighting, x * x_unit, y * y_unit);
      for (int32_t c = 0; c < image.channels; ++c, ++i) {
        result.pixels[i] = quantize(level_of(gain * linear[result.pixels[i]]));
      }
    }
  }
  return result;
}

}  // namespace bsm::bench
