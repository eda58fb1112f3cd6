// aggregate_along, MVE: eight levels at once. The path alternates between two places, so that neighbouring levels are loads.
// Bound, per eight levels: 4 loads, 2 stores, 7 operations one way; 1 load and 1 operation more back.
#include "platform/compiler.h"

#if BSM_ARCH_MVE
#include "simd/arm/aggregate_mve.h"

namespace bsm {
namespace {

// Values of a path, one that is none before the first and after the last.
uint64_t path_values(int32_t num_disparities) {
  return (static_cast<uint64_t>(num_disparities) + kAtOnce - 1) / kAtOnce * kAtOnce + 2 * kAtOnce;
}

// The next pixel of a path; returns its least value. `last` is where the last eight levels begin, of which `exist` exist.
template <bool kAdd>
uint16_t continue_path(const uint16_t* cost, const Step& step, const uint16_t* previous, int32_t last, mve_pred16_t exist,
                       uint16_t* path, uint16_t* sum) {
  uint16_t least = kNoCost;
  for (int32_t level = 0; level < last; level += kAtOnce) {
    const uint16x8_t value = next_path(step, vldrhq_u16(cost + level), vldrhq_u16(previous + level - 1),
                                       vldrhq_u16(previous + level), vldrhq_u16(previous + level + 1));
    vstrhq_u16(path + level, value);
    vstrhq_u16(sum + level, kAdd ? vqaddq_u16(vldrhq_u16(sum + level), value) : value);
    least = vminvq_u16(least, value);
  }
  // Costs of levels that do not exist are none, and stay so.
  const uint16x8_t value = next_path(step, vldrhq_u16(cost + last), vldrhq_u16(previous + last - 1),
                                     vldrhq_u16(previous + last), vldrhq_u16(previous + last + 1));
  vstrhq_u16(path + last, value);
  vstrhq_p_u16(sum + last, kAdd ? vqaddq_u16(vldrhq_u16(sum + last), value) : value, exist);
  return vminvq_u16(least, value);
}

template <bool kBack>
void aggregate_way(const AggregateAlongArgs& args) {
  const int32_t last = (args.num_disparities - 1) / kAtOnce * kAtOnce;
  const mve_pred16_t exist = vctp16q(static_cast<uint32_t>(args.num_disparities - last));
  const uint64_t values = path_values(args.num_disparities);
  uint16_t* previous = static_cast<uint16_t*>(args.scratch) + kAtOnce;
  uint16_t* path = previous + values;
  const ptrdiff_t advance = kBack ? -ptrdiff_t{args.stride} : ptrdiff_t{args.stride};
  const ptrdiff_t first = kBack ? ptrdiff_t{args.width - 1} * args.stride : 0;
  const uint8_t* edge = kBack ? args.edge + args.width - 1 : args.edge + 1;  // between the first pixel and the second
  const uint16_t* cost = args.cost + first;
  uint16_t* sum = args.sum + first;
  // Before the first pixel: a predecessor whose levels all cost nothing adds nothing.
  BSM_MEMSET(args.scratch, 0xff, sizeof(uint16_t) * static_cast<size_t>(2 * values));
  BSM_MEMSET(previous, 0, sizeof(uint16_t) * static_cast<size_t>(last + kAtOnce));
  Step step{0, 0, vdupq_n_u16(0)};
  for (int32_t left = args.width; left > 0; --left) {
    const uint16_t least = continue_path<kBack>(cost, step, previous, last, exist, path, sum);
    if (left == 1) break;
    step = make_step(least, args.penalties[*edge]);
    edge += kBack ? -1 : 1;
    cost += advance;
    sum += advance;
    uint16_t* const older = previous;
    previous = path;
    path = older;
  }
}

}  // namespace

uint64_t aggregate_along_mve_scratch(const KernelShape& shape) {
  return 2 * sizeof(uint16_t) * path_values(shape.num_disparities);
}

void aggregate_along_mve(const AggregateAlongArgs& args) {
  aggregate_way<false>(args);
  aggregate_way<true>(args);
}

}  // namespace bsm
#endif
