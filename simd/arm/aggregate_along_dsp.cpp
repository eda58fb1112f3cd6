// aggregate_along, DSP: two levels at once.
// Bound, per two levels and way: 3 loads, 2 stores, 15 operations.
#include "platform/compiler.h"

#if BSM_ARCH_DSP
#include "simd/arm/aggregate_dsp.h"

namespace bsm {
namespace {

// A path's next pixel, in place; its values are added to what `kept`, all bits or none, keeps of sum. Returns the least of
// them.
inline uint32_t continue_path(const uint16_t* cost, const Step& step, int32_t last, bool odd, uint16_t* path, uint32_t kept,
                              uint16_t* sum) {
  uint32_t same = load32(path);
  uint32_t below = kNone >> 16 | same << 16;
  uint32_t least = kNone;
  for (int32_t level = 0; level < last; level += 2) {
    const uint32_t next = load32(path + level + 2);
    const uint32_t above = between(same, next);
    const uint32_t value = next_path(step, load32(cost + level), below, same, above);
    store32(path + level, value);
    store32(sum + level, __uqadd16(load32(sum + level) & kept, value));
    least = least16(least, value);
    below = above;
    same = next;
  }
  const uint32_t value =
      next_path(step, load_last(cost + last, odd), below, same, between(same, kNone)) | (odd ? kNone << 16 : 0);
  store32(path + last, value);
  store_last(sum + last, __uqadd16(load_last(sum + last, odd) & kept, value), odd);
  return least_half(least16(least, value));
}

// The first way goes forth, the second back.
BSM_NOINLINE void aggregate_way(const AggregateAlongArgs& args, bool back) {
  uint16_t* path = static_cast<uint16_t*>(args.scratch);
  const int32_t last = (args.num_disparities - 1) & ~1;
  const bool odd = (args.num_disparities & 1) != 0;
  const ptrdiff_t advance = back ? -ptrdiff_t{args.stride} : ptrdiff_t{args.stride};
  const ptrdiff_t first = back ? ptrdiff_t{args.width - 1} * args.stride : 0;
  const uint8_t* edge = back ? args.edge + args.width - 1 : args.edge + 1;  // between the first pixel and the second
  const uint16_t* cost = args.cost + first;
  const ptrdiff_t edge_advance = back ? -1 : 1;
  uint16_t* sum = args.sum + first;
  // Before the first pixel: a predecessor whose levels all cost nothing adds nothing.
  for (int32_t level = 0; level < last; level += 2) store32(path + level, 0);
  store32(path + last, odd ? kNone << 16 : 0);
  Step step{0, 0, 0};
  const uint32_t kept = back ? ~0u : 0u;
  for (int32_t left = args.width; left > 0; --left) {
    const uint32_t least = continue_path(cost, step, last, odd, path, kept, sum);
    if (left == 1) break;
    step = make_step(least, args.penalties[*edge]);
    edge += edge_advance;
    cost += advance;
    sum += advance;
  }
}

}  // namespace

uint64_t aggregate_along_dsp_scratch(const KernelShape& shape) {
  return sizeof(uint16_t) * (static_cast<uint64_t>(shape.num_disparities) + 1);
}

void aggregate_along_dsp(const AggregateAlongArgs& args) {
  aggregate_way(args, false);
  aggregate_way(args, true);
}

}  // namespace bsm
#endif
