// aggregate_across: one path from the row before; the pixels are independent of each other.
// Bound, per pixel and register: 3 loads and 2 stores, mostly of the second-level cache.
// Include after the levels of one instruction set.
#ifndef BSM_SIMD_X86_AGGREGATE_ACROSS_LANES_H
#define BSM_SIMD_X86_AGGREGATE_ACROSS_LANES_H

#include "simd/x86/aggregate_lanes.h"

namespace bsm {
namespace {

struct AcrossRow {
  // With current == previous, a diagonal reads its predecessor before it is overwritten.
  template <class Function>
  static void for_pixels(const AggregateAcrossArgs& args, const Function& function) {
    if (args.dx > 0) {
      for (int32_t x = args.end - 1; x >= args.begin; --x) function(x);
    } else {
      for (int32_t x = args.begin; x < args.end; ++x) function(x);
    }
  }

  // L of the predecessor of x; nullptr: the path begins at x.
  static const uint16_t* predecessor(const AggregateAcrossArgs& args, int32_t x) {
    const int32_t from = x - args.dx;
    const bool begins = args.previous == nullptr || from < 0 || from >= args.width;
    return begins ? nullptr : args.previous + ptrdiff_t{from} * args.stride;
  }

  template <int32_t kRegisters>
  BSM_NOINLINE static void run(const AggregateAcrossArgs& args, const Levels& levels) {
    const PenaltyLanes penalties(args.penalties);
    const LastLanes last = levels.last;
    for_pixels(args, [&](int32_t x) {
      const ptrdiff_t at = ptrdiff_t{x} * args.stride;
      const uint16_t* previous = predecessor(args, x);
      Path<kRegisters> path;
      if (previous == nullptr) {
        path.begin(args.cost + at);
      } else {
        path.load_from(previous, last);
        path.advance_to(args.cost + at, penalties, args.edge[x]);
      }
      path.store_to(args.current + at, last);
      path.add_to(args.sum + at, last);
    });
  }

  BSM_NOINLINE static void run_in_memory(const AggregateAcrossArgs& args, const Levels& levels) {
    const PenaltyLanes penalties(args.penalties);
    for_pixels(args, [&](int32_t x) {
      const ptrdiff_t at = ptrdiff_t{x} * args.stride;
      const uint16_t* previous = predecessor(args, x);
      if (previous == nullptr) {
        copy_in_memory(args.cost + at, levels, args.current + at);
      } else {
        advance_in_memory(previous, args.cost + at, penalties, args.edge[x], levels, args.current + at);
      }
      add_in_memory(args.current + at, levels, args.sum + at);
    });
  }
};

inline void aggregate_across(const AggregateAcrossArgs& args) {
  run_row<AcrossRow>(args, Levels(args.num_disparities));
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_AGGREGATE_ACROSS_LANES_H
