// aggregate_across, MVE: eight levels at once.
// Bound, per eight levels: 5 loads, 2 stores, 10 operations.
#include "platform/compiler.h"

#if BSM_ARCH_MVE
#include "simd/arm/aggregate_mve.h"

namespace bsm {
namespace {

// What the last eight levels of a pixel need.
struct Last {
  int32_t level;               // where they begin
  mve_pred16_t exist, before;  // those that exist; of these all but the last
  uint16x8_t beyond;           // all bits set in the others
};

Last last_levels(int32_t num_disparities) {
  Last last;
  last.level = (num_disparities - 1) / kAtOnce * kAtOnce;
  const uint32_t count = static_cast<uint32_t>(num_disparities - last.level);
  last.exist = vctp16q(count);
  last.before = vctp16q(count - 1);
  last.beyond = vmvnq_m_u16(vdupq_n_u16(0xffff), vdupq_n_u16(0xffff), last.exist);
  return last;
}

uint16_t least_path(const uint16_t* path, const Last& last) {
  uint16_t least = vminvq_u16(kNoCost, vorrq_u16(vldrhq_z_u16(path + last.level, last.exist), last.beyond));
  for (int32_t level = 0; level < last.level; level += kAtOnce) least = vminvq_u16(least, vldrhq_u16(path + level));
  return least;
}

// previous may be current: a vector is read before the one in its place is written, and hands its highest level on.
void continue_path(const uint16_t* cost, const uint16_t* previous, Penalties penalties, const Last& last, uint16_t* current,
                   uint16_t* sum) {
  const Step step = make_step(least_path(previous, last), penalties);
  uint32_t highest = kNoCost;
  int32_t level = 0;
  for (; level < last.level; level += kAtOnce) {
    const uint16x8_t same = vldrhq_u16(previous + level);
    const uint16x8_t below = vshlcq_u16(same, &highest, 16);
    const uint16x8_t path = next_path(step, vldrhq_u16(cost + level), below, same, vldrhq_u16(previous + level + 1));
    vstrhq_u16(current + level, path);
    vstrhq_u16(sum + level, vqaddq_u16(vldrhq_u16(sum + level), path));
  }
  const uint16x8_t same = vorrq_u16(vldrhq_z_u16(previous + level, last.exist), last.beyond);
  const uint16x8_t below = vshlcq_u16(same, &highest, 16);
  const uint16x8_t none = vdupq_n_u16(kNoCost);
  const uint16x8_t above = vpselq_u16(vldrhq_z_u16(previous + level + 1, last.before), none, last.before);
  const uint16x8_t path = next_path(step, vldrhq_u16(cost + level), below, same, above);
  vstrhq_p_u16(current + level, path, last.exist);
  vstrhq_p_u16(sum + level, vqaddq_u16(vldrhq_u16(sum + level), path), last.exist);
}

void begin_path(const uint16_t* cost, int32_t count, uint16_t* current, uint16_t* sum) {
  for (; count > 0; count -= kAtOnce, cost += kAtOnce, current += kAtOnce, sum += kAtOnce) {
    const mve_pred16_t exist = vctp16q(static_cast<uint32_t>(count));
    const uint16x8_t path = vldrhq_u16(cost);
    vstrhq_p_u16(current, path, exist);
    vstrhq_p_u16(sum, vqaddq_u16(vldrhq_u16(sum), path), exist);
  }
}

void aggregate_pixel(const AggregateAcrossArgs& args, int32_t x, const Last& last) {
  const ptrdiff_t at = ptrdiff_t{x} * args.stride;
  const int32_t from = x - args.dx;
  if (args.previous == nullptr || from < 0 || from >= args.width) {
    begin_path(args.cost + at, args.num_disparities, args.current + at, args.sum + at);
  } else {
    continue_path(args.cost + at, args.previous + ptrdiff_t{from} * args.stride, args.penalties[args.edge[x]], last,
                  args.current + at, args.sum + at);
  }
}

}  // namespace

uint64_t aggregate_across_mve_scratch(const KernelShape&) {
  return 0;
}

void aggregate_across_mve(const AggregateAcrossArgs& args) {
  const Last last = last_levels(args.num_disparities);
  // With current == previous, a diagonal reads its predecessor before it is overwritten.
  if (args.dx > 0) {
    for (int32_t x = args.end - 1; x >= args.begin; --x) aggregate_pixel(args, x, last);
  } else {
    for (int32_t x = args.begin; x < args.end; ++x) aggregate_pixel(args, x, last);
  }
}

}  // namespace bsm
#endif
