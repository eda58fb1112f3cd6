// Walks along a row from one run of pixels without a level to the next: all pixels of a run share their nearest valid ones.
#include "core/holes.h"

#include "platform/compiler.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kSurfaceStep = 24;  // sixteenths between two surfaces

// The first valid pixel from x on; width when there is none.
int32_t next_valid(const uint16_t* levels, int32_t x, int32_t width) {
  while (x < width && levels[x] >= kOccluded) ++x;
  return x;
}

// The last valid pixel before x; -1 when there is none.
int32_t last_valid(const uint16_t* levels, int32_t x) {
  do --x;
  while (x >= 0 && levels[x] >= kOccluded);
  return x;
}

}  // namespace

void fill_holes(const uint16_t* checked, const uint16_t* above, int32_t width, uint16_t* voted) {
  for (int32_t x = 0; x < width; ++x) {
    if (voted[x] != kNoLevel) continue;
    const int32_t before = last_valid(checked, x);
    const int32_t after = next_valid(checked, x, width);
    for (; x < after; ++x) {
      if (voted[x] != kNoLevel) continue;
      if (before >= 0 && (after == width || x - before <= after - x)) {
        voted[x] = static_cast<uint16_t>(whole_level(checked[before]) << kLevelShift);
      } else if (after < width) {
        voted[x] = static_cast<uint16_t>(whole_level(checked[after]) << kLevelShift);
      } else {
        voted[x] = above != nullptr ? above[x] : uint16_t{0};
      }
    }
  }
}

void cap_occlusions(const uint16_t* checked, int32_t width, uint16_t* cap) {
  BSM_MEMSET(cap, 0xff, static_cast<size_t>(width) * sizeof *cap);
  for (int32_t x = 0; x < width; ++x) {
    if (checked[x] < kOccluded) continue;
    const int32_t begin = x;
    x = next_valid(checked, x, width);
    if (begin == 0 || x == width) continue;
    const int32_t before = checked[begin - 1];
    const int32_t after = checked[x];
    const int32_t lower = before < after ? before : after;
    if (before + after - 2 * lower <= kSurfaceStep) continue;
    for (int32_t i = begin; i < x; ++i) {
      if (checked[i] == kOccluded) cap[i] = static_cast<uint16_t>((lower + kSurfaceStep) >> kLevelShift);
    }
  }
}

}  // namespace bsm
