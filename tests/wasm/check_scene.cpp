// The golden hashes of scene_hashes.h as a WebAssembly module. It imports nothing and exports its memory and the functions
// below, which check_scene.js calls.
#include "scene_hashes.h"

using namespace bsm::test;

namespace {

alignas(64) uint8_t arena[1 << 20];
uint8_t left[kSceneBytes], right[kSceneBytes];
int16_t map[kSceneMapValues];
constexpr SceneMemory kMemory{left, right, map, arena, sizeof arena};

}  // namespace

#define EXPORT(name) extern "C" __attribute__((export_name(#name)))

// The hash that a method gives with the kernels that isa_mask allows, by rows or of the frame at once; 0 when the library
// reports an error.
EXPORT(scene_hash) uint64_t scene_hash(int32_t method, int32_t by_rows, uint32_t isa_mask) {
  bsm_config config = scene_config(static_cast<bsm_method>(method));
  config.isa_mask = isa_mask;
  uint64_t hash = 0;
  (by_rows != 0 ? hash_scene_rows : hash_scene_frame)(config, kMemory, &hash);
  return hash;
}

// The hash that it has to give.
EXPORT(golden_hash) uint64_t golden_hash(int32_t method) {
  return golden_scene_hash(static_cast<bsm_method>(method));
}

// Name of the kernel that makes the masks, as text that ends with a zero.
EXPORT(kernel_name) const char* kernel_name(uint32_t isa_mask) {
  bsm_config config = scene_config(BSM_METHOD_SGM);
  config.isa_mask = isa_mask;
  bsm_context* context = nullptr;
  if (bsm_open(&config, arena, sizeof arena, &context) != BSM_OK) return "";
  return bsm_kernel_name(context, BSM_KERNEL_MASK);
}
