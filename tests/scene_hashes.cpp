// scene_hashes.cpp - renders the synthetic scene, matches it and hashes the map.
#include "scene_hashes.h"

#include "hash.h"
#include "host/scene.h"

namespace bsm::test {
namespace {

struct Golden {
  const char* name;
  uint64_t hash;
};
constexpr Golden kGolden[] = {
#include "golden.inc"
};

constexpr bool same_text(const char* a, const char* b) {
  while (*a != 0 && *a == *b) ++a, ++b;
  return *a == *b;
}

constexpr uint64_t golden_hash(const char* name) {
  for (const Golden& golden : kGolden) {
    if (same_text(golden.name, name)) return golden.hash;
  }
  return 0;
}
constexpr uint64_t kLocalHash = golden_hash("256 rgb24 refined left");
constexpr uint64_t kSgmHash = golden_hash("fast rgb24 refined left");
static_assert(kLocalHash != 0 && kSgmHash != 0, "golden.inc holds both");

void render_row(int32_t y, uint8_t* left, uint8_t* right) {
  host::SceneOptions options;
  options.width = kSceneWidth;
  options.height = kSceneHeight;
  options.num_disparities = kSceneDisparities;
  host::scene_row(options, y, host::SceneRow{left, right, nullptr, nullptr, nullptr, nullptr});
}

// Pulls the rows that are finished.
bsm_status hash_finished(bsm_context* context, int16_t* row, Hash& hash) {
  for (;;) {
    const bsm_status status = bsm_pull_row(context, row, nullptr, nullptr);
    if (status != BSM_OK) return status;
    for (int32_t x = 0; x < kSceneWidth; ++x) hash.add(row[x]);
  }
}

}  // namespace

bsm_config scene_config(bsm_method method) {
  bsm_config config;
  bsm_config_init(&config, kSceneWidth, kSceneHeight);
  bsm_config_preset(&config, method == BSM_METHOD_LOCAL ? BSM_PRESET_PAPER : BSM_PRESET_FAST);
  if (method == BSM_METHOD_LOCAL) config.bits = 256;
  config.num_disparities = kSceneDisparities;
  return config;
}

uint64_t golden_scene_hash(bsm_method method) {
  return method == BSM_METHOD_LOCAL ? kLocalHash : kSgmHash;
}

bsm_status hash_scene_frame(const bsm_config& config, const SceneMemory& memory, uint64_t* hash) {
  bsm_context* context = nullptr;
  bsm_status status = bsm_open(&config, memory.arena, memory.arena_bytes, &context);
  if (status != BSM_OK) return status;
  for (int32_t y = 0; y < kSceneHeight; ++y) {
    const size_t at = static_cast<size_t>(y) * kSceneRowBytes;
    render_row(y, memory.left + at, memory.right + at);
  }
  bsm_frame frame{};
  frame.left = bsm_image{{memory.left, nullptr}, {kSceneRowBytes, 0}};
  frame.right = bsm_image{{memory.right, nullptr}, {kSceneRowBytes, 0}};
  frame.disparity = bsm_map{memory.map, kSceneWidth * sizeof(int16_t)};
  status = bsm_process(context, &frame);
  if (status != BSM_OK) return status;
  Hash sum;
  for (size_t i = 0; i < kSceneMapValues; ++i) sum.add(memory.map[i]);
  *hash = sum.value();
  return BSM_OK;
}

bsm_status hash_scene_rows(const bsm_config& config, const SceneMemory& memory, uint64_t* hash) {
  bsm_context* context = nullptr;
  bsm_status status = bsm_open(&config, memory.arena, memory.arena_bytes, &context);
  if (status != BSM_OK) return status;
  const bsm_row left{{memory.left, nullptr}}, right{{memory.right, nullptr}};
  Hash sum;
  for (int32_t y = 0; y < kSceneHeight; ++y) {
    render_row(y, memory.left, memory.right);
    status = bsm_push_row(context, &left, &right);
    if (status != BSM_OK) return status;
    status = hash_finished(context, memory.map, sum);
    if (status != BSM_NEED_ROWS && status != BSM_END) return status;
  }
  status = hash_finished(context, memory.map, sum);
  if (status != BSM_END) return status;
  *hash = sum.value();
  return BSM_OK;
}

}  // namespace bsm::test
