// freestanding.cpp - a program without C library, start-up files and compiler's helpers, for Linux on x86-64 and AArch64:
// the library computes the golden hashes in it. Exit code 0: both methods did, of the frame and row by row, with every tier
// of kernels. proofs.sh builds it.
#include "scene_hashes.h"

#if defined(__x86_64__)
asm(".globl _start\n_start: xor %ebp, %ebp\n and $-16, %rsp\n call run_freestanding\n"
    " mov %eax, %edi\n mov $60, %eax\n syscall");
#elif defined(__aarch64__)
asm(".globl _start\n_start: bl run_freestanding\n mov w8, #93\n svc #0");
// What the library asks the C library on ARM Linux. Nothing is known here of the processor: scalar kernels.
extern "C" unsigned long getauxval(unsigned long) {
  return 0;
}
#else
#error "there is no entry point for this processor"
#endif

namespace {

using namespace bsm::test;

alignas(64) uint8_t left[kSceneBytes], right[kSceneBytes], arena[1 << 21];
int16_t map[kSceneMapValues];

bool gives_golden_hash(bsm_method method, uint32_t isa_mask) {
  bsm_config config = scene_config(method);
  config.isa_mask = isa_mask;
  const SceneMemory memory{left, right, map, arena, sizeof(arena)};
  uint64_t frame = 0, rows = 0;
  return hash_scene_frame(config, memory, &frame) == BSM_OK && frame == golden_scene_hash(method) &&
         hash_scene_rows(config, memory, &rows) == BSM_OK && rows == golden_scene_hash(method);
}

}  // namespace

extern "C" int run_freestanding() {
  const uint32_t features = bsm_cpu_features();
  uint32_t isa_mask = 0;
  for (;;) {
    if (!gives_golden_hash(BSM_METHOD_LOCAL, isa_mask)) return 1;
    if (!gives_golden_hash(BSM_METHOD_SGM, isa_mask)) return 2;
    if ((features & ~isa_mask) == 0) return 0;
    // The next bit that the processor has.
    isa_mask |= (features & ~isa_mask) & (0u - (features & ~isa_mask));
  }
}
