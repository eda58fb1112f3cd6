// 3x3 median by sorted columns.
#include "core/median.h"

namespace bsm {
namespace {

struct Sorted3 {
  uint16_t low, middle, high;
};

uint16_t least(uint16_t a, uint16_t b) {
  return a < b ? a : b;
}
uint16_t most(uint16_t a, uint16_t b) {
  return a < b ? b : a;
}

uint16_t median(uint16_t a, uint16_t b, uint16_t c) {
  return most(least(a, b), least(most(a, b), c));
}

Sorted3 sort_column(const uint16_t* const rows[3], int32_t x) {
  const uint16_t a = rows[0][x];
  const uint16_t b = rows[1][x];
  const uint16_t c = rows[2][x];
  return Sorted3{least(least(a, b), c), median(a, b, c), most(most(a, b), c)};
}

}  // namespace

// The median of nine is the median of: the largest of the columns' least, the median of their medians, and the least of
// their largest. Columns are sorted once and slide along the row.
void median_3x3(const uint16_t* const rows[3], int32_t width, uint16_t* out) {
  Sorted3 left = sort_column(rows, 0);
  Sorted3 center = left;
  for (int32_t x = 0; x < width; ++x) {
    const Sorted3 right = x + 1 < width ? sort_column(rows, x + 1) : center;
    out[x] = median(most(most(left.low, center.low), right.low), median(left.middle, center.middle, right.middle),
                    least(least(left.high, center.high), right.high));
    left = center;
    center = right;
  }
}

}  // namespace bsm
