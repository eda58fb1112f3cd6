// aggregate_across, SVE: a vector of levels at once.
// Bound, per vector of levels: 11 operations; 4 loads, 2 stores.
#include "platform/compiler.h"

#if BSM_ARCH_SVE
#include "simd/arm/aggregate_step_sve.h"

namespace bsm {
namespace {

inline void put(svbool_t those, uint16_t* current, uint16_t* sum, svuint16_t path) {
  svst1(those, current, path);
  svst1(those, sum, svqadd(svld1(those, sum), path));
}

// A path that begins here.
void begin_path(const uint16_t* cost, int32_t levels, uint16_t* current, uint16_t* sum) {
  for (int32_t level = 0; level < levels; level += lanes16()) {
    const svbool_t those = svwhilelt_b16(level, levels);
    put(those, current + level, sum + level, svld1(those, cost + level));
  }
}

inline uint16_t least_path(const uint16_t* path, int32_t levels) {
  svuint16_t least = svdup_u16(kNoCost);
  for (int32_t level = 0; level < levels; level += lanes16()) {
    const svbool_t those = svwhilelt_b16(level, levels);
    least = svmin_m(those, least, svld1(those, path + level));
  }
  return svminv(svptrue_b16(), least);
}

// previous may be current: a vector is read before the one in its place is written.
void continue_path(const uint16_t* cost, const uint16_t* previous, Penalties penalties, int32_t levels, uint16_t* current,
                   uint16_t* sum) {
  const Step step = make_step(least_path(previous, levels), penalties);
  uint16_t before = kNoCost;
  svbool_t those = svwhilelt_b16(0, levels);
  svuint16_t same = load_levels(those, previous);
  for (int32_t level = 0; level < levels;) {
    const int32_t next = level + lanes16();
    const svbool_t coming = svwhilelt_b16(next, levels);
    const svuint16_t after = load_levels(coming, previous + next);
    put(those, current + level, sum + level, next_path(step, svld1(those, cost + level), before, same, after));
    before = last_lane(same);
    same = after;
    those = coming;
    level = next;
  }
}

inline void aggregate_pixel(const AggregateAcrossArgs& args, int32_t x) {
  const ptrdiff_t at = ptrdiff_t{x} * args.stride;
  const int32_t from = x - args.dx;
  if (args.previous == nullptr || from < 0 || from >= args.width) {
    begin_path(args.cost + at, args.num_disparities, args.current + at, args.sum + at);
  } else {
    continue_path(args.cost + at, args.previous + ptrdiff_t{from} * args.stride, args.penalties[args.edge[x]],
                  args.num_disparities, args.current + at, args.sum + at);
  }
}

}  // namespace

uint64_t aggregate_across_sve_scratch(const KernelShape&) {
  return 0;
}

void aggregate_across_sve(const AggregateAcrossArgs& args) {
  // With current == previous, a diagonal reads its predecessor before it is overwritten.
  if (args.dx > 0) {
    for (int32_t x = args.end - 1; x >= args.begin; --x) aggregate_pixel(args, x);
  } else {
    for (int32_t x = args.begin; x < args.end; ++x) aggregate_pixel(args, x);
  }
}

}  // namespace bsm
#endif
