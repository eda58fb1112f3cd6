// The stages of core/ and their plain forms.
#include "bench/plain_stages.h"

#include <algorithm>

#include "core/holes.h"
#include "core/median.h"
#include "core/speckle.h"
#include "simd/kernels.h"

namespace bsm::bench {

void run_stage(const RemoveSpecklesArgs& args) {
  remove_speckles(args.rows, args.width, args.percent, args.out);
}

void run_stage(const FillHolesArgs& args) {
  std::copy_n(args.voted, args.width, args.out);
  fill_holes(args.checked, args.above, args.width, args.out);
}

void run_stage(const MedianArgs& args) {
  median_3x3(args.rows, args.width, args.out);
}

void speckles_of_all_neighbours(const RemoveSpecklesArgs& args) {
  constexpr int32_t kSameSurface = 24;  // sixteenths
  const uint16_t* levels = args.rows[kSpeckleRadius];
  for (int32_t x = 0; x < args.width; ++x) {
    args.out[x] = levels[x];
    if (levels[x] >= kOccluded) continue;
    int32_t asked = 0;
    int32_t supporting = 0;
    for (int32_t row = 0; row <= 2 * kSpeckleRadius; row += 2) {
      if (args.rows[row] == nullptr) continue;
      for (int32_t i = x - kSpeckleRadius; i <= x + kSpeckleRadius; i += 2) {
        if (i < 0 || i >= args.width) continue;
        const int32_t difference = args.rows[row][i] - levels[x];
        ++asked;
        supporting += args.rows[row][i] < kOccluded && -kSameSurface <= difference && difference <= kSameSurface ? 1 : 0;
      }
    }
    if (100 * supporting < args.percent * asked) args.out[x] = kNoLevel;
  }
}

void fill_by_pixel(const FillHolesArgs& args) {
  std::copy_n(args.voted, args.width, args.out);
  for (int32_t x = 0; x < args.width; ++x) {
    if (args.out[x] != kNoLevel) continue;
    int32_t before = x;
    while (before >= 0 && args.checked[before] >= kOccluded) --before;
    int32_t after = x;
    while (after < args.width && args.checked[after] >= kOccluded) ++after;
    if (before >= 0 && (after == args.width || x - before <= after - x)) {
      args.out[x] = static_cast<uint16_t>(whole_level(args.checked[before]) << kLevelShift);
    } else if (after < args.width) {
      args.out[x] = static_cast<uint16_t>(whole_level(args.checked[after]) << kLevelShift);
    } else {
      args.out[x] = args.above != nullptr ? args.above[x] : uint16_t{0};
    }
  }
}

void median_by_sorting_nine(const MedianArgs& args) {
  for (int32_t x = 0; x < args.width; ++x) {
    uint16_t nine[9];
    uint16_t* next = nine;
    for (const uint16_t* row : args.rows) {
      for (int32_t i = x - 1; i <= x + 1; ++i) *next++ = row[std::clamp(i, 0, args.width - 1)];
    }
    std::nth_element(nine, nine + 4, nine + 9);
    args.out[x] = nine[4];
  }
}

}  // namespace bsm::bench
