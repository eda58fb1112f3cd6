// scene_hashes.h - what every target has to reproduce: the golden hash of the synthetic scene's left map by each method, of
// the frame at once and row by row. Needs no C library, so that firmware and WebAssembly run it too.
#ifndef BSM_TESTS_SCENE_HASHES_H
#define BSM_TESTS_SCENE_HASHES_H

#include <stddef.h>
#include <stdint.h>

#include "bsm/bsm.h"

namespace bsm::test {

constexpr int32_t kSceneWidth = 160, kSceneHeight = 120, kSceneDisparities = 32;
constexpr size_t kSceneRowBytes = 3 * kSceneWidth;  // R G B
constexpr size_t kSceneBytes = kSceneRowBytes * kSceneHeight;
constexpr size_t kSceneMapValues = size_t{kSceneWidth} * kSceneHeight;

// The scene in rgb24: local is the preset paper with 256 bits, sgm the preset fast.
bsm_config scene_config(bsm_method method);

// The hash that scene_config(method) has to give, from golden.inc.
uint64_t golden_scene_hash(bsm_method method);

// Hashes of the map that a configuration of the scene's size gives; *hash is written when the result is BSM_OK.
struct SceneMemory {
  uint8_t* left;   // the frame: kSceneBytes each; rows: kSceneRowBytes each
  uint8_t* right;  //
  int16_t* map;    // the frame: kSceneMapValues; rows: kSceneWidth
  void* arena;
  size_t arena_bytes;
};
bsm_status hash_scene_frame(const bsm_config& config, const SceneMemory& memory, uint64_t* hash);
bsm_status hash_scene_rows(const bsm_config& config, const SceneMemory& memory, uint64_t* hash);

}  // namespace bsm::test

#endif  // BSM_TESTS_SCENE_HASHES_H
