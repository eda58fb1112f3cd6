// fraction_smooth for AVX2 and SSE4.2: a vector of 16-bit levels at once; pixels whose neighbourhood crosses the row's ends
// one by one. Bound, per tap of 25: 2 loads, 8 operations. Include after the lanes of one instruction set.
#ifndef BSM_SIMD_X86_FRACTION_SMOOTH_LANES_H
#define BSM_SIMD_X86_FRACTION_SMOOTH_LANES_H

#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kAtOnce = kLanes / 2;
constexpr int32_t kSameSurface = 16;  // sixteenths
constexpr int32_t kRows = 2 * kFractionRadius + 1;

// r(w) of a sum of weights, at most 50: the bytes of 64 values.
struct Reciprocals {
  alignas(32) uint8_t low[64];
  alignas(32) uint8_t high[64];

  constexpr Reciprocals() : low(), high() {
    for (int32_t w = 1; w < 64; ++w) {
      const int32_t r = w == 1 ? 32767 : (32768 + w / 2) / w;
      low[w] = static_cast<uint8_t>(r & 0xff);
      high[w] = static_cast<uint8_t>(r >> 8);
    }
  }
};
constexpr Reciprocals kReciprocals{};

// r(w) in 16 bits. An index outside a piece of 16 entries gets its top bit set, which looks up 0.
inline Bytes reciprocal(Bytes weight) {
  const Bytes range = set8(0x70);
  const Bytes odd_bytes = set16(0xff00);
  Bytes index = either(weight, left16<8>(weight));  // once for each byte
  Bytes value = zero();
  BSM_UNROLL
  for (int32_t i = 0; i < 4; ++i) {
    const Bytes place = add8_saturated(index, range);
    const Bytes low = look_up(table16(kReciprocals.low + 16 * i), place);
    const Bytes high = look_up(table16(kReciprocals.high + 16 * i), place);
    value = either(value, choose(low, high, odd_bytes));
    index = sub8(index, set8(16));
  }
  return value;
}

inline Bytes smooth_at(const FractionSmoothArgs& args, int32_t x) {
  const Bytes own = load(args.levels[kFractionRadius] + x);
  const Bytes to_first = sub16(own, set16(kSameSurface));
  const Bytes span = set16(2 * kSameSurface);
  Bytes difference = zero();
  Bytes weight = zero();
  for (int32_t row = 0; row < kRows; ++row) {
    const uint16_t* levels = args.levels[row];
    if (levels == nullptr) continue;
    const uint8_t* weights = args.weights[row];
    BSM_UNROLL
    for (int32_t dx = -kFractionRadius; dx <= kFractionRadius; ++dx) {
      // Within the surface when step + 16, without a sign, is at most 32: steps wrap around only between levels near 0 and
      // near 65536, and a level is at most 4093 * 16 + 15.
      const Bytes level = load(levels + x + dx);
      const Bytes from_first = sub16(level, to_first);
      const Bytes near = equal16(max16(from_first, span), span);
      const Bytes kept = both(widen(weights + x + dx), near);
      difference = add16(difference, multiply16_low(sub16(level, own), kept));
      weight = add16(weight, kept);
    }
  }
  return add16(own, multiply16_rounded(difference, reciprocal(weight)));
}

// One pixel anywhere in the row.
inline uint16_t smooth_one(const FractionSmoothArgs& args, int32_t x) {
  const int32_t own = args.levels[kFractionRadius][x];
  int32_t difference = 0;
  int32_t weight = 0;
  for (int32_t row = 0; row < kRows; ++row) {
    if (args.levels[row] == nullptr) continue;
    for (int32_t i = x - kFractionRadius; i <= x + kFractionRadius; ++i) {
      if (i < 0 || i >= args.width) continue;
      const int32_t step = args.levels[row][i] - own;
      if (step < -kSameSurface || step > kSameSurface) continue;
      difference += args.weights[row][i] * step;
      weight += args.weights[row][i];
    }
  }
  const int32_t r = kReciprocals.low[weight] | kReciprocals.high[weight] << 8;
  return static_cast<uint16_t>(own + ((difference * r + (1 << 14)) >> 15));
}

inline void smooth_fractions(const FractionSmoothArgs& args) {
  const int32_t end = args.width - kFractionRadius;
  int32_t x = 0;
  if (end - kFractionRadius >= kAtOnce) {
    for (; x < kFractionRadius; ++x) args.out[x] = smooth_one(args, x);
    for (; x + kAtOnce < end; x += kAtOnce) store(args.out + x, smooth_at(args, x));
    store(args.out + end - kAtOnce, smooth_at(args, end - kAtOnce));
    x = end;
  }
  for (; x < args.width; ++x) args.out[x] = smooth_one(args, x);
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_FRACTION_SMOOTH_LANES_H
