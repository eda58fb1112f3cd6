// Refinement of one row.
#include "core/refine.h"

#include "core/border.h"
#include "core/holes.h"
#include "core/median.h"
#include "core/speckle.h"
#include "core/weights.h"
#include "platform/compiler.h"

namespace bsm {
namespace {

// The row of a view seen from the border at which the other view's image ends: left for a left view whose disparities are
// mostly positive, mirrored for the right view and for negative ranges.
bool border_at_left(const bsm_config& config, View view) {
  const bool positive = 2 * config.min_disparity + config.num_disparities > 0;
  return positive == (view == kLeft);
}

BorderRow border_row(const bsm_context& context, View view, int32_t y) {
  const bsm_config& config = context.config;
  const bool at_left = border_at_left(config, view);
  uint16_t* row = ring_row<uint16_t>(context, context.plan.level[view], y);
  return BorderRow{at_left ? row : row + config.width - 1, at_left ? 1 : -1, config.width};
}

// Pixels from the border within which its surface begins: the largest disparity searched, and a little.
int32_t border_reach(const bsm_config& config) {
  const int32_t largest = config.min_disparity + config.num_disparities - 1;
  return (largest > -config.min_disparity ? largest : -config.min_disparity) + kBorderRadius;
}

// Rows of levels and CIELAB around row y, in the job's table of pointers.
struct Window {
  const uint16_t** levels;
  const uint8_t** lab;
};

Window window_around(const bsm_context& context, View view, const Ring& ring, int32_t y, int32_t radius, uint8_t* job) {
  const uint16_t** levels = job_buffer<const uint16_t*>(job, context.plan.job.window);
  const Window window{levels, reinterpret_cast<const uint8_t**>(levels + 2 * radius + 1)};
  rows_inside(context, ring, y, radius, window.levels);
  rows_inside(context, context.plan.lab[view], y, radius, window.lab);
  return window;
}

constexpr uint32_t kOwnBonus = 512;  // two full weights of the weighted median
// A level that the refinement has moved speaks for its neighbourhood and weighs more than one measured at a single pixel.
constexpr int32_t kKeptFraction = 12;  // sixteenths by which a sub-pixel level may differ from the final whole one
// Sums lean to whole levels, whose paths pay no penalty: a mean of fractions that is this many sixteenths from the nearest
// whole level stands for so many. A single sixteenth may be noise.
constexpr uint8_t kSpread[] = {0, 1, 4, 5, 6, 7, 8, 8, 8};

// Row y of the dense map of whole levels, after the optional 3x3 median.
void take_dense_row(const bsm_context& context, View view, int32_t y, uint16_t* out) {
  const Plan& plan = context.plan;
  const int32_t width = context.config.width;
  const Ring& ring = plan.smooth_passes != 0 ? plan.smoothed[plan.smooth_passes - 1][view] : plan.voted[view];
  const uint16_t* center = ring_row<const uint16_t>(context, ring, y);
  if (plan.median_radius == 0) {
    BSM_MEMCPY(out, center, static_cast<size_t>(width) * sizeof *out);
    return;
  }
  const uint16_t* const rows[3] = {y > 0 ? ring_row<const uint16_t>(context, ring, y - 1) : center, center,
                                   y + 1 < context.height ? ring_row<const uint16_t>(context, ring, y + 1) : center};
  median_3x3(rows, width, out);
}

// One pass of smoothing the fractions of row y of a ring.
void smooth_fractions(const bsm_context& context, View view, const Ring& ring, int32_t y, uint16_t* out, uint8_t* job) {
  const uint16_t* levels[2 * kFractionRadius + 1];
  const uint8_t* weights[2 * kFractionRadius + 1];
  rows_inside(context, ring, y, kFractionRadius, levels);
  rows_inside(context, context.plan.fraction_weight[view], y, kFractionRadius, weights);
  FractionSmoothArgs args{};
  args.levels = levels;
  args.weights = weights;
  args.width = context.config.width;
  args.out = out;
  args.scratch = job + context.plan.job.kernel;
  context.kernels.fraction_smooth(args);
}

// Moves fractions away from whole levels. Stays within the levels searched: none lies below the first or above the last.
void spread_fractions(int32_t width, uint16_t* levels) {
  for (int32_t x = 0; x < width; ++x) {
    const int32_t whole = whole_level(levels[x]) << kLevelShift;
    const int32_t fraction = levels[x] - whole;
    levels[x] = static_cast<uint16_t>(fraction < 0 ? whole - kSpread[-fraction] : whole + kSpread[fraction]);
  }
}

}  // namespace

void despeckle_row(const bsm_context& context, View view, int32_t y) {
  const Plan& plan = context.plan;
  const uint16_t* rows[2 * kSpeckleRadius + 1];
  rows_inside(context, plan.checked[view], y, kSpeckleRadius, rows);
  uint16_t* out = ring_row<uint16_t>(context, plan.level[view], y);
  remove_speckles(rows, context.config.width, context.config.speckle, out);
  if (plan.border_radius != 0) fit_row(context, view, y);
}

void fit_row(const bsm_context& context, View view, int32_t y) {
  *ring_row<BorderFit>(context, context.plan.fit[view], y) =
      fit_border(border_row(context, view, y), border_reach(context.config));
}

void continue_row(const bsm_context& context, View view, int32_t y) {
  const BorderFit* fits[2 * kBorderRadius + 1];
  rows_inside(context, context.plan.fit[view], y, kBorderRadius, fits);
  continue_border(border_row(context, view, y), fits, (context.config.num_disparities - 1) << kLevelShift);
}

Columns measured_columns(const bsm_context& context, View view, int32_t y) {
  const int32_t width = context.config.width;
  if (!kHasRefinement || context.plan.border_radius == 0) return Columns{0, width};
  const int32_t first = ring_row<const BorderFit>(context, context.plan.fit[view], y)->first;
  const int32_t filled = first < 0 ? 0 : first;
  return border_at_left(context.config, view) ? Columns{filled, width} : Columns{0, width - filled};
}

void vote_row(const bsm_context& context, View view, int32_t y, uint8_t* job) {
  const Plan& plan = context.plan;
  const bsm_config& config = context.config;
  const Window window = window_around(context, view, plan.level[view], y, plan.vote_radius, job);
  VoteWeighArgs args{};
  args.levels = window.levels;
  args.lab = window.lab;
  args.plane_stride = plan.plane_stride;
  args.planes = plan.planes;
  args.width = config.width;
  args.radius = plan.vote_radius;
  args.step = config.vote_step;
  args.num_disparities = config.num_disparities;
  if (config.vote_cap != 0) {
    uint16_t* cap = job_buffer<uint16_t>(job, plan.job.row);
    cap_occlusions(window.levels[plan.vote_radius], config.width, cap);
    args.cap = cap;
  }
  args.color_scale = vote_color_scale(config.vote_color);
  args.distance_steps = reinterpret_cast<const uint16_t*>(context.arena + plan.vote_steps);
  args.weights = kVoteWeights.weight;
  args.weights_count = VoteWeights::kCount;
  args.out = ring_row<uint16_t>(context, plan.voted[view], y);
  args.scratch = job + plan.job.kernel;
  context.kernels.vote_weigh(args);
}

void fill_row(const bsm_context& context, View view, int32_t y) {
  const Plan& plan = context.plan;
  const uint16_t* checked = ring_row<const uint16_t>(context, plan.level[view], y);
  const uint16_t* above = y > 0 ? ring_row<const uint16_t>(context, plan.voted[view], y - 1) : nullptr;
  fill_holes(checked, above, context.config.width, ring_row<uint16_t>(context, plan.voted[view], y));
}

void smooth_row(const bsm_context& context, View view, int32_t pass, int32_t y, uint8_t* job) {
  const Plan& plan = context.plan;
  const Ring& from = pass == 0 ? plan.voted[view] : plan.smoothed[pass - 1][view];
  const Window window = window_around(context, view, from, y, plan.smooth_radius, job);
  MedianWeightedArgs args{};
  args.levels = window.levels;
  args.lab = window.lab;
  args.plane_stride = plan.plane_stride;
  args.planes = plan.planes;
  args.width = context.config.width;
  args.radius = plan.smooth_radius;
  args.color_scale = smooth_color_scale(context.config.smooth_color);
  args.distance_steps = context.arena + plan.smooth_steps;
  args.weights = kSmoothWeights.weight;
  args.checked = ring_row<const uint16_t>(context, plan.level[view], y);
  args.own_bonus = kOwnBonus >> pass;
  args.out = ring_row<uint16_t>(context, plan.smoothed[pass][view], y);
  args.scratch = job + plan.job.kernel;
  context.kernels.median_weighted(args);
}

void restore_row(const bsm_context& context, View view, int32_t y) {
  const Plan& plan = context.plan;
  uint16_t* levels = ring_row<uint16_t>(context, plan.fraction[view], y);
  uint8_t* weights = ring_row<uint8_t>(context, plan.fraction_weight[view], y);
  const uint16_t* checked = ring_row<const uint16_t>(context, plan.level[view], y);
  take_dense_row(context, view, y, levels);
  for (int32_t x = 0; x < context.config.width; ++x) {
    const int32_t difference = checked[x] - levels[x];
    const bool kept = checked[x] < kOccluded && -kKeptFraction <= difference && difference <= kKeptFraction;
    weights[x] = kept ? 1 : kMaxFractionWeight;
    if (kept) levels[x] = checked[x];
  }
}

void smooth_fraction_row(const bsm_context& context, View view, int32_t y, uint8_t* job) {
  const Plan& plan = context.plan;
  uint16_t* once = ring_row<uint16_t>(context, plan.fraction_once[view], y);
  smooth_fractions(context, view, plan.fraction[view], y, once, job);
  spread_fractions(context.config.width, once);
}

void write_row(const bsm_context& context, View view, int32_t y, int16_t* out, uint8_t* job) {
  const Plan& plan = context.plan;
  const int32_t width = context.config.width;
  uint16_t* levels = reinterpret_cast<uint16_t*>(out);  // the unsigned twin of the output type
  if (uses_fractions(context)) {
    smooth_fractions(context, view, plan.fraction_once[view], y, levels, job);
  } else if (kHasRefinement && context.config.stage == BSM_STAGE_REFINED) {
    take_dense_row(context, view, y, levels);
  } else {
    BSM_MEMCPY(levels, ring_row<const uint16_t>(context, plan.level[view], y), static_cast<size_t>(width) * sizeof *levels);
  }
  const int32_t least = context.config.min_disparity * BSM_DISPARITY_SCALE;
  const int16_t invalid = bsm_invalid_disparity(&context.config);
  for (int32_t x = 0; x < width; ++x) {
    out[x] = levels[x] >= kOccluded ? invalid : static_cast<int16_t>(least + levels[x]);
  }
}

}  // namespace bsm
