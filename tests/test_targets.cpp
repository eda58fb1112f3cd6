// test_targets.cpp - the golden hashes of scene_hashes.h, with every choice of kernels that this machine has. Prints the
// line that run.sh puts in its table of targets: "target: KERNELS LOCAL_HASH SGM_HASH WAYS", the best kernels first.
#include <cstdio>
#include <string>
#include <vector>

#include "check.h"
#include "matching.h"
#include "scene_hashes.h"
#include "simd/kernels.h"

using namespace bsm::test;

namespace {

// The hash of a method with the kernels that `isa_mask` allows, equal for the frame and for rows.
uint64_t hash_of(bsm_method method, uint32_t isa_mask) {
  bsm_config config = scene_config(method);
  config.isa_mask = isa_mask;
  std::vector<uint8_t> left(kSceneBytes), right(kSceneBytes), arena(arena_bytes(config));
  std::vector<int16_t> map(kSceneMapValues);
  const SceneMemory memory{left.data(), right.data(), map.data(), arena.data(), arena.size()};
  uint64_t frame = 0, rows = 0;
  REQUIRE_EQ(hash_scene_frame(config, memory, &frame), BSM_OK);
  REQUIRE_EQ(hash_scene_rows(config, memory, &rows), BSM_OK);
  CHECK_EQ(frame, golden_scene_hash(method));
  CHECK_EQ(rows, frame);
  return frame;
}

}  // namespace

TEST_CASE(scene_hashes) {
  std::string kernels;
  uint64_t local = 0, sgm = 0;
  for (const uint32_t isa_mask : isa_masks()) {
    const std::string isa = best_isa(isa_mask);
    if (kernels.rfind(isa, 0) == 0) continue;
    const Scope scope(isa);
    kernels = isa + (kernels.empty() ? "" : "+" + kernels);
    local = hash_of(BSM_METHOD_LOCAL, isa_mask);
    sgm = hash_of(BSM_METHOD_SGM, isa_mask);
  }
  std::printf("target: %s %016llx %016llx frame+rows\n", kernels.c_str(), static_cast<unsigned long long>(local),
              static_cast<unsigned long long>(sgm));
}
