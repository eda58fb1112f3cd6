// Aggregation of one row.
#include "core/aggregate.h"

#include "platform/compiler.h"

namespace bsm {
namespace {

// Penalties are given for 4096 bits and scale with the costs.
uint16_t scaled_penalty(int32_t penalty, int32_t bits, int32_t divisor) {
  const int32_t scaled = (penalty * bits + BSM_MAX_BITS / 2) / BSM_MAX_BITS / divisor;
  return static_cast<uint16_t>(scaled < 1 ? 1 : scaled);
}

void set_penalties(const bsm_config& config, Penalties penalties[2]) {
  for (int32_t edge = 0; edge < 2; ++edge) {
    const int32_t divisor = edge == 0 ? 1 : config.edge_divisor;
    penalties[edge].p1 = scaled_penalty(config.p1, config.bits, divisor);
    penalties[edge].p2 = scaled_penalty(config.p2, config.bits, divisor);
  }
}

// Colour edges between `count` pixels and their predecessors, into the job's edge buffer.
void find_edges(const bsm_context& context, const uint8_t* lab, const uint8_t* previous, int32_t count, uint8_t* edge) {
  EdgeThresholdArgs args{};
  args.lab = lab;
  args.previous = previous;
  args.plane_stride = context.plan.plane_stride;
  args.planes = context.plan.planes;
  args.width = count;
  args.threshold = context.config.edge_threshold;
  args.edge = edge;
  context.kernels.edge_threshold(args);
}

// Masked costs of row y under one view's masks. Out of line, as the next: their argument structs need not share a stack.
BSM_NOINLINE void count_costs(const bsm_context& context, View view, uint16_t* cost, uint8_t* job) {
  const bsm_config& config = context.config;
  const JobPlan& plan = context.plan.job;
  CostHammingArgs args{};
  args.own = job + plan.descriptor[view];
  args.own_mask = job + plan.mask[view];
  args.other = job + plan.descriptor[view == kLeft ? kRight : kLeft];
  args.view = view;
  args.width = config.width;
  args.bits = config.bits;
  args.min_disparity = config.min_disparity;
  args.num_disparities = config.num_disparities;
  args.stride = context.plan.level_stride;
  args.cost = cost;
  args.scratch = job + plan.kernel;
  context.kernels.cost_hamming(args);
}

// The two paths along row y of one view.
BSM_NOINLINE void aggregate_view(const bsm_context& context, View view, int32_t y, const uint16_t* cost, uint16_t* sum,
                                 uint8_t* job) {
  const bsm_config& config = context.config;
  const uint8_t* lab = ring_row<const uint8_t>(context, context.plan.lab[view], y);
  uint8_t* edge = job + context.plan.job.edge;
  find_edges(context, lab, lab - 1, config.width, edge);
  AggregateAlongArgs args{};
  args.cost = cost;
  args.edge = edge;
  set_penalties(config, args.penalties);
  args.most_cost = config.bits;
  args.width = config.width;
  args.num_disparities = config.num_disparities;
  args.stride = context.plan.level_stride;
  args.sum = sum;
  args.scratch = job + context.plan.job.kernel;
  context.kernels.aggregate_along(args);
}

// Winners of `count` pixels from their sums.
void pick_least(const bsm_context& context, const uint16_t* sum, int32_t count, uint16_t* level, uint8_t* job) {
  WinnerSumsArgs args{};
  args.sum = sum;
  args.width = count;
  args.num_disparities = context.config.num_disparities;
  args.stride = context.plan.level_stride;
  args.subpixel = context.config.subpixel;
  args.level = level;
  args.scratch = job + context.plan.job.kernel;
  context.kernels.winner_sums(args);
}

}  // namespace

void aggregate_along_row(const bsm_context& context, int32_t y, uint8_t* job) {
  const Plan& plan = context.plan;
  uint16_t* cost = ring_row<uint16_t>(context, plan.cost, y);
  uint16_t* sum = ring_row<uint16_t>(context, plan.sum, y);
  if (context.config.right_costs == BSM_RIGHT_COSTS_OWN) {
    // The right view needs its costs in this row alone; the left view's take their place.
    count_costs(context, kRight, cost, job);
    aggregate_view(context, kRight, y, cost, sum, job);
    pick_least(context, sum, context.config.width, ring_row<uint16_t>(context, plan.winner[kRight], y), job);
  }
  count_costs(context, kLeft, cost, job);
  aggregate_view(context, kLeft, y, cost, sum, job);
}

int32_t path_dx(int32_t path) {
  return path == 0 ? 0 : path == 1 ? 1 : -1;
}

void aggregate_across_row(const bsm_context& context, int32_t path, int32_t step, int32_t y, int32_t begin, int32_t end,
                          uint8_t* job) {
  const bsm_config& config = context.config;
  const Plan& plan = context.plan;
  const int32_t before = y - step;
  const bool first = before < 0 || before >= context.height;
  AggregateAcrossArgs args{};
  args.cost = ring_row<const uint16_t>(context, plan.cost, y);
  args.dx = path_dx(path);
  if (!first) {
    args.previous = ring_row<const uint16_t>(context, plan.path[path], before);
    find_edges(context, ring_row<const uint8_t>(context, plan.lab[kLeft], y) + begin,
               ring_row<const uint8_t>(context, plan.lab[kLeft], before) + begin - args.dx, end - begin,
               job + plan.job.edge + begin);
  }
  args.edge = job + plan.job.edge;
  set_penalties(config, args.penalties);
  args.begin = begin;
  args.end = end;
  args.width = config.width;
  args.num_disparities = config.num_disparities;
  args.stride = plan.level_stride;
  args.current = ring_row<uint16_t>(context, plan.path[path], y);
  args.sum = ring_row<uint16_t>(context, plan.sum, y);
  args.scratch = job + plan.job.kernel;
  context.kernels.aggregate_across(args);
}

void pick_left_winners(const bsm_context& context, int32_t y, int32_t begin, int32_t end, uint8_t* job) {
  const uint16_t* sum =
      ring_row<const uint16_t>(context, context.plan.sum, y) + ptrdiff_t{begin} * context.plan.level_stride;
  pick_least(context, sum, end - begin, ring_row<uint16_t>(context, context.plan.winner[kLeft], y) + begin, job);
}

void pick_right_winners(const bsm_context& context, int32_t y, uint8_t* job) {
  const bsm_config& config = context.config;
  const uint16_t* sums = ring_row<const uint16_t>(context, context.plan.sum, y);
  uint16_t* right = ring_row<uint16_t>(context, context.plan.winner[kRight], y);
  uint16_t* least = job_buffer<uint16_t>(job, context.plan.job.row);
  for (int32_t x = 0; x < config.width; ++x) {
    right[x] = kNoLevel;
    least[x] = kNoCost;
  }
  for (int32_t x = 0; x < config.width; ++x) {
    const uint16_t* sum = sums + ptrdiff_t{x} * context.plan.level_stride;
    for (int32_t level = 0; level < config.num_disparities; ++level) {
      if (sum[level] == kNoCost) continue;
      const int32_t matched = x - config.min_disparity - level;
      if (sum[level] >= least[matched]) continue;
      least[matched] = sum[level];
      right[matched] = static_cast<uint16_t>(level << kLevelShift);
    }
  }
}

}  // namespace bsm
