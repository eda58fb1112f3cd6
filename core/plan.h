// The memory plan: every buffer of a context, as offsets into the caller's arena. The same plan answers how many bytes a
// configuration takes and carves them. Where the bytes exceed what size_t counts, the offsets mean nothing.
#ifndef BSM_CORE_PLAN_H
#define BSM_CORE_PLAN_H

#include <stddef.h>
#include <stdint.h>

#include "bsm/bsm.h"
#include "simd/build.h"
#include "simd/kernels.h"

namespace bsm {

constexpr uint32_t kArenaAlignment = 64;

enum View : int32_t { kLeft = 0, kRight = 1, kViews = 2 };

// Rows of each step that a job has in one move: the more, the less often costs of paths go from one job's cache to the next.
constexpr int32_t kBlockRows = 4;
constexpr int32_t kPieceRows = 2;  // rows that a job takes at a time
constexpr int32_t kPieces = kBlockRows / kPieceRows;

constexpr int32_t kMaxAcrossPaths = 3;  // from the row before: straight, from the left, from the right

// A ring of rows: row y lives at offset + (y % rows) * stride.
struct Ring {
  size_t offset;    // of x = 0 in slot 0, in bytes
  int32_t rows;     // 0: not needed
  uint32_t stride;  // bytes between slots
};

// What the jobs of a move tell each other.
struct JobState {
  uint32_t arrived;  // at the job's gate
  uint32_t begun;    // pieces of the job's rows that some job has taken
};

// Scratch of one job, as offsets from the job's own base.
struct JobPlan {
  size_t descriptor[kViews];
  size_t mask[kViews];
  size_t edge;    // sgm: colour edges of one row
  size_t row;     // one 16-bit value per pixel
  size_t window;  // pointers to the rows of a window: of the pattern, or levels and then CIELAB of the refinement
  size_t kernel;  // scratch of the kernel that runs
  size_t state;   // JobState
  size_t bytes;
};

// The steps of a row's way, in order. The passes of the weighted median are steps of their own: kSmooth + pass.
enum Step : int32_t {
  kEnter,
  kMatch,
  kAcross,
  kCheck,
  kDespeckle,
  kContinue,
  kVote,
  kFill,
  kSmooth,
  kRestore = kSmooth + BSM_MAX_SMOOTH_PASSES,
  kSmoothFraction,
  kWrite,
  kSteps
};

struct StepPlan {
  int16_t lag;  // rows behind the input: the sum of the radii up to this step
  int8_t turn;  // steps before this one that are done when it begins
  bool runs;
};

struct Plan {
  // Rows that each stage looks beyond the row it writes; 0 for stages that do not run.
  int32_t pattern_radius;
  int32_t speckle_radius;
  int32_t border_radius;
  int32_t vote_radius;
  int32_t smooth_radius;
  int32_t smooth_passes;
  int32_t median_radius;
  int32_t fraction_radius;  // of each of two passes
  int32_t delay;            // rows from input to output, one row at a time
  StepPlan step[kSteps];

  int32_t batch;  // rows that move together, and that each step lags more than the one before, where jobs run side by side
  int32_t across_paths;  // paths from the row before
  bool whole_frame;      // paths from below run over the whole frame before a row goes out
  int32_t planes;        // CIELAB planes kept: 0, 1 or 3
  int32_t plane_stride;  // bytes between the CIELAB planes of a row
  int32_t level_stride;  // costs between the pixels of a row

  Ring luma[kViews];
  Ring lab[kViews];
  Ring cost;                                     // sgm: the left view's costs
  Ring path[kMaxAcrossPaths];                    // sgm: L of the paths from the row before
  Ring sum;                                      // sgm: the left view's sums
  Ring winner[kViews];                           // winners, in 1/16 pixel
  Ring checked[kViews];                          // checked winners before the speckle filter
  Ring level[kViews];                            // winners, checked from BSM_STAGE_CHECKED on
  Ring fit[kViews];                              // one BorderFit a row
  Ring voted[kViews];                            // dense: holes filled
  Ring smoothed[BSM_MAX_SMOOTH_PASSES][kViews];  // after each pass of the weighted median
  Ring fraction[kViews];                         // sub-pixel levels before the two passes of smoothing
  Ring fraction_weight[kViews];
  Ring fraction_once[kViews];  // after the first pass
  Ring margin;                 // sgm with confidence: one byte a pixel
  size_t pairs;                // of the pattern, without pattern tables
  size_t order;                // PatternOrder, when the kernels read it
  size_t vote_steps;
  size_t smooth_steps;
  size_t jobs;  // max_jobs times JobPlan::bytes
  JobPlan job;
  uint64_t bytes;  // of the whole arena when it begins at a multiple of kArenaAlignment
};

// True when the pairs are those of sgm.
inline bool has_sgm_pattern(const bsm_config& config) {
  return !kHasLocal || (kHasSgm && config.method == BSM_METHOD_SGM);
}

// config is valid; context_bytes is reserved at offset 0.
void make_plan(const bsm_config& config, const Kernels& kernels, uint64_t context_bytes, Plan* plan);

// True when every row of the input is kept until the last has come: paths from below.
bool needs_whole_frame(const bsm_config& config);

// Rows from input to output, of a configuration that does not need the whole frame.
int32_t row_delay(const bsm_config& config);

}  // namespace bsm

#endif  // BSM_CORE_PLAN_H
