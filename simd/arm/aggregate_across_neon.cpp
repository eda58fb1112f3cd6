// aggregate_across, NEON: eight levels at once.
// Bound, per eight levels: 12 operations; 5 loads, 2 stores.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "simd/arm/aggregate_step.h"

namespace bsm {
namespace {

inline void add_path(uint16_t* sum, uint16x8_t path) {
  vst1q_u16(sum, vqaddq_u16(vld1q_u16(sum), path));
}

inline void add_last(uint16_t* sum, uint16x8_t path, uint16x8_t beyond) {
  store_last(sum, vqaddq_u16(vld1q_u16(sum), path), beyond);
}

// A path that begins here. `last` is where the last eight levels begin.
void begin_path(const uint16_t* cost, int32_t last, uint16x8_t beyond, uint16_t* current, uint16_t* sum) {
  for (int32_t level = 0; level < last; level += kAtOnce) {
    const uint16x8_t path = vld1q_u16(cost + level);
    vst1q_u16(current + level, path);
    add_path(sum + level, path);
  }
  const uint16x8_t path = vld1q_u16(cost + last);
  store_last(current + last, path, beyond);
  add_last(sum + last, path, beyond);
}

// previous may be current: a vector is read before the one in its place is written. kVectors: of the levels of a pixel, all
// of them in registers; 0: any number.
template <int32_t kVectors>
inline void continue_path(const uint16_t* cost, const uint16_t* previous, Penalties penalties, int32_t, uint16x8_t beyond,
                          uint16_t* current, uint16_t* sum) {
  uint16x8_t from[kVectors];
  BSM_UNROLL
  for (int32_t i = 0; i < kVectors; ++i) from[i] = vld1q_u16(previous + i * kAtOnce);
  from[kVectors - 1] = vorrq_u16(from[kVectors - 1], beyond);
  uint16x8_t least = from[0];
  BSM_UNROLL
  for (int32_t i = 1; i < kVectors; ++i) least = vminq_u16(least, from[i]);
  const Step step = make_step(least16(least), penalties);
  const uint16x8_t none = vdupq_n_u16(kNoCost);
  BSM_UNROLL
  for (int32_t i = 0; i < kVectors; ++i) {
    const bool last = i == kVectors - 1;
    const uint16x8_t path = next_path(step, vld1q_u16(cost + i * kAtOnce), i == 0 ? none : from[i == 0 ? 0 : i - 1], from[i],
                                      last ? none : from[last ? i : i + 1]);
    if (last) {
      store_last(current + i * kAtOnce, path, beyond);
      add_last(sum + i * kAtOnce, path, beyond);
    } else {
      vst1q_u16(current + i * kAtOnce, path);
      add_path(sum + i * kAtOnce, path);
    }
  }
}

inline uint16_t least_path(const uint16_t* path, int32_t last, uint16x8_t beyond) {
  uint16x8_t least = vorrq_u16(vld1q_u16(path + last), beyond);
  for (int32_t level = 0; level < last; level += kAtOnce) least = vminq_u16(least, vld1q_u16(path + level));
  return least16(least);
}

template <>
inline void continue_path<0>(const uint16_t* cost, const uint16_t* previous, Penalties penalties, int32_t last,
                             uint16x8_t beyond, uint16_t* current, uint16_t* sum) {
  const Step step = make_step(least_path(previous, last, beyond), penalties);
  const uint16x8_t end = vorrq_u16(vld1q_u16(previous + last), beyond);
  uint16x8_t before = vdupq_n_u16(kNoCost);
  uint16x8_t same = last == 0 ? end : vld1q_u16(previous);
  for (int32_t level = 0; level < last; level += kAtOnce) {
    const uint16x8_t after = level + kAtOnce == last ? end : vld1q_u16(previous + level + kAtOnce);
    const uint16x8_t path = next_path(step, vld1q_u16(cost + level), before, same, after);
    vst1q_u16(current + level, path);
    add_path(sum + level, path);
    before = same;
    same = after;
  }
  const uint16x8_t path = next_path(step, vld1q_u16(cost + last), before, same, vdupq_n_u16(kNoCost));
  store_last(current + last, path, beyond);
  add_last(sum + last, path, beyond);
}

template <int32_t kVectors>
inline void aggregate_pixel(const AggregateAcrossArgs& args, int32_t x, int32_t last, uint16x8_t beyond) {
  const ptrdiff_t at = ptrdiff_t{x} * args.stride;
  const int32_t from = x - args.dx;
  if (args.previous == nullptr || from < 0 || from >= args.width) {
    begin_path(args.cost + at, last, beyond, args.current + at, args.sum + at);
  } else {
    continue_path<kVectors>(args.cost + at, args.previous + ptrdiff_t{from} * args.stride, args.penalties[args.edge[x]],
                            last, beyond, args.current + at, args.sum + at);
  }
}

template <int32_t kVectors>
void aggregate_pixels(const AggregateAcrossArgs& args) {
  const int32_t last = (args.num_disparities - 1) / kAtOnce * kAtOnce;
  const uint16x8_t beyond = beyond_last(args.num_disparities);
  // With current == previous, a diagonal reads its predecessor before it is overwritten.
  if (args.dx > 0) {
    for (int32_t x = args.end - 1; x >= args.begin; --x) aggregate_pixel<kVectors>(args, x, last, beyond);
  } else {
    for (int32_t x = args.begin; x < args.end; ++x) aggregate_pixel<kVectors>(args, x, last, beyond);
  }
}

}  // namespace

uint64_t aggregate_across_neon_scratch(const KernelShape&) {
  return 0;
}

void aggregate_across_neon(const AggregateAcrossArgs& args) {
  switch ((args.num_disparities + kAtOnce - 1) / kAtOnce) {
    case 1:
      return aggregate_pixels<1>(args);
    case 2:
      return aggregate_pixels<2>(args);
    case 3:
      return aggregate_pixels<3>(args);
    case 4:
      return aggregate_pixels<4>(args);
    case 5:
      return aggregate_pixels<5>(args);
    case 6:
      return aggregate_pixels<6>(args);
    case 7:
      return aggregate_pixels<7>(args);
    case 8:
      return aggregate_pixels<8>(args);
    default:
      return aggregate_pixels<0>(args);
  }
}

}  // namespace bsm
#endif
