// aggregate_across, DSP: two levels at once.
// Bound, per two levels: 4 loads, 2 stores, 14 operations.
#include "platform/compiler.h"

#if BSM_ARCH_DSP
#include "simd/arm/aggregate_dsp.h"

namespace bsm {
namespace {

uint32_t least_path(const uint16_t* path, int32_t last, bool odd) {
  uint32_t least = load_last(path + last, odd);
  for (int32_t level = 0; level < last; level += 2) least = least16(least, load32(path + level));
  return least_half(least);
}

// previous may be current: a word is read before the one in its place is written.
void continue_path(const uint16_t* cost, const uint16_t* previous, Penalties penalties, int32_t last, bool odd,
                   uint16_t* current, uint16_t* sum) {
  const Step step = make_step(least_path(previous, last, odd), penalties);
  const uint32_t end = load_last(previous + last, odd);
  uint32_t same = last == 0 ? end : load32(previous);
  uint32_t below = kNone >> 16 | same << 16;
  for (int32_t level = 0; level < last; level += 2) {
    const uint32_t next = level + 2 == last ? end : load32(previous + level + 2);
    const uint32_t above = between(same, next);
    const uint32_t value = next_path(step, load32(cost + level), below, same, above);
    store32(current + level, value);
    store32(sum + level, __uqadd16(load32(sum + level), value));
    below = above;
    same = next;
  }
  const uint32_t value = next_path(step, load_last(cost + last, odd), below, same, between(same, kNone));
  store_last(current + last, value, odd);
  store_last(sum + last, __uqadd16(load_last(sum + last, odd), value), odd);
}

void begin_path(const uint16_t* cost, int32_t count, uint16_t* current, uint16_t* sum) {
  for (int32_t level = 0; level < count; ++level) {
    current[level] = cost[level];
    sum[level] = static_cast<uint16_t>(__uqadd16(sum[level], cost[level]));
  }
}

void aggregate_pixel(const AggregateAcrossArgs& args, int32_t x) {
  const int32_t last = (args.num_disparities - 1) & ~1;
  const bool odd = (args.num_disparities & 1) != 0;
  const ptrdiff_t at = ptrdiff_t{x} * args.stride;
  const int32_t from = x - args.dx;
  if (args.previous == nullptr || from < 0 || from >= args.width) {
    begin_path(args.cost + at, args.num_disparities, args.current + at, args.sum + at);
  } else {
    continue_path(args.cost + at, args.previous + ptrdiff_t{from} * args.stride, args.penalties[args.edge[x]], last, odd,
                  args.current + at, args.sum + at);
  }
}

}  // namespace

uint64_t aggregate_across_dsp_scratch(const KernelShape&) {
  return 0;
}

void aggregate_across_dsp(const AggregateAcrossArgs& args) {
  // With current == previous, a diagonal reads its predecessor before it is overwritten.
  if (args.dx > 0) {
    for (int32_t x = args.end - 1; x >= args.begin; --x) aggregate_pixel(args, x);
  } else {
    for (int32_t x = args.begin; x < args.end; ++x) aggregate_pixel(args, x);
  }
}

}  // namespace bsm
#endif
