// The synthetic stereo scene as whole images.
#ifndef BSM_HOST_SCENE_FRAME_H
#define BSM_HOST_SCENE_FRAME_H

#include <cstdint>
#include <vector>

#include "host/image.h"
#include "host/scene.h"

namespace bsm::host {

struct Scene {
  Image8 left, right;                                // R G B
  std::vector<int16_t> left_truth, right_truth;      // 1/16 pixel, known everywhere
  std::vector<uint8_t> left_visible, right_visible;  // 255 = the other view shows the point too (non-occluded), else 0
};

Scene render_scene(const SceneOptions& options);

}  // namespace bsm::host

#endif  // BSM_HOST_SCENE_FRAME_H
