// Speckle filter of one row.
#include "core/speckle.h"

#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kSameSurface = 24;  // sixteenths

// Whether at least `percent` of the `asked_rows` rows' pixels around x are valid and near its level. Stops when they are
// enough, which the first row often has.
bool is_supported(const uint16_t* const* rows, int32_t asked_rows, int32_t x, int32_t width, int32_t percent) {
  const int32_t level = rows[kSpeckleRadius][x];
  int32_t begin = x - kSpeckleRadius;
  int32_t last = x + kSpeckleRadius;
  while (begin < 0) begin += 2;
  while (last >= width) last -= 2;
  int32_t missing = percent * asked_rows * ((last - begin) / 2 + 1);  // in 1/100 pixel
  for (int32_t row = 0; row <= 2 * kSpeckleRadius; row += 2) {
    if (rows[row] == nullptr) continue;
    for (int32_t i = begin; i <= last; i += 2) {
      const int32_t difference = rows[row][i] - level;
      if (rows[row][i] < kOccluded && -kSameSurface <= difference && difference <= kSameSurface) missing -= 100;
    }
    if (missing <= 0) return true;
  }
  return false;
}

}  // namespace

void remove_speckles(const uint16_t* const* rows, int32_t width, int32_t percent, uint16_t* out) {
  const uint16_t* levels = rows[kSpeckleRadius];
  int32_t asked_rows = 0;
  for (int32_t row = 0; row <= 2 * kSpeckleRadius; row += 2) asked_rows += rows[row] != nullptr ? 1 : 0;
  for (int32_t x = 0; x < width; ++x) {
    const bool removed = levels[x] < kOccluded && !is_supported(rows, asked_rows, x, width, percent);
    out[x] = removed ? kNoLevel : levels[x];
  }
}

}  // namespace bsm
