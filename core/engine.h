// The row engine: rows enter at the top of the pipeline and leave it `delay` rows later; every stage works on whole rows.
#ifndef BSM_CORE_ENGINE_H
#define BSM_CORE_ENGINE_H

#include <stdint.h>

#include "bsm/bsm.h"
#include "core/context.h"
#include "core/match.h"

namespace bsm {

// Where row y of each map goes: to data + y * stride; nullptr where a map is not wanted.
struct RowSink {
  bsm_map disparity;
  bsm_map right_disparity;
  bsm_byte_map confidence;
};

// How work is spread over jobs.
struct Parallel {
  bsm_parallel_for parallel_for;  // nullptr: run in this thread
  void* user;
};

struct Frame {
  RowSource source;
  RowSink sink;
  Parallel parallel;
};

// Matches a whole frame. No rows are in flight.
void engine_process(const bsm_context& context, const Frame& frame);

// Row by row. Empties the pipeline.
void engine_reset(bsm_context* context);

// Moves the pipeline on by one row: the next one of source; nullptr after the last row of the image.
void engine_enter(bsm_context* context, const RowSource* source);

// Rows that have left the pipeline so far; those from context->finished on have not been written.
int32_t engine_rows_out(const bsm_context& context);

// Writes row context->finished.
void engine_write(bsm_context* context, const RowSink& sink);

}  // namespace bsm

#endif  // BSM_CORE_ENGINE_H
