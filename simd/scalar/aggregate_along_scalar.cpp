// aggregate_along, scalar: the two paths along the row, from the left and from the right.
#include "platform/compiler.h"
#include "simd/scalar/aggregate.h"

namespace bsm {

uint64_t aggregate_along_scalar_scratch(const KernelShape& shape) {
  return uint64_t{sizeof(uint16_t)} * static_cast<uint32_t>(shape.num_disparities);
}

void aggregate_along_scalar(const AggregateAlongArgs& args) {
  const int32_t count = args.num_disparities;
  uint16_t* path = static_cast<uint16_t*>(args.scratch);
  BSM_MEMCPY(path, args.cost, static_cast<size_t>(count) * sizeof *path);
  BSM_MEMCPY(args.sum, args.cost, static_cast<size_t>(count) * sizeof *path);
  for (int32_t x = 1; x < args.width; ++x) {
    const ptrdiff_t at = ptrdiff_t{x} * args.stride;
    aggregate_step(args.cost + at, path, args.penalties[args.edge[x]], count, path);
    BSM_MEMCPY(args.sum + at, path, static_cast<size_t>(count) * sizeof *path);
  }
  for (int32_t x = args.width - 1; x >= 0; --x) {
    const ptrdiff_t at = ptrdiff_t{x} * args.stride;
    if (x == args.width - 1) {
      BSM_MEMCPY(path, args.cost + at, static_cast<size_t>(count) * sizeof *path);
    } else {
      aggregate_step(args.cost + at, path, args.penalties[args.edge[x + 1]], count, path);
    }
    for (int32_t level = 0; level < count; ++level) {
      args.sum[at + level] = saturate(uint32_t{args.sum[at + level]} + path[level]);
    }
  }
}

}  // namespace bsm
