// Selection: from CPU features to the table of kernels, by the list in simd/kernels.def.
#include "simd/kernels.h"

#include "simd/build.h"

namespace bsm {
namespace {

// Position of each stage in the tables of Kernels.
enum StageIndex : int32_t {
#define BSM_STAGE(stage, operation, Args, axis) stage##_##operation##_index,
#include "simd/stages.def"
#undef BSM_STAGE
  kStageCount
};
static_assert(int32_t{kStageCount} == int32_t{BSM_KERNEL_COUNT}, "bsm_kernel names every stage of simd/stages.def");

// Whether one of the methods has a stage.
constexpr bool is_run(StageIndex stage, bool local, bool sgm) {
  switch (stage) {
    case match_hamming_index:
      return local;
    case cost_hamming_index:
    case edge_threshold_index:
    case aggregate_along_index:
    case aggregate_across_index:
    case winner_sums_index:
    case fraction_smooth_index:
      return sgm;
    default:
      return true;
  }
}

// Stages that the build leaves out have no kernels.
constexpr bool is_built(StageIndex stage) {
  const bool refines = stage == fraction_smooth_index || stage == vote_weigh_index || stage == median_weighted_index;
  return is_run(stage, kHasLocal, kHasSgm) && (!refines || kHasRefinement);
}

// Kernels that read Pattern::order: those of x86 and of WebAssembly, and the masks of NEON and SVE.
constexpr bool reads_order(StageIndex stage, uint32_t required) {
  if (stage == mask_threshold_index && (required & kIsaNeon) == kIsaNeon) return true;
  return (stage == descriptor_compare_index || stage == mask_threshold_index) &&
         ((required & kIsaSse42) == kIsaSse42 || required == kIsaSimd128);
}

// True for a scalar kernel whose stage has another one, in a build that leaves it out.
constexpr bool is_left_out(StageIndex stage, uint32_t required) {
  if (kHasScalar || required != kIsaScalar) return false;
  bool replaced = false;
#define BSM_KERNEL(other_stage, operation, isa, other_required, stage_block) \
  replaced = replaced || (stage == other_stage##_##operation##_index && (other_required) != kIsaScalar);
#include "simd/kernels.def"
#undef BSM_KERNEL
  return replaced;
}

}  // namespace

Kernels select_kernels(uint32_t features) {
  // A frame takes fewer instructions with NEON then: 519 M for teddy with the preset fast, 1354 M with 128 bits of SVE, 801
  // M with 256, 533 M with 512. A mask that leaves this bit out chooses SVE all the same.
  if ((features & kCpuSveShort) != 0) features &= ~uint32_t{kCpuSve};
  Kernels kernels{};
  int32_t blocks[kStageCount] = {};
#define BSM_KERNEL(stage, operation, isa, required, stage_block)                                      \
  if (is_built(stage##_##operation##_index) && !is_left_out(stage##_##operation##_index, required) && \
      ((required) & ~features) == 0) {                                                                \
    kernels.stage##_##operation = stage##_##operation##_##isa;                                        \
    kernels.name[stage##_##operation##_index] = kHasText ? #stage "_" #operation "_" #isa : nullptr;  \
    kernels.scratch[stage##_##operation##_index] = stage##_##operation##_##isa##_scratch;             \
    blocks[stage##_##operation##_index] = (stage_block);                                              \
    kernels.ordered = kernels.ordered || reads_order(stage##_##operation##_index, (required));        \
  }
#include "simd/kernels.def"
#undef BSM_KERNEL
  for (int32_t& block : kernels.block) block = 1;
#define BSM_STAGE(stage, operation, Args, axis)                                                                         \
  kernels.block[axis] = kernels.block[axis] < blocks[stage##_##operation##_index] ? blocks[stage##_##operation##_index] \
                                                                                  : kernels.block[axis];
#include "simd/stages.def"
#undef BSM_STAGE
  return kernels;
}

bool is_complete(const Kernels& kernels) {
  return kHasScalar || kernels.descriptor_compare != nullptr;
}

uint64_t kernel_scratch_bytes(const Kernels& kernels, const KernelShape& shape, bool sgm) {
  uint64_t most = 0;
  for (int32_t stage = 0; stage < kStageCount; ++stage) {
    kernel_scratch_fn* scratch = kernels.scratch[stage];
    if (scratch == nullptr || !is_run(static_cast<StageIndex>(stage), !sgm, sgm)) continue;
    const uint64_t bytes = scratch(shape);
    most = most < bytes ? bytes : most;
  }
  return most;
}

}  // namespace bsm
