// Fits and continues the surfaces at the border.
#include "core/border.h"

#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kSpan = 24;                  // pixels that a fit looks at
constexpr int32_t kJump = 24;                  // a step of more sixteenths ends the surface
constexpr int32_t kSameSurface = 32;           // rows whose mean levels differ by more sixteenths show another surface
constexpr int32_t kProbe = 4;                  // a surface begins where most of this many pixels agree
constexpr int32_t kMostSlope = (3 << 16) / 2;  // sixteenths per pixel, in 2^-16

int32_t level_at(const BorderRow& row, int32_t position) {
  return row.first[position * row.direction];
}

bool is_valid(int32_t level) {
  return level < kOccluded;
}

int32_t magnitude(int32_t value) {
  return value < 0 ? -value : value;
}

// True when the pixel is valid and at least three of the four from it on are near its level.
bool begins_surface(const BorderRow& row, int32_t position) {
  const int32_t level = level_at(row, position);
  if (!is_valid(level)) return false;
  int32_t agreeing = 0;
  for (int32_t i = position; i < position + kProbe && i < row.width; ++i) {
    const int32_t other = level_at(row, i);
    if (is_valid(other) && magnitude(other - level) <= kJump) ++agreeing;
  }
  return agreeing >= kProbe - 1;
}

// Rounded to the nearest for a positive divisor.
int32_t divide(int32_t value, int32_t divisor) {
  const int32_t half = divisor / 2;
  return (value < 0 ? value - half : value + half) / divisor;
}

// slant / spread in 2^-16, truncated toward zero and kept within kMostSlope; 0 for 0 / 0. Bit by bit: small machines have no
// division of 64 bits. The spread stays below 2^24, so that twice a rest fits.
int32_t slope_of(int32_t slant, int32_t spread) {
  int32_t rest = magnitude(slant);
  if (rest >= 2 * spread) return slant == 0 ? 0 : slant < 0 ? -kMostSlope : kMostSlope;
  int32_t quotient = 0;
  for (int32_t bit = 1 << 16; bit != 0; bit /= 2, rest *= 2) {
    if (rest < spread) continue;
    quotient += bit;
    rest -= spread;
  }
  quotient = quotient < kMostSlope ? quotient : kMostSlope;
  return slant < 0 ? -quotient : quotient;
}

}  // namespace

BorderFit fit_border(const BorderRow& row, int32_t reach) {
  int32_t first = 0;
  const int32_t end = reach < row.width ? reach : row.width;
  while (first < end && !begins_surface(row, first)) ++first;
  if (first == end) return BorderFit{-1, 0, 0, 0, 0};

  // Sums over positions and levels relative to the first pixel: at most 24 positions below 24 and levels within 23 * 24, so
  // that the spread and the slant stay below 2^29 before they are divided.
  const int32_t base = level_at(row, first);
  int32_t count = 0, sum_p = 0, sum_l = 0, sum_pp = 0, sum_pl = 0;
  int32_t last = base;
  for (int32_t p = 0; p < kSpan && first + p < row.width; ++p) {
    const int32_t level = level_at(row, first + p);
    if (!is_valid(level)) continue;
    if (magnitude(level - last) > kJump) break;
    last = level;
    ++count;
    sum_p += p;
    sum_l += level - base;
    sum_pp += p * p;
    sum_pl += p * (level - base);
  }
  BorderFit fit;
  fit.first = first;
  fit.position = first * 256 + divide(256 * sum_p, count);
  fit.level = base * 256 + divide(256 * sum_l, count);
  fit.spread = divide(64 * (count * sum_pp - sum_p * sum_p), count);
  fit.slant = divide(64 * (count * sum_pl - sum_p * sum_l), count);
  return fit;
}

void continue_border(const BorderRow& row, const BorderFit* const* fits, int32_t most) {
  const BorderFit& own = *fits[kBorderRadius];
  if (own.first <= 0) return;
  int32_t spread = 0;
  int32_t slant = 0;
  for (int32_t i = 0; i <= 2 * kBorderRadius; ++i) {
    const BorderFit* fit = fits[i];
    if (fit == nullptr || fit->first < 0 || magnitude(fit->level - own.level) > kSameSurface * 256) continue;
    spread += fit->spread;
    slant += fit->slant;
  }
  const int32_t slope = slope_of(slant, spread);  // in 2^-16
  for (int32_t p = 0; p < own.first; ++p) {
    const int64_t level = int64_t{own.level} * 65536 + int64_t{slope} * (p * 256 - own.position);  // in 2^-24
    const int32_t rounded = static_cast<int32_t>((level + (1 << 23)) >> 24);
    row.first[p * row.direction] = static_cast<uint16_t>(rounded < 0 ? 0 : rounded > most ? most : rounded);
  }
}

}  // namespace bsm
