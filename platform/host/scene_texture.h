// Textures of the synthetic scene's surfaces: smooth noise and patterns that can be read between pixels. Integers alone.
#ifndef BSM_HOST_SCENE_TEXTURE_H
#define BSM_HOST_SCENE_TEXTURE_H

#include <stdint.h>

namespace bsm::host {

constexpr int kTextureCount = 8;

// Colour (R G B, each within 0..255) of a surface at (x, y), 16 fractional bits, |x| and |y| below 2^15 pixels.
void scene_texture(uint32_t seed, int surface, int64_t x, int64_t y, int32_t color[3]);

// 32 well-mixed bits of four numbers.
uint32_t scene_hash(uint32_t seed, uint32_t stream, uint32_t a, uint32_t b);

}  // namespace bsm::host

#endif  // BSM_HOST_SCENE_TEXTURE_H
