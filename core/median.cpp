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

  void sort(int32_t i, const uint16_t* const rows[3], int32_t x) {
    const uint16_t a = rows[0][x];
    const uint16_t b = rows[1][x];
    const uint16_t c = rows[2][x];
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
    const int32_t beside[2] = {x == 0 ? 0 : x - 1, x + count == width ? width - 1 : x + count};
    for (int32_t i = 0; i < count; ++i) columns.sort(i + 1, rows, x + i);
    for (int32_t side = 0; side < 2; ++side) columns.sort(side * (count + 1), rows, beside[side]);
    for (int32_t i = 0; i < count; ++i) {
      out[x + i] = median(most(most(columns.low[i], columns.low[i + 1]), columns.low[i + 2]),
                          median(columns.middle[i], columns.middle[i + 1], columns.middle[i + 2]),
                          least(least(columns.high[i], columns.high[i + 1]), columns.high[i + 2]));
    }
  }
}

}  // namespace bsm
