// A context: configuration, kernels, memory plan and where the rows in flight are. It lives at the start of the arena.
#ifndef BSM_CORE_CONTEXT_H
#define BSM_CORE_CONTEXT_H

#include <stdint.h>

#include "bsm/bsm.h"
#include "core/plan.h"
#include "simd/build.h"
#include "simd/kernels.h"

struct bsm_context {
  const bsm_context* self;  // this address: tells a context from other memory
  uint8_t* arena;           // multiple of bsm::kArenaAlignment
  bsm_config config;
  bsm::Kernels kernels;
  bsm::Pattern pattern;
  bsm::Plan plan;

  // Rows in flight.
  int32_t height;    // rows of the image; the configured height until bsm_finish says less
  int32_t entered;   // rows that have entered the pipeline, counting the virtual ones after the last
  int32_t finished;  // rows that have been pulled
  bool ended;        // no more rows come
};

namespace bsm {

// Row y of a ring, x = 0.
template <class T>
T* ring_row(const bsm_context& context, const Ring& ring, int32_t y) {
  return reinterpret_cast<T*>(context.arena + ring.offset + static_cast<size_t>(y % ring.rows) * ring.stride);
}

// A buffer of a job's scratch.
template <class T>
T* job_buffer(uint8_t* job, size_t offset) {
  return reinterpret_cast<T*>(job + offset);
}

// Rows y - radius .. y + radius of a ring, nullptr for those outside the image.
template <class T>
void rows_inside(const bsm_context& context, const Ring& ring, int32_t y, int32_t radius, const T** rows) {
  for (int32_t i = 0; i <= 2 * radius; ++i) {
    const int32_t row = y - radius + i;
    rows[i] = 0 <= row && row < context.height ? ring_row<const T>(context, ring, row) : nullptr;
  }
}

// Views whose map is kept: kLeft alone, or both.
inline int32_t views_kept(const bsm_context& context) {
  return context.config.right_map != 0 ? kViews : kLeft + 1;
}

inline bool uses_sgm(const bsm_context& context) {
  return kHasSgm && (!kHasLocal || context.plan.sum.rows != 0);
}

inline bool uses_fractions(const bsm_context& context) {
  return kHasSgm && kHasRefinement && context.plan.fraction_radius != 0;
}

}  // namespace bsm

#endif  // BSM_CORE_CONTEXT_H
