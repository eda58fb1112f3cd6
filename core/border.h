// The band along the border that the other view does not show: each row's surface is continued to the edge by its slope.
//
// A row's surface begins at the first valid pixel that at least three of the four pixels from it on agree with, within
// 24/16. Its fit is the line through the valid pixels of the next 24 up to the first step of more than 24/16. The slope is
// shared with the rows around it whose mean level lies within 32/16, and stays within 1.5/16 a pixel. Pixels before the
// surface, valid or not, are overwritten. Rows of the right view run backwards, so that one code serves the left band and
// the right band.
#ifndef BSM_CORE_BORDER_H
#define BSM_CORE_BORDER_H

#include <stdint.h>

namespace bsm {

constexpr int32_t kBorderRadius = 16;  // rows above and below whose slopes are shared

// The line through the first surface of a row. Positions count from the row's border inwards.
struct BorderFit {
  int32_t first;     // position of the first pixel of the surface; -1: the row has none
  int32_t position;  // mean position, in 1/256 pixel
  int32_t level;     // mean level, in 1/256 of 1/16 pixel
  int32_t spread;    // 64 sum (position - mean)^2
  int32_t slant;     // 64 sum (position - mean) (level - mean), in 1/16 pixel
};

// A row of a checked map, seen from the border of its view.
struct BorderRow {
  uint16_t* first;    // the pixel at the border
  int32_t direction;  // 1: the row continues to the right of it (left view); -1: to the left
  int32_t width;
};

// Fits a line to the first surface that begins before `reach` pixels from the border.
BorderFit fit_border(const BorderRow& row, int32_t reach);

// Continues the fitted surface from its first pixel to the border. `fits` are those of the rows y - kBorderRadius ..
// y + kBorderRadius, nullptr outside the image; levels stay within 0..most.
void continue_border(const BorderRow& row, const BorderFit* const* fits, int32_t most);

}  // namespace bsm

#endif  // BSM_CORE_BORDER_H
