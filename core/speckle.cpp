// Speckle filter of one row.
#include "core/speckle.h"

#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kSameSurface = 24;  // sixteenths

bool is_supported(const uint16_t* const* rows, int32_t x, int32_t width, int32_t percent) {
  const int32_t level = rows[kSpeckleRadius][x];
  int32_t asked = 0;
  int32_t supporting = 0;
  for (int32_t row = 0; row <= 2 * kSpeckleRadius; row += 2) {
    if (rows[row] == nullptr) continue;
    for (int32_t i = x - kSpeckleRadius; i <= x + kSpeckleRadius; i += 2) {
      if (i < 0 || i >= width) continue;
      ++asked;
      const int32_t difference = rows[row][i] - level;
      if (rows[row][i] < kOccluded && -kSameSurface <= difference && difference <= kSameSurface) ++supporting;
    }
  }
  return 100 * supporting >= percent * asked;
}

}  // namespace

void remove_speckles(const uint16_t* const* rows, int32_t width, int32_t percent, uint16_t* out) {
  const uint16_t* levels = rows[kSpeckleRadius];
  for (int32_t x = 0; x < width; ++x) {
    const bool removed = levels[x] < kOccluded && !is_supported(rows, x, width, percent);
    out[x] = removed ? kNoLevel : levels[x];
  }
}

}  // namespace bsm
