// The schedule. A row's way: enter_row -> match_row -> aggregate_across -> check_row -> continue_row -> vote_row -> fill_row
// -> smooth_row -> write_row; each stage lags the one before by the rows that its window looks ahead.
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
  return context.arena + context.plan.jobs + static_cast<uint64_t>(job) * context.plan.job.bytes;
}

struct Rows {
  int32_t begin, end;
};

// Rows that a stage `lag` rows behind the input works on while the input moves from row `from` to row `to`.
Rows lagging(const bsm_context& context, int32_t from, int32_t to, int32_t lag) {
  return Rows{clamp(from - lag, 0, context.height), clamp(to - lag, 0, context.height)};
}

// Calls function(job index, jobs, scratch) once for each of n_jobs jobs, side by side where the caller can.
template <class Function>
struct Jobs {
  const bsm_context& context;
  const Function& function;
  int32_t count;

  static void run(void* pointer, int32_t job) {
    const Jobs& jobs = *static_cast<const Jobs*>(pointer);
    jobs.function(job, jobs.count, job_base(jobs.context, job));
  }
};

template <class Function>
void for_jobs(const bsm_context& context, int32_t most, const Parallel& parallel, const Function& function) {
  const int32_t allowed = parallel.parallel_for == nullptr ? 1 : context.config.max_jobs;
  Jobs<Function> jobs{context, function, most < allowed ? most : allowed};
  if (jobs.count == 1) {
    Jobs<Function>::run(&jobs, 0);
  } else {
    parallel.parallel_for(parallel.user, jobs.count, Jobs<Function>::run, &jobs);
  }
}

// function(y, scratch) for every row; job j takes every count-th row.
template <class Function>
void for_rows(const bsm_context& context, Rows rows, const Parallel& parallel, const Function& function) {
  if (rows.begin >= rows.end) return;
  for_jobs(context, rows.end - rows.begin, parallel, [&](int32_t job, int32_t count, uint8_t* scratch) {
    for (int32_t y = rows.begin + job; y < rows.end; y += count) function(y, scratch);
  });
}

// One path from the row before over some rows: step 1 runs from rows.begin downwards, -1 from rows.end - 1 upwards. Each job
// owns a block of columns that moves along with the path, so that it only ever reads predecessors of its own or of rows that
// were complete before the jobs began.
void aggregate_across(const bsm_context& context, int32_t path, int32_t step, Rows rows, const Parallel& parallel) {
  const int32_t width = context.config.width;
  const int32_t dx = path_dx(path);
  const int32_t first = step > 0 ? rows.begin : rows.end - 1;
  for_jobs(context, width, parallel, [&](int32_t job, int32_t count, uint8_t* scratch) {
    for (int32_t i = 0; i < rows.end - rows.begin; ++i) {
      const int32_t begin = job == 0 ? 0 : clamp(job * width / count + i * dx, 0, width);
      const int32_t end = job == count - 1 ? width : clamp((job + 1) * width / count + i * dx, 0, width);
      if (begin < end) aggregate_across_row(context, path, step, first + i * step, begin, end, scratch);
    }
  });
}

// Input rows to costs, winners or, with aggregation, sums of the paths from the sides and from above.
void advance_matching(const bsm_context& context, const RowSource& source, int32_t from, int32_t to,
                      const Parallel& parallel) {
  for_rows(context, lagging(context, from, to, 0), parallel, [&](int32_t y, uint8_t*) { enter_row(context, source, y); });
  const Rows matched = lagging(context, from, to, context.plan.pattern_radius);
  for_rows(context, matched, parallel, [&](int32_t y, uint8_t* job) { match_row(context, y, job); });
  if (matched.begin == matched.end) return;
  for (int32_t path = 0; path < context.plan.across_paths; ++path) {
    aggregate_across(context, path, 1, matched, parallel);
  }
}

// Winners or sums to finished rows.
void advance_refinement(const bsm_context& context, int32_t from, int32_t to, const Parallel& parallel) {
  const Plan& plan = context.plan;
  int32_t lag = plan.pattern_radius;
  for_rows(context, lagging(context, from, to, lag), parallel, [&](int32_t y, uint8_t* job) { check_row(context, y, job); });
  if (context.config.stage != BSM_STAGE_REFINED) return;
  const int32_t views = views_kept(context);
  const auto each_view = [&](Rows rows, const auto& function) {
    for_rows(context, rows, parallel, [&](int32_t y, uint8_t* job) {
      for (int32_t view = 0; view < views; ++view) function(static_cast<View>(view), y, job);
    });
  };
  if (plan.speckle_radius != 0) {
    lag += plan.speckle_radius;
    each_view(lagging(context, from, to, lag), [&](View view, int32_t y, uint8_t*) { despeckle_row(context, view, y); });
  }
  if (plan.border_radius != 0) {
    lag += plan.border_radius;
    each_view(lagging(context, from, to, lag), [&](View view, int32_t y, uint8_t*) { continue_row(context, view, y); });
  }
  lag += plan.vote_radius;
  const Rows voted = lagging(context, from, to, lag);
  each_view(voted, [&](View view, int32_t y, uint8_t* job) { vote_row(context, view, y, job); });
  for (int32_t y = voted.begin; y < voted.end; ++y) {
    for (int32_t view = 0; view < views; ++view) fill_row(context, static_cast<View>(view), y);
  }
  for (int32_t pass = 0; pass < plan.smooth_passes; ++pass) {
    lag += plan.smooth_radius;
    each_view(lagging(context, from, to, lag),
              [&](View view, int32_t y, uint8_t* job) { smooth_row(context, view, pass, y, job); });
  }
  if (uses_fractions(context)) {
    lag += plan.median_radius;
    each_view(lagging(context, from, to, lag), [&](View view, int32_t y, uint8_t*) { restore_row(context, view, y); });
    lag += plan.fraction_radius;
    each_view(lagging(context, from, to, lag),
              [&](View view, int32_t y, uint8_t* job) { smooth_fraction_row(context, view, y, job); });
  }
}

int16_t* map_row(const bsm_map& map, int32_t y) {
  return reinterpret_cast<int16_t*>(reinterpret_cast<uint8_t*>(map.data) + y * map.stride);
}

}  // namespace

void engine_reset(bsm_context* context) {
  context->height = context->config.height;
  context->entered = 0;
  context->finished = 0;
  context->ended = false;
}

void engine_advance(bsm_context* context, const RowSource& source, int32_t rows, const Parallel& parallel) {
  const int32_t from = context->entered;
  context->entered += rows;
  if (!context->plan.whole_frame) advance_matching(*context, source, from, context->entered, parallel);
  advance_refinement(*context, from, context->entered, parallel);
}

void engine_aggregate_frame(bsm_context* context, const RowSource& source, const Parallel& parallel) {
  const int32_t batch = context->plan.batch;
  for (int32_t from = 0; from < context->height + context->plan.pattern_radius; from += batch) {
    advance_matching(*context, source, from, from + batch, parallel);
  }
  for (int32_t end = context->height; end > 0; end -= batch) {
    const Rows rows{clamp(end - batch, 0, context->height), end};
    for (int32_t path = 0; path < context->plan.across_paths; ++path) aggregate_across(*context, path, -1, rows, parallel);
  }
}

int32_t engine_rows_out(const bsm_context& context) {
  return clamp(context.entered - context.plan.delay, 0, context.height);
}

void engine_write(bsm_context* context, const RowSink& sink, const Parallel& parallel) {
  const Rows rows{context->finished, engine_rows_out(*context)};
  const bsm_context& c = *context;
  for_rows(c, rows, parallel, [&](int32_t y, uint8_t* job) {
    int16_t* disparity = map_row(sink.disparity, y);
    write_row(c, kLeft, y, disparity, job);
    if (sink.right_disparity.data != nullptr) write_row(c, kRight, y, map_row(sink.right_disparity, y), job);
    if (sink.confidence.data != nullptr) {
      confidence_row(c, y, disparity, sink.confidence.data + y * sink.confidence.stride);
    }
  });
  context->finished = rows.end;
}

}  // namespace bsm
