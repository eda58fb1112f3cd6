// 3x3 median by sorted columns.
#include "core/median.h"

namespace bsm {
namespace {

constexpr int32_t kAtOnce = 32;  // pixels whose columns are sorted before their medians are taken; compilers vectorise both

uint16_t least(uint16_t a, uint16_t b) {
  return a < b ? a : b;
}
uint16_t most(uint16_t a, uint16_t b) {
  return a < b ? b : a;
}

uint16_t median(uint16_t a, uint16_t b, uint16_t c) {
  return most(least(a, b), least(most(a, b), c));
}

// Columns of the pixels and of one more on both sides.
struct SortedColumns {
  uint16_t low[kAtOnce + 2], middle[kAtOnce + 2], high[kAtOnce + 2];

  void sort(int32_t i, uint16_t a, uint16_t b, uint16_t c) {
    low[i] = least(least(a, b), c);
    middle[i] = median(a, b, c);
    high[i] = most(most(a, b), c);
  }
};

}  // namespace

// The median of nine is the median of: the largest of the columns' least, the median of their medians, and the least of
// their largest.
void median_3x3(const uint16_t* const rows[3], int32_t width, uint16_t* out) {
  SortedColumns columns;
  for (int32_t x = 0; x < width; x += kAtOnce) {
    const int32_t count = width - x < kAtOnce ? width - x : kAtOnce;
    const int32_t before = x == 0 ? 0 : x - 1;
    const int32_t after = x + count == width ? width - 1 : x + count;
    const uint16_t* above = rows[0] + x;
    const uint16_t* center = rows[1] + x;
    const uint16_t* below = rows[2] + x;
    for (int32_t i = 0; i < count; ++i) columns.sort(i + 1, above[i], center[i], below[i]);
    columns.sort(0, rows[0][before], rows[1][before], rows[2][before]);
    columns.sort(count + 1, rows[0][after], rows[1][after], rows[2][after]);
    for (int32_t i = 0; i < count; ++i) {
      out[x + i] = median(most(most(columns.low[i], columns.low[i + 1]), columns.low[i + 2]),
                          median(columns.middle[i], columns.middle[i + 1], columns.middle[i + 2]),
                          least(least(columns.high[i], columns.high[i + 1]), columns.high[i + 2]));
    }
  }
}

}  // namespace bsm
