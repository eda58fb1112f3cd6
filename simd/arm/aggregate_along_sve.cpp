// aggregate_along, SVE: a vector of levels at once, the path in the scratch.
// Bound, per vector of levels: 9 operations one way, 10 back; 2 and 3 loads, 2 stores each.
#include "platform/compiler.h"

#if BSM_ARCH_SVE
#include "simd/arm/aggregate_step_sve.h"

namespace bsm {
namespace {

// Stores the sums of one direction, or adds the other one.
template <bool kAdd>
inline void put(svbool_t those, uint16_t* sum, svuint16_t path) {
  svst1(those, sum, kAdd ? svqadd(svld1(those, sum), path) : path);
}

// The first pixel of a direction; returns the least of its path.
template <bool kAdd>
uint16_t begin_path(const uint16_t* cost, int32_t levels, uint16_t* path, uint16_t* sum) {
  svuint16_t least = svdup_u16(kNoCost);
  for (int32_t level = 0; level < levels; level += lanes16()) {
    const svbool_t those = svwhilelt_b16(level, levels);
    const svuint16_t value = load_levels(those, cost + level);
    svst1(those, path + level, value);
    put<kAdd>(those, sum + level, value);
    least = svmin_x(svptrue_b16(), least, value);
  }
  return svminv(svptrue_b16(), least);
}

// The next pixel of a direction; returns the least of its path.
template <bool kAdd>
uint16_t continue_path(const uint16_t* cost, const Step& step, int32_t levels, uint16_t* path, uint16_t* sum) {
  svuint16_t least = svdup_u16(kNoCost);
  uint16_t before = kNoCost;
  svbool_t those = svwhilelt_b16(0, levels);
  svuint16_t same = load_levels(those, path);
  for (int32_t level = 0; level < levels;) {
    const int32_t next = level + lanes16();
    const svbool_t coming = svwhilelt_b16(next, levels);
    const svuint16_t after = load_levels(coming, path + next);
    const svuint16_t value = next_path(step, load_levels(those, cost + level), before, same, after);
    svst1(those, path + level, value);
    put<kAdd>(those, sum + level, value);
    least = svmin_x(svptrue_b16(), least, value);
    before = last_lane(same);
    same = after;
    those = coming;
    level = next;
  }
  return svminv(svptrue_b16(), least);
}

template <bool kBack>
void aggregate_direction(const AggregateAlongArgs& args) {
  const int32_t levels = args.num_disparities;
  uint16_t* path = static_cast<uint16_t*>(args.scratch);
  uint16_t least = 0;
  for (int32_t i = 0; i < args.width; ++i) {
    const int32_t x = kBack ? args.width - 1 - i : i;
    const uint16_t* cost = args.cost + ptrdiff_t{x} * args.stride;
    uint16_t* sum = args.sum + ptrdiff_t{x} * args.stride;
    if (i == 0) {
      least = begin_path<kBack>(cost, levels, path, sum);
    } else {
      const Step step = make_step(least, args.penalties[args.edge[kBack ? x + 1 : x]]);
      least = continue_path<kBack>(cost, step, levels, path, sum);
    }
  }
}

}  // namespace

uint64_t aggregate_along_sve_scratch(const KernelShape& shape) {
  return sizeof(uint16_t) * static_cast<uint64_t>(shape.num_disparities);
}

void aggregate_along_sve(const AggregateAlongArgs& args) {
  aggregate_direction<false>(args);
  aggregate_direction<true>(args);
}

}  // namespace bsm
#endif
