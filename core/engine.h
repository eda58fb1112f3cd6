// The row engine: rows enter at the top of the pipeline and leave it `delay` rows later; every stage works on whole rows.
#ifndef BSM_CORE_ENGINE_H
#define BSM_CORE_ENGINE_H

#include <stdint.h>

#include "bsm/bsm.h"
#include "core/context.h"
#include "core/match.h"

namespace bsm {

// How the rows of one stage are spread over jobs.
struct Parallel {
  bsm_parallel_for parallel_for;  // nullptr: run in this thread
  void* user;
};

// Empties the pipeline.
void engine_reset(bsm_context* context);

// Moves the pipeline on by `rows` (at most plan.batch) input rows. Rows that exist are read from source; past the last row
// of the image nothing enters and the rows in flight move on.
void engine_advance(bsm_context* context, const RowSource& source, int32_t rows, const Parallel& parallel);

// Plans with whole_frame: aggregates the whole frame. engine_advance then moves on from the sums and reads no source.
void engine_aggregate_frame(bsm_context* context, const RowSource& source, const Parallel& parallel);

// Rows that have left the pipeline so far.
int32_t engine_rows_out(const bsm_context& context);

// Where row y of each map goes: to data + y * stride; nullptr where a map is not wanted.
struct RowSink {
  bsm_map disparity;
  bsm_map right_disparity;
  bsm_byte_map confidence;
};

// Writes the rows that have left the pipeline since the last call.
void engine_write(bsm_context* context, const RowSink& sink, const Parallel& parallel);

}  // namespace bsm

#endif  // BSM_CORE_ENGINE_H
