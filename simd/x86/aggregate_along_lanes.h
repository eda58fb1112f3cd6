// aggregate_along: both paths at once, from the two ends of the row; each stays in registers.
// The first path to reach a pixel writes its sum, the second adds to it. Bound: the chain from one pixel to the next of a
// path, a minimum over all lanes and four operations; the two chains hide each other's latency.
// Include after the levels of one instruction set.
#ifndef BSM_SIMD_X86_AGGREGATE_ALONG_LANES_H
#define BSM_SIMD_X86_AGGREGATE_ALONG_LANES_H

#include "simd/x86/aggregate_lanes.h"

namespace bsm {
namespace {

struct AlongRow {
  template <int32_t kRegisters>
  BSM_NOINLINE static void run(const AggregateAlongArgs& args, const Levels& levels) {
    const PenaltyLanes penalties(args.penalties);
    const LastLanes last = levels.last;
    const ptrdiff_t stride = args.stride;
    int32_t left = 0;
    int32_t right = args.width - 1;
    Path<kRegisters> from_left;
    Path<kRegisters> from_right;
    from_left.begin(args.cost);
    from_right.begin(args.cost + right * stride);
    for (; left < right; ++left, --right) {
      from_left.store_to(args.sum + left * stride, last);
      from_right.store_to(args.sum + right * stride, last);
      from_left.advance_to(args.cost + (left + 1) * stride, penalties, args.edge[left + 1]);
      from_right.advance_to(args.cost + (right - 1) * stride, penalties, args.edge[right]);
    }
    if (left == right) from_left.store_to(args.sum + left * stride, last);
    for (bool met = left == right;; met = false) {
      if (!met) from_left.add_to(args.sum + left * stride, last);
      from_right.add_to(args.sum + right * stride, last);
      if (right == 0) return;
      ++left;
      --right;
      from_left.advance_to(args.cost + left * stride, penalties, args.edge[left]);
      from_right.advance_to(args.cost + right * stride, penalties, args.edge[right + 1]);
    }
  }

  BSM_NOINLINE static void run_in_memory(const AggregateAlongArgs& args, const Levels& levels) {
    const PenaltyLanes penalties(args.penalties);
    uint16_t* path = static_cast<uint16_t*>(args.scratch);
    copy_in_memory(args.cost, levels, path);
    copy_in_memory(args.cost, levels, args.sum);
    for (int32_t x = 1; x < args.width; ++x) {
      const ptrdiff_t at = ptrdiff_t{x} * args.stride;
      advance_in_memory(path, args.cost + at, penalties, args.edge[x], levels, path);
      copy_in_memory(path, levels, args.sum + at);
    }
    for (int32_t x = args.width - 1; x >= 0; --x) {
      const ptrdiff_t at = ptrdiff_t{x} * args.stride;
      if (x == args.width - 1) {
        copy_in_memory(args.cost + at, levels, path);
      } else {
        advance_in_memory(path, args.cost + at, penalties, args.edge[x + 1], levels, path);
      }
      add_in_memory(path, levels, args.sum + at);
    }
  }
};

inline uint64_t along_scratch(const KernelShape& shape) {
  const uint64_t registers = (static_cast<uint64_t>(shape.num_disparities) + kLevelLanes - 1) / kLevelLanes;
  return registers * sizeof(Bytes);
}

inline void aggregate_along(const AggregateAlongArgs& args) {
  run_row<AlongRow>(args, Levels(args.num_disparities));
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_AGGREGATE_ALONG_LANES_H
