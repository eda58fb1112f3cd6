// aggregate_along, NEON: eight levels at once. The path of up to 64 levels stays in registers, a longer one in the scratch.
// Where costs and penalties are small, sixteen levels at once in bytes.
// Bound, per eight levels: 9 operations one way, 10 back; 1 and 2 loads, 1 store each. In bytes, per sixteen levels: 10
// operations one way, 12 back; 2 and 3 loads, 1 and 2 stores.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "simd/arm/aggregate_bytes.h"
#include "simd/arm/aggregate_step.h"

namespace bsm {
namespace {

// Stores the sum of one direction, or adds the other one.
template <bool kAdd>
inline void put(uint16_t* sum, uint16x8_t path) {
  vst1q_u16(sum, kAdd ? vqaddq_u16(vld1q_u16(sum), path) : path);
}

template <bool kAdd>
inline void put_last(uint16_t* sum, uint16x8_t path, uint16x8_t beyond) {
  const uint16x8_t old = vld1q_u16(sum);
  vst1q_u16(sum, vbslq_u16(beyond, old, kAdd ? vqaddq_u16(old, path) : path));
}

// A direction of rows whose pixels have kVectors vectors of levels.
template <int32_t kVectors, bool kBack>
void aggregate_short(const AggregateAlongArgs& args) {
  const uint16x8_t none = vdupq_n_u16(kNoCost);
  const uint16x8_t beyond = beyond_last(args.num_disparities);
  const ptrdiff_t advance = kBack ? -ptrdiff_t{args.stride} : ptrdiff_t{args.stride};
  const ptrdiff_t first = kBack ? ptrdiff_t{args.width - 1} * args.stride : 0;
  const uint8_t* edge = kBack ? args.edge + args.width - 1 : args.edge + 1;  // between the first pixel and the second
  const uint16_t* cost = args.cost + first;
  uint16_t* sum = args.sum + first;
  uint16x8_t path[kVectors];
  // Before the first pixel: a predecessor whose levels all cost nothing adds nothing.
  BSM_UNROLL
  for (int32_t i = 0; i < kVectors; ++i) path[i] = vdupq_n_u16(0);
  Step step{path[0], path[0], path[0]};
  for (int32_t left = args.width; left > 0; --left) {
    uint16x8_t before = none;
    uint16x8_t least = none;
    BSM_UNROLL
    for (int32_t i = 0; i < kVectors; ++i) {
      const bool last = i == kVectors - 1;
      const uint16x8_t after = last ? none : path[last ? i : i + 1];
      uint16x8_t value = next_path(step, vld1q_u16(cost + i * kAtOnce), before, path[i], after);
      before = path[i];
      if (last) {
        value = vorrq_u16(value, beyond);
        put_last<kBack>(sum + i * kAtOnce, value, beyond);
      } else {
        put<kBack>(sum + i * kAtOnce, value);
      }
      path[i] = value;
      least = i == 0 ? value : vminq_u16(least, value);
    }
    if (left == 1) break;
    step = make_step(least16(least), args.penalties[*edge]);
    edge += kBack ? -1 : 1;
    cost += advance;
    sum += advance;
  }
}

// A direction in bytes: rows whose pixels have kVectors vectors of sixteen levels. The paths from the left wait, in bytes,
// in the first half of each pixel's sums.
template <int32_t kVectors, bool kBack>
void aggregate_bytes(const AggregateAlongArgs& args) {
  const uint8x16_t none = vdupq_n_u8(0xff);
  const uint16x8_t beyond = beyond_last(args.num_disparities);
  const uint8x16_t inside = vmvnq_u8(vcombine_u8(vdup_n_u8(0), vmovn_u16(beyond)));
  const ByteSteps steps(args.penalties);
  const ptrdiff_t advance = kBack ? -ptrdiff_t{args.stride} : ptrdiff_t{args.stride};
  const ptrdiff_t first = kBack ? ptrdiff_t{args.width - 1} * args.stride : 0;
  const uint8_t* edge = kBack ? args.edge + args.width - 1 : args.edge + 1;  // between the first pixel and the second
  const uint16_t* cost = args.cost + first;
  uint16_t* sum = args.sum + first;
  uint8x16_t path[kVectors];
  BSM_UNROLL
  for (int32_t i = 0; i < kVectors; ++i) path[i] = vdupq_n_u8(0);
  ByteStep step{path[0], path[0], path[0]};
  for (int32_t left = args.width; left > 0; --left) {
    uint8x16_t before = none;
    uint8x16_t least = none;
    uint8x16_t most = path[0];
    BSM_UNROLL
    for (int32_t i = 0; i < kVectors; ++i) {
      const bool last = i == kVectors - 1;
      const uint8x16_t after = last ? none : path[last ? i : i + 1];
      const uint8x16_t value = next_path(step, load_costs(cost + 2 * i * kAtOnce), before, path[i], after);
      before = path[i];
      path[i] = value;
      least = i == 0 ? value : vminq_u8(least, value);
      const uint8x16_t levels = last ? vandq_u8(value, inside) : value;
      most = i == 0 ? levels : vmaxq_u8(most, levels);
    }
    uint8_t* const bytes = reinterpret_cast<uint8_t*>(sum);
    if (kBack) {
      add_bytes<kVectors>(path, bytes, beyond, sum);
      if (most8(most) == 0xff) mark_missing<kVectors>(beyond, sum);
    } else {
      BSM_UNROLL
      for (int32_t i = 0; i < kVectors; ++i) vst1q_u8(bytes + 2 * i * kAtOnce, path[i]);
    }
    if (left == 1) break;
    step = steps.next(least, *edge);
    edge += kBack ? -1 : 1;
    cost += advance;
    sum += advance;
  }
}

template <int32_t kVectors>
void aggregate_both(const AggregateAlongArgs& args) {
  if constexpr (kVectors % 2 == 0) {
    if (fits_bytes(args.most_cost, args.penalties)) {
      aggregate_bytes<kVectors / 2, false>(args);
      aggregate_bytes<kVectors / 2, true>(args);
      return;
    }
  }
  aggregate_short<kVectors, false>(args);
  aggregate_short<kVectors, true>(args);
}

// The first pixel of a direction; returns the least of its path.
template <bool kAdd>
uint16_t begin_path(const uint16_t* cost, int32_t last, uint16x8_t beyond, uint16_t* path, uint16_t* sum) {
  uint16x8_t least = vdupq_n_u16(kNoCost);
  for (int32_t level = 0; level < last; level += kAtOnce) {
    const uint16x8_t value = vld1q_u16(cost + level);
    vst1q_u16(path + level, value);
    put<kAdd>(sum + level, value);
    least = vminq_u16(least, value);
  }
  const uint16x8_t value = vorrq_u16(vld1q_u16(cost + last), beyond);
  vst1q_u16(path + last, value);
  put_last<kAdd>(sum + last, value, beyond);
  return least16(vminq_u16(least, value));
}

// The next pixel of a direction; returns the least of its path.
template <bool kAdd>
uint16_t continue_path(const uint16_t* cost, const Step& step, int32_t last, uint16x8_t beyond, uint16_t* path,
                       uint16_t* sum) {
  uint16x8_t least = vdupq_n_u16(kNoCost);
  uint16x8_t before = least;
  uint16x8_t same = vld1q_u16(path);
  for (int32_t level = 0; level < last; level += kAtOnce) {
    const uint16x8_t after = vld1q_u16(path + level + kAtOnce);
    const uint16x8_t value = next_path(step, vld1q_u16(cost + level), before, same, after);
    vst1q_u16(path + level, value);
    put<kAdd>(sum + level, value);
    least = vminq_u16(least, value);
    before = same;
    same = after;
  }
  const uint16x8_t value = vorrq_u16(next_path(step, vld1q_u16(cost + last), before, same, vdupq_n_u16(kNoCost)), beyond);
  vst1q_u16(path + last, value);
  put_last<kAdd>(sum + last, value, beyond);
  return least16(vminq_u16(least, value));
}

void aggregate_long(const AggregateAlongArgs& args) {
  const int32_t last = (args.num_disparities - 1) / kAtOnce * kAtOnce;
  const uint16x8_t beyond = beyond_last(args.num_disparities);
  uint16_t* path = static_cast<uint16_t*>(args.scratch);
  uint16_t least = begin_path<false>(args.cost, last, beyond, path, args.sum);
  for (int32_t x = 1; x < args.width; ++x) {
    const ptrdiff_t at = ptrdiff_t{x} * args.stride;
    const Step step = make_step(least, args.penalties[args.edge[x]]);
    least = continue_path<false>(args.cost + at, step, last, beyond, path, args.sum + at);
  }
  ptrdiff_t at = ptrdiff_t{args.width - 1} * args.stride;
  least = begin_path<true>(args.cost + at, last, beyond, path, args.sum + at);
  for (int32_t x = args.width - 2; x >= 0; --x) {
    at -= args.stride;
    const Step step = make_step(least, args.penalties[args.edge[x + 1]]);
    least = continue_path<true>(args.cost + at, step, last, beyond, path, args.sum + at);
  }
}

}  // namespace

uint64_t aggregate_along_neon_scratch(const KernelShape& shape) {
  return sizeof(uint16_t) * ((static_cast<uint64_t>(shape.num_disparities) + kAtOnce - 1) / kAtOnce * kAtOnce);
}

void aggregate_along_neon(const AggregateAlongArgs& args) {
  switch ((args.num_disparities + kAtOnce - 1) / kAtOnce) {
    case 1:
      return aggregate_both<1>(args);
    case 2:
      return aggregate_both<2>(args);
    case 3:
      return aggregate_both<3>(args);
    case 4:
      return aggregate_both<4>(args);
    case 5:
      return aggregate_both<5>(args);
    case 6:
      return aggregate_both<6>(args);
    case 7:
      return aggregate_both<7>(args);
    case 8:
      return aggregate_both<8>(args);
    default:
      return aggregate_long(args);
  }
}

}  // namespace bsm
#endif
