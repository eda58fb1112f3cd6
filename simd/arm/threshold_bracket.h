// The search for sixteen thresholds at once: a pass tries eight, the next one those between two of them.
#ifndef BSM_SIMD_ARM_THRESHOLD_BRACKET_H
#define BSM_SIMD_ARM_THRESHOLD_BRACKET_H

#include "simd/arm/neon.h"

namespace bsm {
namespace {

// Bit j of within[d]: the difference d is within limit j, in the unit of a pass.
struct Limits {
  uint8_t within[16];
};

constexpr Limits make_limits(const int32_t (&limits)[8]) {
  Limits table{};
  for (int32_t d = 0; d < 16; ++d) {
    for (int32_t j = 0; j < 8; ++j) {
      if (d <= limits[j]) table.within[d] = static_cast<uint8_t>(table.within[d] | 1 << j);
    }
  }
  return table;
}

constexpr int32_t kFirstShift = 2;  // the unit of the first pass, which begins at 0: 4
constexpr Limits kFirst = make_limits({0, 1, 2, 3, 4, 6, 8, 12});
constexpr Limits kEvery = make_limits({0, 1, 2, 3, 4, 5, 6, 7});
constexpr Limits kEverySecond = make_limits({1, 3, 5, 7, 9, 11, 13, 15});
alignas(16) constexpr uint8_t kFirstLow[16] = {0, 4, 8, 12, 16, 20, 28, 36, 52};
alignas(16) constexpr uint8_t kFirstHigh[16] = {3, 7, 11, 15, 19, 27, 35, 51, 255};

struct Bracket {
  uint8x16_t low, high;  // a threshold is within, both included
};

// How many of the eight limits are too low; bit j of `passed`: limit j is not.
inline uint8x16_t count_failed(uint8x16_t passed) {
  return vsubq_u8(vdupq_n_u8(8), vcntq_u8(passed));
}

inline Bracket first_bracket(uint8x16_t passed) {
  const uint8x16_t failed = count_failed(passed);
  return Bracket{look_up(load_table16(kFirstLow), failed), look_up(load_table16(kFirstHigh), failed)};
}

// What a pass in units of 1 << kShift above `low` leaves of a bracket: limits 1, 4 or, every second of 16, 32 apart.
template <int32_t kShift>
inline void narrow(uint8x16_t passed, Bracket& bracket) {
  const uint8x16_t failed = count_failed(passed);
  uint8x16_t rise = failed;
  if (kShift == 2) rise = vshlq_n_u8(failed, 2);
  if (kShift == 4) rise = vshlq_n_u8(vminq_u8(failed, vdupq_n_u8(7)), 5);  // the last limit is above every SAD
  constexpr uint8_t kStep = kShift == 4 ? 32 : 1 << kShift;
  bracket.low = vqaddq_u8(bracket.low, rise);
  const uint8x16_t top = vminq_u8(bracket.high, vqaddq_u8(bracket.low, vdupq_n_u8(kStep - 1)));
  bracket.high = vbslq_u8(vceqq_u8(failed, vdupq_n_u8(8)), bracket.high, top);
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_THRESHOLD_BRACKET_H
