// One row from input to winners.
#include "core/match.h"

#include "core/aggregate.h"
#include "core/border.h"
#include "core/confidence.h"
#include "core/config.h"
#include "core/consistency.h"
#include "core/refine.h"
#include "platform/compiler.h"

namespace bsm {
namespace {

template <class T>
void replicate_border(T* row, int32_t width, int32_t pad) {
  for (int32_t i = 1; i <= pad; ++i) {
    row[-i] = row[0];
    row[width - 1 + i] = row[width - 1];
  }
}

// The rows of the pattern's window around row y; those outside the image are replaced by the nearest inside.
template <class T>
void window_rows(const bsm_context& context, const Ring& ring, int32_t y, const T** rows) {
  const int32_t radius = context.pattern.radius;
  for (int32_t i = 0; i <= 2 * radius; ++i) {
    const int32_t row = y - radius + i;
    const int32_t last = context.height - 1;
    rows[i] = ring_row<const T>(context, ring, row < 0 ? 0 : row > last ? last : row);
  }
}

// Out of line, as the next: the argument structs leave the stack before the costs are counted.
BSM_NOINLINE void describe_row(const bsm_context& context, View view, int32_t y, uint8_t* job) {
  const JobPlan& plan = context.plan.job;
  const uint16_t** rows = job_buffer<const uint16_t*>(job, plan.window);
  window_rows(context, context.plan.luma[view], y, rows);
  DescriptorCompareArgs args{};
  args.rows = rows;
  args.width = context.config.width;
  args.pattern = context.pattern;
  args.out = job + plan.descriptor[view];
  args.scratch = job + plan.kernel;
  context.kernels.descriptor_compare(args);
}

BSM_NOINLINE void mask_row(const bsm_context& context, View view, int32_t y, uint8_t* job) {
  const Plan& plan = context.plan;
  const uint8_t** rows = job_buffer<const uint8_t*>(job, plan.job.window);
  window_rows(context, plan.lab[view], y, rows);
  MaskThresholdArgs args{};
  args.rows = rows;
  args.plane_stride = plan.plane_stride;
  args.planes = plan.planes;
  args.width = context.config.width;
  args.pattern = context.pattern;
  args.out = job + plan.job.mask[view];
  args.scratch = job + plan.job.kernel;
  context.kernels.mask_threshold(args);
}

void match_locally(const bsm_context& context, int32_t y, uint8_t* job) {
  const bsm_config& config = context.config;
  const JobPlan& plan = context.plan.job;
  const bool masked = config.stage != BSM_STAGE_COST;
  MatchHammingArgs args{};
  args.left = job + plan.descriptor[kLeft];
  args.right = job + plan.descriptor[kRight];
  args.left_mask = masked ? job + plan.mask[kLeft] : nullptr;
  args.right_mask = masked ? job + plan.mask[kRight] : nullptr;
  args.width = config.width;
  args.bits = config.bits;
  args.min_disparity = config.min_disparity;
  args.num_disparities = config.num_disparities;
  args.left_level = ring_row<uint16_t>(context, context.plan.winner[kLeft], y);
  args.right_level = ring_row<uint16_t>(context, context.plan.winner[kRight], y);
  args.scratch = job + plan.kernel;
  context.kernels.match_hamming(args);
}

}  // namespace

void enter_row(const bsm_context& context, const RowSource& source, int32_t y) {
  const Plan& plan = context.plan;
  for (int32_t view = 0; view < kViews; ++view) {
    const bsm_image& image = source.image[view];
    ColorLabArgs args{};
    args.source = static_cast<const uint8_t*>(image.plane[0]) + (y - source.first_row) * image.stride[0];
    if (has_chroma_plane(context.config.format)) {
      args.chroma = static_cast<const uint8_t*>(image.plane[1]) + (y - source.first_row) / 2 * image.stride[1];
    }
    args.format = context.config.format;
    args.width = context.config.width;
    args.luma = ring_row<uint16_t>(context, plan.luma[view], y);
    args.lab = plan.planes == 0 ? nullptr : ring_row<uint8_t>(context, plan.lab[view], y);
    args.plane_stride = plan.plane_stride;
    args.planes = plan.planes;
    context.kernels.color_lab(args);
    replicate_border(args.luma, args.width, plan.pattern_radius);
    for (int32_t plane = 0; plane < plan.planes; ++plane) {
      replicate_border(args.lab + plane * args.plane_stride, args.width, plan.pattern_radius);
    }
  }
}

void match_row(const bsm_context& context, int32_t y, uint8_t* job) {
  const bool right_mask = !uses_sgm(context) || context.config.right_costs == BSM_RIGHT_COSTS_OWN;
  for (int32_t i = 0; i < kViews; ++i) {
    const View view = static_cast<View>(i);
    describe_row(context, view, y, job);
    if (context.plan.planes != 0 && (view == kLeft || right_mask)) mask_row(context, view, y, job);
  }
  if (uses_sgm(context)) {
    aggregate_along_row(context, y, job);
  } else {
    match_locally(context, y, job);
  }
}

void check_row(const bsm_context& context, int32_t y, uint8_t* job) {
  const bsm_config& config = context.config;
  const Plan& plan = context.plan;
  if (uses_sgm(context) && config.right_costs == BSM_RIGHT_COSTS_LEFT) pick_right_winners(context, y, job);
  if (kHasConfidence && plan.margin.rows != 0) measure_margins(context, y);
  const Winners winners{
      {ring_row<const uint16_t>(context, plan.winner[kLeft], y), ring_row<const uint16_t>(context, plan.winner[kRight], y)},
      config.width,
      config.min_disparity};
  for (int32_t i = 0; i < views_kept(context); ++i) {
    const View view = static_cast<View>(i);
    const bool filtered = plan.speckle_radius != 0;
    uint16_t* out = ring_row<uint16_t>(context, filtered ? plan.checked[view] : plan.level[view], y);
    if (config.stage >= BSM_STAGE_CHECKED) {
      check_levels(winners, view, config.lr_tolerance, out);
    } else {
      copy_levels(winners, view, out);
    }
    if (kHasRefinement && plan.border_radius != 0 && !filtered) fit_row(context, view, y);
  }
}

}  // namespace bsm
