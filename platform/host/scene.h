// A synthetic stereo scene with exact ground truth, one row at a time: textured slanted planes at several depths that hide
// each other, sub-pixel disparities, sensor noise, and a right camera that is darker, tinted and vignetted.
//
// Integer arithmetic alone, no memory of its own, nothing but <stdint.h>: the same bytes on every machine.
#ifndef BSM_HOST_SCENE_H
#define BSM_HOST_SCENE_H

#include <stdint.h>

namespace bsm::host {

struct SceneOptions {
  int32_t width = 450;           // 1..BSM_MAX_SIZE
  int32_t height = 375;          // 1..BSM_MAX_SIZE
  int32_t min_disparity = 0;     // every disparity lies within min_disparity .. min_disparity + num_disparities - 1 pixels,
  int32_t num_disparities = 64;  // and spans no more than a quarter of the width
  uint32_t seed = 1;             // of the textures and the noise; the shapes stay
};

// Where a row goes; each may be null. Colours are R G B, 3 * width bytes; truths are width values in 1/16 pixel, signs as in
// the library's maps; visible is 255 where the other view shows the same point too, else 0.
struct SceneRow {
  uint8_t* left;
  uint8_t* right;
  int16_t* left_truth;
  int16_t* right_truth;
  uint8_t* left_visible;
  uint8_t* right_visible;
};

// Renders row y of both views, 0 <= y < height.
void scene_row(const SceneOptions& options, int32_t y, const SceneRow& row);

}  // namespace bsm::host

#endif  // BSM_HOST_SCENE_H
