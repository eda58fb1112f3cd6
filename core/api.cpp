// The public calls: every argument is checked here, then the row engine does the work.
#include "bsm/bsm.h"
#include "core/config.h"
#include "core/context.h"
#include "core/engine.h"
#include "core/pattern.h"
#include "core/refine.h"
#include "core/weights.h"
#include "platform/compiler.h"
#include "platform/cpu.h"
#include "simd/pattern_order.h"

namespace bsm {
namespace {

bsm_status check_context(const bsm_context* context) {
  if (context == nullptr) return BSM_ERROR_NULL;
  return context->self == context ? BSM_OK : BSM_ERROR_CONTEXT;
}

// True when rows of `row_bytes` bytes would overlap.
bool too_short(ptrdiff_t stride, ptrdiff_t bytes, int32_t rows) {
  return rows > 1 && stride < bytes && stride > -bytes;
}

// True when every plane of the format is there.
bool has_planes(const void* const plane[2], int32_t format) {
  return plane[0] != nullptr && (plane[1] != nullptr || !has_chroma_plane(format));
}

bool too_short(const bsm_image& image, const bsm_config& config) {
  if (too_short(image.stride[0], row_bytes(config), config.height)) return true;
  return has_chroma_plane(config.format) && too_short(image.stride[1], chroma_row_bytes(config), (config.height + 1) / 2);
}

bool is_even(const void* pointer) {
  return (reinterpret_cast<uintptr_t>(pointer) & 1) == 0;
}

bsm_status check_map(const bsm_map& map, const bsm_config& config) {
  if (!is_even(map.data) || (map.stride & 1) != 0) return BSM_ERROR_ALIGNMENT;
  const ptrdiff_t bytes = ptrdiff_t{config.width} * static_cast<ptrdiff_t>(sizeof(int16_t));
  return too_short(map.stride, bytes, config.height) ? BSM_ERROR_STRIDE : BSM_OK;
}

bsm_status check_frame(const bsm_frame& frame, const bsm_config& config) {
  if (frame.disparity.data == nullptr) return BSM_ERROR_NULL;
  if (!has_planes(frame.left.plane, config.format) || !has_planes(frame.right.plane, config.format)) return BSM_ERROR_NULL;
  if (too_short(frame.left, config) || too_short(frame.right, config)) return BSM_ERROR_STRIDE;
  const bsm_status status = check_map(frame.disparity, config);
  if (status != BSM_OK) return status;
  if (frame.confidence.data != nullptr) {
    if (config.confidence == 0) return BSM_ERROR_NO_CONFIDENCE;
    if (too_short(frame.confidence.stride, config.width, config.height)) return BSM_ERROR_STRIDE;
  }
  if (frame.right_disparity.data == nullptr) return BSM_OK;
  if (config.right_map == 0) return BSM_ERROR_NO_RIGHT_MAP;
  return check_map(frame.right_disparity, config);
}

// Bytes for an arena of any alignment. Out of line: the plan is large, and callers go on to run the library.
BSM_NOINLINE uint64_t arena_bytes(const bsm_config& config, const Kernels& kernels) {
  Plan plan;
  make_plan(config, kernels, sizeof(bsm_context), &plan);
  return plan.bytes + kArenaAlignment - 1;
}

Pattern pattern_of(const bsm_context& context) {
  PixelPair* pairs = reinterpret_cast<PixelPair*>(context.arena + context.plan.pairs);
  const bsm_config& config = context.config;
  Pattern pattern = has_sgm_pattern(config) ? sgm_pattern(config.bits, pairs)
                    : config.sigma == 3     ? narrow_pattern(config.bits, pairs)
                                            : local_pattern(config.bits, pairs);
  if constexpr (kOrdersPatterns) {
    if (context.kernels.ordered) pattern.order = make_pattern_order(pattern, context.arena + context.plan.order);
  }
  return pattern;
}

// Exponents of the refinement's distances, which depend on the configuration alone.
void make_distance_steps(bsm_context* context) {
  const Plan& plan = context->plan;
  uint16_t* vote = reinterpret_cast<uint16_t*>(context->arena + plan.vote_steps);
  for (int32_t dy = 0; plan.vote_radius != 0 && dy <= plan.vote_radius; ++dy) {
    for (int32_t dx = 0; dx <= plan.vote_radius; ++dx) *vote++ = vote_distance_steps(dx, dy, context->config.vote_distance);
  }
  uint8_t* smooth = context->arena + plan.smooth_steps;
  for (int32_t dy = 0; plan.smooth_radius != 0 && dy <= plan.smooth_radius; ++dy) {
    for (int32_t dx = 0; dx <= plan.smooth_radius; ++dx) {
      *smooth++ = smooth_distance_steps(dx, dy, context->config.smooth_distance);
    }
  }
}

// Out of line as well: so are the kernels.
BSM_NOINLINE bsm_status plan_bytes(const bsm_config* config, uint32_t features, size_t* bytes) {
  const bsm_status status = validate_config(config);
  if (status != BSM_OK) return status;
  if (bytes == nullptr) return BSM_ERROR_NULL;
  const Kernels kernels = select_kernels(features & config->isa_mask);
  if (!is_complete(kernels)) return BSM_ERROR_ISA;
  const uint64_t needed = arena_bytes(*config, kernels);
  if (needed > SIZE_MAX) return BSM_ERROR_MEMORY_SIZE;
  *bytes = static_cast<size_t>(needed);
  return BSM_OK;
}

}  // namespace
}  // namespace bsm

using namespace bsm;

extern "C" bsm_status bsm_memory_required_for(const bsm_config* config, uint32_t features, size_t* bytes) {
  return plan_bytes(config, features, bytes);
}

extern "C" bsm_status bsm_memory_required(const bsm_config* config, size_t* bytes) {
  return plan_bytes(config, cpu_features(), bytes);
}

extern "C" bsm_status bsm_row_delay(const bsm_config* config, int32_t* rows) {
  const bsm_status status = validate_config(config);
  if (status != BSM_OK) return status;
  if (rows == nullptr) return BSM_ERROR_NULL;
  if (needs_whole_frame(*config)) return BSM_ERROR_ROW_MODE;
  *rows = row_delay(*config);
  return BSM_OK;
}

extern "C" bsm_status bsm_open(const bsm_config* config, void* arena, size_t bytes, bsm_context** context) {
  size_t needed = 0;
  const bsm_status status = plan_bytes(config, cpu_features(), &needed);
  if (status != BSM_OK) return status;
  if (arena == nullptr || context == nullptr) return BSM_ERROR_NULL;
  if (bytes < needed) return BSM_ERROR_ARENA;

  uint8_t* base = static_cast<uint8_t*>(arena);
  base += (kArenaAlignment - (reinterpret_cast<uintptr_t>(base) & (kArenaAlignment - 1))) & (kArenaAlignment - 1);
  bsm_context* opened = reinterpret_cast<bsm_context*>(base);
  opened->self = opened;
  opened->arena = base;
  opened->config = *config;
  opened->kernels = select_kernels(cpu_features() & config->isa_mask);
  make_plan(*config, opened->kernels, sizeof(bsm_context), &opened->plan);
  opened->pattern = pattern_of(*opened);
  make_distance_steps(opened);
  engine_reset(opened);
  *context = opened;
  return BSM_OK;
}

extern "C" bsm_status bsm_process(bsm_context* context, const bsm_frame* frame) {
  if (check_context(context) != BSM_OK) return check_context(context);
  if (frame == nullptr) return BSM_ERROR_NULL;
  const bsm_status status = check_frame(*frame, context->config);
  if (status != BSM_OK) return status;
  if (context->entered != 0 && context->finished < context->height) return BSM_ERROR_STREAM_OPEN;

  engine_reset(context);
  engine_process(*context, Frame{RowSource{{frame->left, frame->right}, 0},
                                 RowSink{frame->disparity, frame->right_disparity, frame->confidence},
                                 Parallel{frame->parallel_for, frame->parallel_user}});
  engine_reset(context);
  return BSM_OK;
}

extern "C" bsm_status bsm_push_row(bsm_context* context, const bsm_row* left, const bsm_row* right) {
  if (check_context(context) != BSM_OK) return check_context(context);
  if (left == nullptr || right == nullptr) return BSM_ERROR_NULL;
  const int32_t format = context->config.format;
  if (!has_planes(left->plane, format) || !has_planes(right->plane, format)) return BSM_ERROR_NULL;
  if (context->plan.whole_frame) return BSM_ERROR_ROW_MODE;
  if (context->ended) return BSM_ERROR_ROW_COUNT;
  if (context->finished < engine_rows_out(*context)) return BSM_ERROR_PULL_FIRST;
  RowSource source{};
  for (int32_t plane = 0; plane < 2; ++plane) {
    source.image[kLeft].plane[plane] = left->plane[plane];
    source.image[kRight].plane[plane] = right->plane[plane];
  }
  source.first_row = context->entered;
  engine_enter(context, &source);
  context->ended = context->entered == context->height;
  return BSM_OK;
}

extern "C" bsm_status bsm_pull_row(bsm_context* context, int16_t* disparity, int16_t* right_disparity, uint8_t* confidence) {
  if (check_context(context) != BSM_OK) return check_context(context);
  if (disparity == nullptr) return BSM_ERROR_NULL;
  if (!is_even(disparity) || !is_even(right_disparity)) return BSM_ERROR_ALIGNMENT;
  if (right_disparity != nullptr && context->config.right_map == 0) return BSM_ERROR_NO_RIGHT_MAP;
  if (confidence != nullptr && context->config.confidence == 0) return BSM_ERROR_NO_CONFIDENCE;
  if (context->plan.whole_frame) return BSM_ERROR_ROW_MODE;
  if (context->ended && context->finished == context->height) return BSM_END;
  while (context->ended && context->finished == engine_rows_out(*context)) engine_enter(context, nullptr);
  if (context->finished == engine_rows_out(*context)) return BSM_NEED_ROWS;
  const RowSink row{{disparity, 0}, {right_disparity, 0}, {confidence, 0}};  // no strides
  engine_write(context, row);
  return BSM_OK;
}

extern "C" bsm_status bsm_finish(bsm_context* context) {
  if (check_context(context) != BSM_OK) return check_context(context);
  if (context->plan.whole_frame) return BSM_ERROR_ROW_MODE;
  if (!context->ended) {
    context->height = context->entered;
    context->ended = true;
  }
  return BSM_OK;
}

extern "C" bsm_status bsm_reset(bsm_context* context) {
  if (check_context(context) != BSM_OK) return check_context(context);
  engine_reset(context);
  return BSM_OK;
}

extern "C" const char* bsm_kernel_name(const bsm_context* context, bsm_kernel kernel) {
  const int32_t index = static_cast<int32_t>(kernel);
  if (check_context(context) != BSM_OK || index < 0 || index >= BSM_KERNEL_COUNT) return nullptr;
  return context->kernels.name[index];
}

extern "C" uint32_t bsm_cpu_features(void) {
  return cpu_features();
}

extern "C" const char* bsm_cpu_feature_name(int32_t bit) {
  return kHasText ? cpu_feature_name(bit) : nullptr;
}
