// Computes the memory plan. Rows fit 32 bits; sums are 64-bit: the largest configuration stays below 2^48 bytes.
#include "core/plan.h"

#include "core/aggregate.h"
#include "core/border.h"
#include "core/confidence.h"
#include "core/pattern.h"
#include "core/speckle.h"
#include "platform/compiler.h"
#include "simd/build.h"
#include "simd/pattern_order.h"

namespace bsm {
namespace {

// multiple is a power of two, as the blocks of all kernels are.
template <class Unsigned>
Unsigned round_up(Unsigned value, uint32_t multiple) {
  return (value + multiple - 1) & ~Unsigned{multiple - 1};
}

// Hands out aligned pieces of a region one after the other.
class Carver {
 public:
  size_t take(uint64_t bytes) {
    const uint64_t offset = used();
    next_ = offset + bytes;
    return static_cast<size_t>(offset);
  }
  // A ring whose rows have `before` bytes in front of x = 0; without rows it is not needed.
  void take_ring(int32_t rows, uint32_t row_bytes, uint32_t before, Ring* ring) {
    if (rows == 0) return;
    ring->rows = rows;
    ring->stride = round_up(row_bytes, 8);
    ring->offset = take(uint64_t{static_cast<uint32_t>(rows)} * ring->stride) + before;
  }
  uint64_t used() const { return round_up(next_, kArenaAlignment); }

 private:
  uint64_t next_ = 0;
};

int32_t largest(int32_t a, int32_t b) {
  return a < b ? b : a;
}

bool is_sgm(const bsm_config& config) {
  return kHasSgm && config.method == BSM_METHOD_SGM && config.stage >= BSM_STAGE_AGGREGATED;
}

bool is_refined(const bsm_config& config) {
  return kHasRefinement && config.stage == BSM_STAGE_REFINED;
}

// Stages that run and their radii.
void plan_stages(const bsm_config& config, Plan* plan) {
  const bool refined = is_refined(config);
  plan->pattern_radius = has_sgm_pattern(config) ? kSgmRadius : config.sigma == 3 ? kNarrowRadius : kLocalRadius;
  plan->speckle_radius = refined && config.speckle != 0 ? kSpeckleRadius : 0;
  plan->border_radius = refined && config.border != 0 ? kBorderRadius : 0;
  plan->vote_radius = refined ? config.vote_radius : 0;
  plan->smooth_passes = refined ? config.smooth_passes : 0;
  plan->smooth_radius = plan->smooth_passes != 0 ? config.smooth_radius : 0;
  plan->median_radius = refined ? config.median : 0;
  plan->fraction_radius = refined && is_sgm(config) && config.subpixel != 0 ? kFractionRadius : 0;
  plan->across_paths = !is_sgm(config) ? 0 : config.paths == 8 ? kMaxAcrossPaths : config.paths - 2;
  plan->whole_frame = needs_whole_frame(config);
  const bool masked = config.stage != BSM_STAGE_COST;
  plan->planes = !masked ? 0 : config.format == BSM_FORMAT_GRAY8 ? 1 : 3;
}

// The steps that run, how far each is behind the input, and how many rows move at once.
void plan_steps(const bsm_config& config, Plan* plan) {
  const bool refined = is_refined(config);
  int32_t lag = 0;
  int8_t turn = 0;
  const auto add = [&](int32_t step, bool runs, int32_t radius) {
    if (!runs) return;
    lag += radius;
    plan->step[step] = StepPlan{static_cast<int16_t>(lag), turn++, true};
  };
  add(kEnter, true, 0);
  add(kMatch, true, plan->pattern_radius);
  plan->step[kAcross] = plan->step[kMatch];  // in the same move
  plan->step[kAcross].runs = plan->across_paths != 0;
  add(kCheck, true, 0);
  add(kDespeckle, plan->speckle_radius != 0, plan->speckle_radius);
  const int32_t checked = lag;
  add(kContinue, plan->border_radius != 0, plan->border_radius);
  add(kVote, refined, plan->vote_radius);
  add(kFill, refined, 0);
  for (int32_t pass = 0; pass < plan->smooth_passes; ++pass) add(kSmooth + pass, true, plan->smooth_radius);
  const bool fractions = plan->fraction_radius != 0;
  add(kRestore, fractions, plan->median_radius);
  add(kSmoothFraction, fractions, plan->fraction_radius);
  const int32_t written = lag + (fractions ? plan->fraction_radius : plan->median_radius);
  // The confidence of a row asks neighbours below it, whose winners must be known.
  const int32_t known = checked + (config.confidence != 0 ? kConfidenceRadius : 0);
  add(kWrite, true, largest(written, known) - lag);
  plan->delay = lag;
  plan->batch = config.max_jobs == 1 ? 1 : kBlockRows * config.max_jobs;
}

// Rows of a ring that `writer` fills and `reader` reads up to `reach` rows above the row it is at; 0 where one does not run.
int32_t ring_rows(const Plan& plan, int32_t writer, int32_t reader, int32_t reach) {
  const StepPlan& first = plan.step[writer];
  const StepPlan& last = plan.step[reader];
  if (!first.runs || !last.runs) return 0;
  const int32_t skew = plan.batch == 1 ? 0 : plan.batch;
  return plan.batch + last.lag - first.lag + (last.turn - first.turn) * skew + reach;
}

// Bytes of `values` 16-bit values.
uint32_t bytes_of(uint32_t values) {
  return values * static_cast<uint32_t>(sizeof(uint16_t));
}

JobPlan plan_job(const bsm_config& config, const Kernels& kernels, const Plan& plan, uint32_t width) {
  const uint32_t descriptors = width * static_cast<uint32_t>(config.bits / 8);
  const bool sgm = is_sgm(config);
  const bool right_own = sgm && config.right_costs == BSM_RIGHT_COSTS_OWN;
  const bool right_mask = plan.planes != 0 && (right_own || !sgm);
  const int32_t window_rows = 2 * largest(plan.pattern_radius, largest(plan.vote_radius, plan.smooth_radius)) + 1;
  const KernelShape shape{config.width, config.bits, plan.pattern_radius, plan.planes, config.num_disparities};
  JobPlan job{};
  Carver carver;
  for (int32_t view = 0; view < kViews; ++view) {
    job.descriptor[view] = carver.take(descriptors);
    job.mask[view] = carver.take(plan.planes == 0 || (view == kRight && !right_mask) ? 0 : descriptors);
  }
  job.edge = carver.take(sgm ? width : 0);
  job.row = carver.take(bytes_of(width));
  job.window = carver.take(static_cast<uint32_t>(2 * window_rows) * sizeof(void*));
  job.kernel = carver.take(kernel_scratch_bytes(kernels, shape, sgm));
  job.state = carver.take(sizeof(JobState));
  job.bytes = static_cast<size_t>(carver.used());
  return job;
}

}  // namespace

bool needs_whole_frame(const bsm_config& config) {
  return is_sgm(config) && config.paths == 8;
}

int32_t row_delay(const bsm_config& config) {
  Plan plan{};
  plan_stages(config, &plan);
  plan_steps(config, &plan);
  return plan.delay;
}

void make_plan(const bsm_config& config, const Kernels& kernels, uint64_t context_bytes, Plan* out) {
  Plan& plan = *out;
  BSM_MEMSET(&plan, 0, sizeof plan);
  plan_stages(config, &plan);
  plan_steps(config, &plan);
  const bool refined = is_refined(config);
  const bool sgm = is_sgm(config);
  const bool confidence = kHasConfidence && config.confidence != 0;
  const bool fractions = plan.fraction_radius != 0;

  // Each ring spans from the oldest row that its last reader needs to the newest written.
  const int32_t pattern = plan.pattern_radius;
  const int32_t border = plan.border_radius;
  const int32_t vote = plan.vote_radius;
  const int32_t smooth = plan.smooth_radius;
  const int32_t last_smooth = kSmooth + plan.smooth_passes - 1;
  const int32_t checker = plan.speckle_radius != 0 ? kDespeckle : kCheck;  // writes the checked levels
  const int32_t dense_reader = fractions ? kRestore : kWrite;
  const int32_t window_rows = ring_rows(plan, kEnter, kMatch, pattern);
  int32_t refine_lab_rows = largest(window_rows, ring_rows(plan, kEnter, kVote, vote));
  if (smooth != 0) refine_lab_rows = largest(refine_lab_rows, ring_rows(plan, kEnter, last_smooth, smooth));
  const int32_t edge_lab_rows = plan.across_paths == 0 ? 0 : ring_rows(plan, kEnter, kAcross, 1);
  const int32_t winner_rows = ring_rows(plan, kMatch, kCheck, 0);
  const int32_t confidence_rows = confidence ? ring_rows(plan, checker, kWrite, kConfidenceRadius) : 0;
  const int32_t level_reader = !refined ? kWrite : fractions ? kRestore : smooth != 0 ? last_smooth : kFill;
  const int32_t level_rows =
      largest(largest(ring_rows(plan, checker, kVote, vote), confidence_rows), ring_rows(plan, checker, level_reader, 0));
  const int32_t fit_rows = largest(ring_rows(plan, checker, kContinue, border), confidence_rows);
  const int32_t voted_rows =
      largest(ring_rows(plan, kVote, kFill, 1), smooth != 0 ? ring_rows(plan, kVote, kSmooth, smooth)
                                                            : ring_rows(plan, kVote, dense_reader, plan.median_radius));
  const int32_t all = plan.whole_frame ? config.height : 0;  // whole-frame plans keep every row between the two passes

  const uint32_t width = round_up(static_cast<uint32_t>(config.width), static_cast<uint32_t>(kernels.block[kPixels]));
  const uint32_t pad = static_cast<uint32_t>(pattern);
  const uint32_t padded = width + 2 * pad;
  const uint32_t level_bytes = bytes_of(width);
  plan.plane_stride = static_cast<int32_t>(padded);
  plan.level_stride = static_cast<int32_t>(
      round_up(static_cast<uint32_t>(config.num_disparities), static_cast<uint32_t>(kernels.block[kLevels])));

  Carver carver;
  carver.take(context_bytes);
  if (!kHasPatternTables) plan.pairs = carver.take(static_cast<uint32_t>(config.bits) * sizeof(PixelPair));
  if constexpr (kOrdersPatterns) plan.order = carver.take(kernels.ordered ? pattern_order_bytes(config.bits) : 0);
  const int32_t views = config.right_map != 0 ? kViews : kLeft + 1;  // whose maps are kept
  for (int32_t view = 0; view < kViews; ++view) {
    const int32_t lab_rows =
        largest(refined && view < views ? refine_lab_rows : window_rows, view == kLeft ? edge_lab_rows : 0);
    carver.take_ring(window_rows, bytes_of(padded), bytes_of(pad), &plan.luma[view]);
    if (plan.planes != 0) {
      carver.take_ring(largest(lab_rows, all), padded * static_cast<uint32_t>(plan.planes), pad, &plan.lab[view]);
    }
    carver.take_ring(largest(winner_rows, all), level_bytes, 0, &plan.winner[view]);
  }
  for (int32_t view = 0; view < views; ++view) {
    carver.take_ring(ring_rows(plan, kCheck, kDespeckle, plan.speckle_radius), level_bytes, 0, &plan.checked[view]);
    carver.take_ring(level_rows, level_bytes, 0, &plan.level[view]);
    if (border != 0) carver.take_ring(fit_rows, sizeof(BorderFit), 0, &plan.fit[view]);
    carver.take_ring(voted_rows, level_bytes, 0, &plan.voted[view]);
    const int32_t reach = plan.fraction_radius;
    carver.take_ring(ring_rows(plan, kRestore, kSmoothFraction, reach), level_bytes, 0, &plan.fraction[view]);
    carver.take_ring(ring_rows(plan, kRestore, kWrite, reach), width, 0, &plan.fraction_weight[view]);
    carver.take_ring(ring_rows(plan, kSmoothFraction, kWrite, reach), level_bytes, 0, &plan.fraction_once[view]);
    for (int32_t pass = 0; pass < plan.smooth_passes; ++pass) {
      const bool last = kSmooth + pass == last_smooth;
      const int32_t rows =
          ring_rows(plan, kSmooth + pass, last ? dense_reader : kSmooth + pass + 1, last ? plan.median_radius : smooth);
      carver.take_ring(rows, level_bytes, 0, &plan.smoothed[pass][view]);
    }
  }
  if (sgm) {
    const uint32_t costs = bytes_of(static_cast<uint32_t>(config.width) * static_cast<uint32_t>(plan.level_stride));
    // The left view's winners are picked where the last path is added.
    const int32_t sum_reader = confidence || config.right_costs == BSM_RIGHT_COSTS_LEFT ? kCheck : kAcross;
    if (confidence) carver.take_ring(ring_rows(plan, kCheck, kWrite, 0), width, 0, &plan.margin);
    carver.take_ring(largest(ring_rows(plan, kMatch, kAcross, 0), all), costs, 0, &plan.cost);
    carver.take_ring(largest(ring_rows(plan, kMatch, sum_reader, 0), all), costs, 0, &plan.sum);
    // A path's costs are updated in place where no other job may still read those of the row before: upwards, jobs do
    // columns.
    for (int32_t path = 0; path < plan.across_paths; ++path) {
      const bool in_place = !plan.whole_frame || plan.batch == 1 || path_dx(path) == 0;
      carver.take_ring(in_place ? 1 : plan.batch + 1, costs, 0, &plan.path[path]);
    }
  }
  const uint32_t vote_side = refined ? static_cast<uint32_t>(vote + 1) : 0;
  plan.vote_steps = carver.take(bytes_of(vote_side * vote_side));
  const uint32_t smooth_side = smooth != 0 ? static_cast<uint32_t>(smooth + 1) : 0;
  plan.smooth_steps = carver.take(smooth_side * smooth_side);
  plan.job = plan_job(config, kernels, plan, width);
  plan.jobs = carver.take(uint64_t{plan.job.bytes} * static_cast<uint32_t>(config.max_jobs));
  plan.bytes = carver.used();
}

}  // namespace bsm
