// Textures of the synthetic scene.
#include "host/scene_texture.h"

namespace bsm::host {
namespace {

enum class Pattern { kCloud, kStripes, kChecker, kBricks, kRings };

// Colours between `dark` and `light`; `size` is the pattern's period in pixels, the direction of stripes is (turn_x,
// turn_y).
struct Material {
  Pattern pattern;
  int32_t dark[3], light[3];
  int32_t size, turn_x, turn_y;
};

constexpr Material kMaterials[kTextureCount] = {
    {Pattern::kBricks, {92, 74, 66}, {196, 156, 128}, 28, 1, 0},    // wall
    {Pattern::kChecker, {60, 82, 74}, {168, 184, 160}, 26, 1, 0},   // floor
    {Pattern::kStripes, {30, 60, 128}, {186, 208, 236}, 19, 2, 1},  // board
    {Pattern::kCloud, {120, 40, 30}, {248, 170, 70}, 1, 1, 0},      // disc
    {Pattern::kRings, {40, 92, 40}, {178, 216, 110}, 9, 1, 0},      // ring
    {Pattern::kCloud, {70, 30, 100}, {216, 160, 232}, 1, 1, 0},     // box
    {Pattern::kStripes, {90, 70, 20}, {250, 226, 120}, 23, 1, 3},   // pole
    {Pattern::kRings, {20, 76, 96}, {150, 226, 226}, 6, 1, 0},      // triangle
};

constexpr uint32_t kOrigin = 1u << 23;  // moves coordinates with 8 fractional bits into the positive range
constexpr int32_t kFull = 65280;        // largest value of smooth noise: 255 * 256

// 0..255 to 0..255, flat at both ends.
uint32_t smooth_step(uint32_t t) {
  return t * t * (3 * 256 - 2 * t) >> 16;
}

// Value noise: random values at the corners of cells of 2^cell_log2 pixels, joined smoothly. u and v have 8 fractional bits.
// Result within 0..kFull.
int32_t smooth_noise(uint32_t seed, uint32_t stream, uint32_t u, uint32_t v, int cell_log2) {
  const uint32_t cell_u = u >> (8 + cell_log2), cell_v = v >> (8 + cell_log2);
  const uint32_t in_u = smooth_step(u >> cell_log2 & 255u), in_v = smooth_step(v >> cell_log2 & 255u);
  const uint32_t a = scene_hash(seed, stream, cell_u, cell_v) & 255u,
                 b = scene_hash(seed, stream, cell_u + 1, cell_v) & 255u;
  const uint32_t c = scene_hash(seed, stream, cell_u, cell_v + 1) & 255u;
  const uint32_t d = scene_hash(seed, stream, cell_u + 1, cell_v + 1) & 255u;
  const uint32_t top = a * (256 - in_u) + b * in_u, bottom = c * (256 - in_u) + d * in_u;
  return static_cast<int32_t>((top * (256 - in_v) + bottom * in_v) >> 8);
}

// Noise of four scales, 32 pixels down to 2. Result within 0..kFull.
int32_t cloud(uint32_t seed, uint32_t stream, uint32_t u, uint32_t v) {
  return (2 * smooth_noise(seed, stream, u, v, 5) + 3 * smooth_noise(seed, stream + 1, u, v, 3) +
          2 * smooth_noise(seed, stream + 2, u, v, 2) + smooth_noise(seed, stream + 3, u, v, 1)) /
         8;
}

// Triangle wave of `position`, 0..kFull..0 within each period, which is even.
int32_t wave(uint32_t position, uint32_t period) {
  const uint32_t phase = position % period;
  const uint32_t half = period / 2;
  const uint32_t rising = phase < half ? phase : period - phase;
  return static_cast<int32_t>(uint64_t{rising} * static_cast<uint32_t>(kFull) / half);
}

// Share of light in the mixture, before the fine detail. Within 0..kFull.
int32_t pattern_value(const Material& material, uint32_t u, uint32_t v, int32_t noise) {
  const uint32_t period = static_cast<uint32_t>(material.size) * 256;
  switch (material.pattern) {
    case Pattern::kCloud:
      return noise;
    case Pattern::kStripes:
      return wave(u * static_cast<uint32_t>(material.turn_x) + v * static_cast<uint32_t>(material.turn_y), 2 * period);
    case Pattern::kChecker:
      return (u / period + v / period) % 2 != 0 ? kFull * 3 / 4 : kFull / 4;
    case Pattern::kBricks: {
      const uint32_t course = 2 * v / period;
      const uint32_t along = (u + course % 2 * period / 2) % period, across = 2 * v % period;
      return along < period / 10 || across < period / 6 ? kFull / 8 : kFull * 5 / 8;
    }
    case Pattern::kRings:
      return wave(static_cast<uint32_t>(noise), static_cast<uint32_t>(kFull / material.size) & ~1u);
  }
  return noise;
}

}  // namespace

uint32_t scene_hash(uint32_t seed, uint32_t stream, uint32_t a, uint32_t b) {
  uint32_t h = ((seed * 0x9e3779b1u + stream) ^ a) * 0x85ebca6bu;
  h ^= h >> 15;
  h = ((h * 0xc2b2ae35u + stream) ^ b) * 0x85ebca6bu;
  h ^= h >> 13;
  h *= 0x27d4eb2fu;
  return h ^ h >> 16;
}

void scene_texture(uint32_t seed, int surface, int64_t x, int64_t y, int32_t color[3]) {
  const Material& material = kMaterials[surface];
  const uint32_t u = static_cast<uint32_t>(x / 256 + kOrigin), v = static_cast<uint32_t>(y / 256 + kOrigin);
  const uint32_t stream = 1024 + 16 * static_cast<uint32_t>(surface);
  const int32_t noise = cloud(seed, stream, u, v);
  const int32_t mixture = (pattern_value(material, u, v, noise) + noise) / 2;
  for (int c = 0; c < 3; ++c) {
    const int32_t detail = smooth_noise(seed, stream + 4 + static_cast<uint32_t>(c), u, v, 2) - kFull / 2;
    const int32_t value =
        material.dark[c] + (material.light[c] - material.dark[c]) * (mixture / 16) / (kFull / 16) + detail / 1600;
    color[c] = value < 0 ? 0 : value > 255 ? 255 : value;
  }
}

}  // namespace bsm::host
