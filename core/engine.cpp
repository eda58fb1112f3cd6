// The schedule. A row's way is the list of steps in core/plan.h; each step lags the one before by the rows that its window
// looks ahead. One job does one step after the other. Where several jobs run side by side, each has a block of rows of every
// step in a move, and a step also lags by the rows of one move, so that it needs nothing that another does in the same move:
// the jobs meet once a move. Between the costs and the paths from row to row, which do meet within a move, are gates.
#include "core/engine.h"

#include "core/aggregate.h"
#include "core/confidence.h"
#include "core/refine.h"
#include "platform/compiler.h"

namespace bsm {
namespace {

int32_t clamp(int32_t value, int32_t least, int32_t most) {
  return value < least ? least : value > most ? most : value;
}

uint8_t* job_base(const bsm_context& context, int32_t job) {
  return context.arena + context.plan.jobs + static_cast<size_t>(job) * context.plan.job.bytes;
}

JobState* state_of(const bsm_context& context, int32_t job) {
  return job_buffer<JobState>(job_base(context, job), context.plan.job.state);
}

// Rows that each step lags more than the one before.
int32_t skew_of(const bsm_context& context, int32_t jobs) {
  return jobs == 1 ? 0 : context.plan.batch;
}

// Adds one and gives the count before.
BSM_COUNTS uint32_t count_up(uint32_t* count) {
  return BSM_COUNT_UP(count);
}

struct Rows {
  int32_t begin, end;
};

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

// The paths from the row before over some rows. Where none follow from below, winners are picked while the sums are near.
void aggregate_downwards(const bsm_context& context, Rows rows, uint8_t* job) {
  const int32_t width = context.config.width;
  for (int32_t y = rows.begin; y < rows.end; ++y) {
    for (int32_t path = 0; path < context.plan.across_paths; ++path) {
      aggregate_across_row(context, path, 1, y, 0, width, job);
    }
    if (!context.plan.whole_frame) pick_left_winners(context, y, 0, width, job);
  }
}

// One path from the row below, from rows.end - 1 upwards. Each job owns a block of columns that moves along with the path,
// so that it only ever reads predecessors of its own or of rows that were complete before the jobs began. After the last
// path the winners are picked.
void aggregate_upwards(const bsm_context& context, int32_t path, Rows rows, const Share& share) {
  const int32_t width = context.config.width;
  const int32_t dx = path_dx(path);
  for (int32_t i = 0; i < rows.end - rows.begin; ++i) {
    const int32_t begin = share.job == 0 ? 0 : clamp(share.job * width / share.jobs + i * dx, 0, width);
    const int32_t end = share.job == share.jobs - 1 ? width : clamp((share.job + 1) * width / share.jobs + i * dx, 0, width);
    if (begin >= end) continue;
    const int32_t y = rows.end - 1 - i;
    aggregate_across_row(context, path, -1, y, begin, end, share.scratch);
    if (path + 1 == context.plan.across_paths) pick_left_winners(context, y, begin, end, share.scratch);
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

// Row y of a step, in all views kept. No row of such a step needs another of the same step.
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

// Rows of a step in a move.
Rows step_rows(const bsm_context& context, const Move& move, int32_t step, int32_t jobs) {
  const StepPlan& plan = context.plan.step[step];
  const int32_t lag = plan.lag + plan.turn * skew_of(context, jobs);
  return Rows{clamp(move.from - lag, 0, context.height), clamp(move.to - lag, 0, context.height)};
}

// Those that job `job` of `jobs` owns: at most kBlockRows.
Rows own_rows(const bsm_context& context, const Move& move, int32_t step, int32_t job, int32_t jobs) {
  const Rows rows = step_rows(context, move, step, jobs);
  const int32_t count = rows.end - rows.begin;
  return Rows{rows.begin + count * job / jobs, rows.begin + count * (job + 1) / jobs};
}

// The paths from the row before go through the jobs' rows one job after the other. Each job has a gate, at which it arrives
// with the costs of its rows, and whoever is through with the rows before arrives too: the second takes the paths on. So no
// job waits for another, in whatever order they run.
void follow_paths(const bsm_context& context, const Move& move, const Share& share) {
  for (int32_t owner = share.job; owner < share.jobs; ++owner) {
    if (count_up(&state_of(context, owner)->arrived) == 0) return;
    aggregate_downwards(context, own_rows(context, move, kAcross, owner, share.jobs), share.scratch);
  }
}

// The fills of the views of a job.
void do_fills(const bsm_context& context, const Move& move, int32_t owner, int32_t jobs) {
  const Rows rows = step_rows(context, move, kFill, jobs);
  for (int32_t view = owner; view < views_kept(context); view += jobs) {
    for (int32_t y = rows.begin; y < rows.end; ++y) fill_row(context, static_cast<View>(view), y);
  }
}

// Piece `piece` of what job `owner` has to do in a step. A filled row needs the one above: one piece is a view's fills.
void do_piece(const bsm_context& context, const Move& move, Step step, int32_t owner, int32_t piece, const Share& share) {
  if (kHasRefinement && step == kFill) {
    if (piece == 0) do_fills(context, move, owner, share.jobs);
    return;
  }
  const Rows own = own_rows(context, move, step, owner, share.jobs);
  const int32_t begin = own.begin + piece * kPieceRows;
  for (int32_t y = begin; y < own.end && y < begin + kPieceRows; ++y) step_row(context, move, step, y, share.scratch);
}

// A job's share of a move: its rows up to the costs, then the pieces of its other steps, then pieces that other jobs have
// not begun, since rows and processors differ. The later its turn in the paths, the more of its pieces it does before, so
// that it likely finds the rows before done and its own costs still in its cache.
void do_share(const bsm_context& context, const Move& move, const Share& share) {
  for (int32_t i = move.first; i < kAcross; ++i) {
    for (int32_t piece = 0; piece < kPieces; ++piece) do_piece(context, move, static_cast<Step>(i), share.job, piece, share);
  }
  const int32_t first = move.first > kAcross ? move.first : kAcross + 1;
  const int32_t pieces = (move.last + 1 - first) * kPieces;
  bool paths = kHasSgm && move.first <= kAcross && context.plan.step[kAcross].runs;
  const int32_t turn = pieces * share.job / share.jobs;
  for (int32_t i = 0; i < share.jobs; ++i) {
    const int32_t owner = (share.job + i) % share.jobs;
    for (;;) {
      const int32_t piece = static_cast<int32_t>(count_up(&state_of(context, owner)->begun));
      if (paths && piece >= turn) {
        follow_paths(context, move, share);
        paths = false;
      }
      if (piece >= pieces) break;
      const Step step = static_cast<Step>(first + piece / kPieces);
      if (context.plan.step[step].runs) do_piece(context, move, step, owner, piece % kPieces, share);
    }
  }
}

// Before the jobs of a move begin. Nobody goes before the first job.
void begin_move(const bsm_context& context, int32_t jobs) {
  for (int32_t job = 0; job < jobs; ++job) *state_of(context, job) = JobState{job == 0 ? 1u : 0u, 0};
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

// Jobs that run side by side. Without counters that threads can share there is one.
int32_t jobs_of(const bsm_context& context, const Parallel& parallel) {
  return BSM_HAS_ATOMICS == 0 || parallel.parallel_for == nullptr ? 1 : context.config.max_jobs;
}

template <class Function>
void for_jobs(const bsm_context& context, const Parallel& parallel, const Function& function) {
  Jobs<Function> jobs{context, function, jobs_of(context, parallel)};
  if (jobs.count == 1) {
    Jobs<Function>::run(&jobs, 0);
  } else {
    parallel.parallel_for(parallel.user, jobs.count, Jobs<Function>::run, &jobs);
  }
}

// Moves every row of the frame through the steps first..last, both of which run.
void move_frame(const bsm_context& context, const Frame& frame, Step first, Step last) {
  const Plan& plan = context.plan;
  const int32_t jobs = jobs_of(context, frame.parallel);
  const int32_t rows = jobs == 1 ? 1 : plan.batch;
  const int32_t begin = plan.step[first].lag + plan.step[first].turn * skew_of(context, jobs);
  const int32_t end = context.height + plan.step[last].lag + plan.step[last].turn * skew_of(context, jobs);
  for (int32_t from = begin; from < end; from += rows) {
    const Move move{frame.source, frame.sink, from, from + rows, first, last};
    begin_move(context, jobs);
    for_jobs(context, frame.parallel, [&](const Share& share) { do_share(context, move, share); });
  }
}

// The paths from below, over the whole frame.
void aggregate_frame_upwards(const bsm_context& context, const Parallel& parallel) {
  for (int32_t end = context.height; end > 0; end -= context.plan.batch) {
    const Rows rows{clamp(end - context.plan.batch, 0, context.height), end};
    for (int32_t path = 0; path < context.plan.across_paths; ++path) {
      for_jobs(context, parallel, [&](const Share& share) { aggregate_upwards(context, path, rows, share); });
    }
  }
}

constexpr RowSource kNoSource{};
constexpr RowSink kNoSink{};

}  // namespace

void engine_process(const bsm_context& context, const Frame& frame) {
  if (context.plan.whole_frame) {
    move_frame(context, frame, kEnter, static_cast<Step>(kCheck - 1));
    aggregate_frame_upwards(context, frame.parallel);
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
  begin_move(*context, 1);
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
