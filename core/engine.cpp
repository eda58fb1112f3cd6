// The schedule. A row's way is the list of steps in core/plan.h; each step lags the one before by the rows that its window
// looks ahead. One job does one step after the other. Where several jobs run side by side, a step also lags by the rows of
// one move, so that no step needs what another does in the same move: the jobs meet once a move.
#include "core/engine.h"

#include "core/aggregate.h"
#include "core/confidence.h"
#include "core/refine.h"

namespace bsm {
namespace {

int32_t clamp(int32_t value, int32_t least, int32_t most) {
  return value < least ? least : value > most ? most : value;
}

uint8_t* job_base(const bsm_context& context, int32_t job) {
  return context.arena + context.plan.jobs + static_cast<size_t>(job) * context.plan.job.bytes;
}

struct Rows {
  int32_t begin, end;
};

// Rows that a stage `lag` rows behind the input works on while the input moves from row `from` to row `to`.
Rows lagging(const bsm_context& context, int32_t from, int32_t to, int32_t lag) {
  return Rows{clamp(from - lag, 0, context.height), clamp(to - lag, 0, context.height)};
}

// The part of a job among those that run side by side, and its scratch.
struct Share {
  int32_t job, jobs;
  uint8_t* scratch;
};

// One move of the pipeline: its input goes from row `from` to row `to`, and the steps first..last follow.
struct Move {
  const RowSource& source;
  const RowSink& sink;
  int32_t from, to;
  Step first, last;
};

int16_t* map_row(const bsm_map& map, int32_t y) {
  return reinterpret_cast<int16_t*>(reinterpret_cast<uint8_t*>(map.data) + y * map.stride);
}

// One path from the row before over some rows: step 1 runs from rows.begin downwards, -1 from rows.end - 1 upwards. Each job
// owns a block of columns that moves along with the path, so that it only ever reads predecessors of its own or of rows that
// were complete before the jobs began. Where no path follows, the winners are picked while the sums are near.
void aggregate_across(const bsm_context& context, int32_t path, int32_t step, Rows rows, Share share) {
  const int32_t width = context.config.width;
  const int32_t dx = path_dx(path);
  const int32_t first = step > 0 ? rows.begin : rows.end - 1;
  const bool last = path + 1 == context.plan.across_paths && (step < 0) == context.plan.whole_frame;
  for (int32_t i = 0; i < rows.end - rows.begin; ++i) {
    const int32_t begin = share.job == 0 ? 0 : clamp(share.job * width / share.jobs + i * dx, 0, width);
    const int32_t end = share.job == share.jobs - 1 ? width : clamp((share.job + 1) * width / share.jobs + i * dx, 0, width);
    if (begin >= end) continue;
    const int32_t y = first + i * step;
    aggregate_across_row(context, path, step, y, begin, end, share.scratch);
    if (last) pick_left_winners(context, y, begin, end, share.scratch);
  }
}

void write_maps(const bsm_context& context, const RowSink& sink, int32_t y, uint8_t* job) {
  int16_t* disparity = map_row(sink.disparity, y);
  write_row(context, kLeft, y, disparity, job);
  if (sink.right_disparity.data != nullptr) write_row(context, kRight, y, map_row(sink.right_disparity, y), job);
  if (kHasConfidence && sink.confidence.data != nullptr) {
    confidence_row(context, y, disparity, sink.confidence.data + y * sink.confidence.stride);
  }
}

// Row y of a step that works on one view at a time: of the refinement.
void step_view(const bsm_context& context, Step step, View view, int32_t y, uint8_t* job) {
  if (!kHasRefinement) return;
  switch (step) {
    case kDespeckle:
      return despeckle_row(context, view, y);
    case kContinue:
      return continue_row(context, view, y);
    case kVote:
      return vote_row(context, view, y, job);
    case kRestore:
      if (uses_fractions(context)) restore_row(context, view, y);
      return;
    case kSmoothFraction:
      if (uses_fractions(context)) smooth_fraction_row(context, view, y, job);
      return;
    default:
      return smooth_row(context, view, step - kSmooth, y, job);
  }
}

// Row y of a step, in all views kept. No row of a step needs another of the same step.
void step_row(const bsm_context& context, const Move& move, Step step, int32_t y, uint8_t* job) {
  switch (step) {
    case kEnter:
      return enter_row(context, move.source, y);
    case kMatch:
      return match_row(context, y, job);
    case kCheck:
      return check_row(context, y, job);
    case kWrite:
      return write_maps(context, move.sink, y, job);
    default:
      for (int32_t view = 0; view < views_kept(context); ++view) step_view(context, step, static_cast<View>(view), y, job);
  }
}

// A job's share of a move.
void do_share(const bsm_context& context, const Move& move, Share share) {
  const int32_t skew = share.jobs == 1 ? 0 : context.plan.skew;
  for (int32_t i = move.first; i <= move.last; ++i) {
    const StepPlan& plan = context.plan.step[i];
    if (!plan.runs) continue;
    const Step step = static_cast<Step>(i);
    const Rows rows = lagging(context, move.from, move.to, plan.lag + plan.turn * skew);
    if (kHasSgm && kAcross <= step && step < kAcross + kMaxAcrossPaths) {
      aggregate_across(context, step - kAcross, 1, rows, share);
    } else if (kHasRefinement && step == kFill) {  // row after row
      if (share.job != 0) continue;
      for (int32_t y = rows.begin; y < rows.end; ++y) {
        for (int32_t view = 0; view < views_kept(context); ++view) fill_row(context, static_cast<View>(view), y);
      }
    } else {
      for (int32_t y = rows.begin + share.job; y < rows.end; y += share.jobs) {
        step_row(context, move, step, y, share.scratch);
      }
    }
  }
}

// Calls function(share) once for each job, side by side where the caller can.
template <class Function>
struct Jobs {
  const bsm_context& context;
  const Function& function;
  int32_t count;

  static void run(void* pointer, int32_t job) {
    const Jobs& jobs = *static_cast<const Jobs*>(pointer);
    jobs.function(Share{job, jobs.count, job_base(jobs.context, job)});
  }
};

template <class Function>
void for_jobs(const bsm_context& context, const Parallel& parallel, const Function& function) {
  Jobs<Function> jobs{context, function, parallel.parallel_for == nullptr ? 1 : context.config.max_jobs};
  if (jobs.count == 1) {
    Jobs<Function>::run(&jobs, 0);
  } else {
    parallel.parallel_for(parallel.user, jobs.count, Jobs<Function>::run, &jobs);
  }
}

// Moves every row of the frame through the steps first..last, both of which run.
void move_frame(const bsm_context& context, const Frame& frame, Step first, Step last) {
  const Plan& plan = context.plan;
  const int32_t skew = frame.parallel.parallel_for == nullptr ? 0 : plan.skew;
  const int32_t begin = plan.step[first].lag + plan.step[first].turn * skew;
  const int32_t end = context.height + plan.step[last].lag + plan.step[last].turn * skew;
  for (int32_t from = begin; from < end; from += plan.batch) {
    const Move move{frame.source, frame.sink, from, from + plan.batch, first, last};
    for_jobs(context, frame.parallel, [&](Share share) { do_share(context, move, share); });
  }
}

// The paths from below, over the whole frame.
void aggregate_upwards(const bsm_context& context, const Parallel& parallel) {
  for (int32_t end = context.height; end > 0; end -= context.plan.batch) {
    const Rows rows{clamp(end - context.plan.batch, 0, context.height), end};
    for (int32_t path = 0; path < context.plan.across_paths; ++path) {
      for_jobs(context, parallel, [&](Share share) { aggregate_across(context, path, -1, rows, share); });
    }
  }
}

constexpr RowSource kNoSource{};
constexpr RowSink kNoSink{};

}  // namespace

void engine_process(const bsm_context& context, const Frame& frame) {
  if (context.plan.whole_frame) {
    move_frame(context, frame, kEnter, static_cast<Step>(kCheck - 1));
    aggregate_upwards(context, frame.parallel);
  }
  move_frame(context, frame, context.plan.whole_frame ? kCheck : kEnter, kWrite);
}

void engine_reset(bsm_context* context) {
  context->height = context->config.height;
  context->entered = 0;
  context->finished = 0;
  context->ended = false;
}

void engine_enter(bsm_context* context, const RowSource* source) {
  const Move move{source == nullptr ? kNoSource : *source,
                  kNoSink,
                  context->entered,
                  context->entered + 1,
                  kEnter,
                  static_cast<Step>(kWrite - 1)};
  ++context->entered;
  do_share(*context, move, Share{0, 1, job_base(*context, 0)});
}

int32_t engine_rows_out(const bsm_context& context) {
  return clamp(context.entered - context.plan.delay, 0, context.height);
}

void engine_write(bsm_context* context, const RowSink& sink) {
  write_maps(*context, sink, context->finished, job_base(*context, 0));
  ++context->finished;
}

}  // namespace bsm
