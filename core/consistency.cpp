// Left/right check of one row.
#include "core/consistency.h"

#include "platform/compiler.h"

namespace bsm {
namespace {

// The pixel of the other view that pixel x of `view` with this level shows.
int32_t matched_pixel(const Winners& winners, View view, int32_t x, uint16_t level) {
  const int32_t disparity = winners.min_disparity + whole_level(level);
  return view == kLeft ? x - disparity : x + disparity;
}

}  // namespace

void copy_levels(const Winners& winners, View view, uint16_t* out) {
  BSM_MEMCPY(out, winners.level[view], static_cast<size_t>(winners.width) * sizeof *out);
}

void check_levels(const Winners& winners, View view, int32_t tolerance, uint16_t* out) {
  const View other = view == kLeft ? kRight : kLeft;
  const uint16_t* levels = winners.level[view];
  const uint16_t* others = winners.level[other];
  for (int32_t x = 0; x < winners.width; ++x) out[x] = kOccluded;
  // A winner is a candidate: the pixel it points at lies in the row and has a winner as well.
  for (int32_t x = 0; x < winners.width; ++x) {
    if (others[x] != kNoLevel) out[matched_pixel(winners, other, x, others[x])] = kNoLevel;
  }
  for (int32_t x = 0; x < winners.width; ++x) {
    if (levels[x] == kNoLevel) continue;
    const uint16_t back = others[matched_pixel(winners, view, x, levels[x])];
    const int32_t difference = whole_level(back) - whole_level(levels[x]);
    const bool same = -tolerance <= difference && difference <= tolerance;
    out[x] = same ? levels[x] : out[x];  // without a branch: nobody can foretell it
  }
}

}  // namespace bsm
