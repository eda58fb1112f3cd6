// aggregate_across, scalar: one path from the row before, straight or diagonal.
#include "platform/compiler.h"
#include "simd/scalar/aggregate.h"

namespace bsm {
namespace {

void aggregate_pixel(const AggregateAcrossArgs& args, int32_t x) {
  const int32_t count = args.num_disparities;
  const ptrdiff_t at = ptrdiff_t{x} * args.stride;
  const int32_t from = x - args.dx;
  uint16_t* current = args.current + at;
  if (args.previous == nullptr || from < 0 || from >= args.width) {
    BSM_MEMCPY(current, args.cost + at, static_cast<size_t>(count) * sizeof *current);
  } else {
    aggregate_step(args.cost + at, args.previous + ptrdiff_t{from} * args.stride, args.penalties[args.edge[x]], count,
                   current);
  }
  for (int32_t level = 0; level < count; ++level) {
    args.sum[at + level] = saturate(uint32_t{args.sum[at + level]} + current[level]);
  }
}

}  // namespace

uint64_t aggregate_across_scalar_scratch(const KernelShape&) {
  return 0;
}

void aggregate_across_scalar(const AggregateAcrossArgs& args) {
  // With current == previous, a diagonal reads its predecessor before it is overwritten.
  if (args.dx > 0) {
    for (int32_t x = args.end - 1; x >= args.begin; --x) aggregate_pixel(args, x);
  } else {
    for (int32_t x = args.begin; x < args.end; ++x) aggregate_pixel(args, x);
  }
}

}  // namespace bsm
