// The synthetic stereo scene as whole images.
#include "host/scene_frame.h"

namespace bsm::host {

Scene render_scene(const SceneOptions& options) {
  const size_t width = static_cast<size_t>(options.width);
  const size_t count = width * static_cast<size_t>(options.height);
  Scene scene;
  scene.left = Image8{options.width, options.height, 3, std::vector<uint8_t>(count * 3)};
  scene.right = scene.left;
  scene.left_truth.resize(count);
  scene.right_truth.resize(count);
  scene.left_visible.resize(count);
  scene.right_visible.resize(count);
  for (int32_t y = 0; y < options.height; ++y) {
    const size_t at = static_cast<size_t>(y) * width;
    scene_row(options, y,
              SceneRow{scene.left.pixels.data() + 3 * at, scene.right.pixels.data() + 3 * at, scene.left_truth.data() + at,
                       scene.right_truth.data() + at, scene.left_visible.data() + at, scene.right_visible.data() + at});
  }
  return scene;
}

}  // namespace bsm::host
