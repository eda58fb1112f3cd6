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

// Where a pixel's levels lie. previous may be current: a vector is read before the one in its place is written.
struct Pixel {
  const uint16_t* cost;
  const uint16_t* previous;
  uint16_t* current;
  uint16_t* sum;
};

// kVectors: of the levels of a pixel, all of them in registers; 0: any number.
template <int32_t kVectors>
BSM_INLINE void continue_path(const Pixel& pixel, Penalties penalties, int32_t, uint16x8_t beyond) {
  uint16x8_t from[kVectors];
  BSM_UNROLL
  for (int32_t i = 0; i < kVectors; ++i) from[i] = vld1q_u16(pixel.previous + i * kAtOnce);
  from[kVectors - 1] = vorrq_u16(from[kVectors - 1], beyond);
  uint16x8_t least = from[0];
  BSM_UNROLL
  for (int32_t i = 1; i < kVectors; ++i) least = vminq_u16(least, from[i]);
  const Step step = make_step(least16(least), penalties);
  const uint16x8_t none = vdupq_n_u16(kNoCost);
  BSM_UNROLL
  for (int32_t i = 0; i < kVectors; i += 2) {
    // Two vectors' loads before their stores, so that neighbours go together.
    const int32_t next = i + 1 < kVectors ? i + 1 : i;
    const bool first_last = i == kVectors - 1;
    const bool next_last = next == kVectors - 1;
    const uint16x8_t a = next_path(step, vld1q_u16(pixel.cost + i * kAtOnce), i == 0 ? none : from[i == 0 ? 0 : i - 1],
                                   from[i], first_last ? none : from[next]);
    const uint16x8_t b = next_path(step, vld1q_u16(pixel.cost + next * kAtOnce), from[i], from[next],
                                   next_last ? none : from[next_last ? next : next + 1]);
    uint16_t* const current = pixel.current + i * kAtOnce;
    uint16_t* const sum = pixel.sum + i * kAtOnce;
    if (first_last) {
      store_last(current, a, beyond);
      add_last(sum, a, beyond);
    } else {
      const uint16x8_t sums[2] = {vld1q_u16(sum), vld1q_u16(sum + kAtOnce)};
      const uint16x8_t kept = next_last ? vbslq_u16(beyond, vld1q_u16(current + kAtOnce), b) : b;
      const uint16x8_t added = vqaddq_u16(sums[1], b);
      vst1q_u16(sum, vqaddq_u16(sums[0], a));
      vst1q_u16(sum + kAtOnce, next_last ? vbslq_u16(beyond, sums[1], added) : added);
      vst1q_u16(current, a);
      vst1q_u16(current + kAtOnce, kept);
    }
  }
}

inline uint16_t least_path(const uint16_t* path, int32_t last, uint16x8_t beyond) {
  uint16x8_t least = vorrq_u16(vld1q_u16(path + last), beyond);
  for (int32_t level = 0; level < last; level += kAtOnce) least = vminq_u16(least, vld1q_u16(path + level));
  return least16(least);
}

template <>
BSM_INLINE void continue_path<0>(const Pixel& pixel, Penalties penalties, int32_t last, uint16x8_t beyond) {
  const Step step = make_step(least_path(pixel.previous, last, beyond), penalties);
  const uint16x8_t end = vorrq_u16(vld1q_u16(pixel.previous + last), beyond);
  uint16x8_t before = vdupq_n_u16(kNoCost);
  uint16x8_t same = last == 0 ? end : vld1q_u16(pixel.previous);
  for (int32_t level = 0; level < last; level += kAtOnce) {
    const uint16x8_t after = level + kAtOnce == last ? end : vld1q_u16(pixel.previous + level + kAtOnce);
    const uint16x8_t path = next_path(step, vld1q_u16(pixel.cost + level), before, same, after);
    vst1q_u16(pixel.current + level, path);
    add_path(pixel.sum + level, path);
    before = same;
    same = after;
  }
  const uint16x8_t path = next_path(step, vld1q_u16(pixel.cost + last), before, same, vdupq_n_u16(kNoCost));
  store_last(pixel.current + last, path, beyond);
  add_last(pixel.sum + last, path, beyond);
}

// Pixels begin..end-1, whose predecessors lie in the row. With current == previous, a diagonal reads its predecessor before
// it is overwritten.
template <int32_t kVectors>
void continue_paths(const AggregateAcrossArgs& args, int32_t begin, int32_t end, int32_t last, uint16x8_t beyond) {
  const bool back = args.dx > 0;
  const int32_t x = back ? end - 1 : begin;
  const ptrdiff_t at = ptrdiff_t{x} * args.stride;
  const ptrdiff_t advance = back ? -ptrdiff_t{args.stride} : ptrdiff_t{args.stride};
  const uint8_t* edge = args.edge + x;
  const Penalties penalties[2] = {args.penalties[0], args.penalties[1]};
  Pixel pixel{args.cost + at, args.previous + (at - ptrdiff_t{args.dx} * args.stride), args.current + at, args.sum + at};
  for (int32_t left = end - begin; left > 0; --left) {
    continue_path<kVectors>(pixel, penalties[*edge], last, beyond);
    edge += back ? -1 : 1;
    pixel.cost += advance;
    pixel.previous += advance;
    pixel.current += advance;
    pixel.sum += advance;
  }
}

template <int32_t kVectors>
void aggregate_pixels(const AggregateAcrossArgs& args) {
  const int32_t last = (args.num_disparities - 1) / kAtOnce * kAtOnce;
  const uint16x8_t beyond = beyond_last(args.num_disparities);
  // The pixels with a predecessor, of which all but one at an end of the row are.
  const int32_t first_inside = args.dx > 0 ? args.dx : 0;
  const int32_t end_inside = args.previous == nullptr ? first_inside : args.width + (args.dx < 0 ? args.dx : 0);
  const int32_t begin = args.begin < first_inside ? first_inside : args.begin;
  const int32_t end = args.end < end_inside ? args.end : end_inside;
  if (begin < end) continue_paths<kVectors>(args, begin, end, last, beyond);
  for (int32_t x = args.begin; x < args.end; ++x) {
    if (begin <= x && x < end) x = end;
    if (x == args.end) break;
    const ptrdiff_t at = ptrdiff_t{x} * args.stride;
    begin_path(args.cost + at, last, beyond, args.current + at, args.sum + at);
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
