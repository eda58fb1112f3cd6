// Fixed-point CIELAB: one 8-bit sRGB colour to the library's stored colour, in 32-bit integer arithmetic.
//
// Stored format: three bytes in one unit of 0.8 CIELAB, so that their absolute differences add up (eq. 5):
//   L' = L / 0.8 (0..125), a' = a / 0.8 + 108 (0..231), b' = b / 0.8 + 135 (0..253), D65 white, each rounded.
// Error over all 2^24 colours against double precision: at most 0.516 units, half a unit of it rounding; the rest is the
// table of linear light (17 bits), the matrix (15 bits) and the chord of the cube root. A test measures it.
#ifndef BSM_SIMD_LAB_H
#define BSM_SIMD_LAB_H

#include <stdint.h>

namespace bsm {

struct Lab {
  uint8_t l, a, b;
};

// Linear light of an 8-bit sRGB value, 2^17 - 1 = full.
// clang-format off
constexpr uint32_t kLinearLight[256] = {
    0, 40, 80, 119, 159, 199, 239, 278, 318, 358, 398, 439,
    482, 528, 576, 626, 679, 735, 793, 854, 917, 983, 1052, 1123,
    1197, 1274, 1354, 1437, 1522, 1610, 1702, 1796, 1893, 1993, 2097, 2203,
    2312, 2425, 2540, 2659, 2781, 2906, 3035, 3166, 3301, 3439, 3581, 3726,
    3874, 4026, 4181, 4339, 4501, 4666, 4835, 5007, 5183, 5363, 5546, 5732,
    5923, 6116, 6314, 6515, 6720, 6928, 7141, 7357, 7577, 7800, 8028, 8259,
    8494, 8733, 8976, 9222, 9473, 9727, 9986, 10248, 10514, 10785, 11059, 11338,
    11620, 11907, 12197, 12492, 12791, 13094, 13401, 13712, 14028, 14347, 14671, 14999,
    15331, 15668, 16009, 16354, 16703, 17057, 17415, 17778, 18144, 18516, 18891, 19271,
    19655, 20044, 20437, 20835, 21237, 21644, 22055, 22471, 22891, 23316, 23745, 24179,
    24618, 25061, 25509, 25961, 26418, 26880, 27346, 27817, 28293, 28774, 29259, 29749,
    30243, 30743, 31247, 31756, 32270, 32788, 33312, 33840, 34373, 34911, 35454, 36002,
    36555, 37113, 37675, 38243, 38815, 39393, 39975, 40562, 41155, 41752, 42355, 42962,
    43575, 44192, 44815, 45443, 46076, 46714, 47357, 48005, 48658, 49317, 49981, 50650,
    51324, 52003, 52688, 53377, 54072, 54773, 55478, 56189, 56905, 57626, 58353, 59085,
    59822, 60565, 61313, 62066, 62825, 63589, 64359, 65134, 65914, 66700, 67491, 68287,
    69090, 69897, 70710, 71529, 72353, 73182, 74017, 74858, 75704, 76556, 77413, 78276,
    79144, 80018, 80898, 81783, 82674, 83570, 84473, 85380, 86294, 87213, 88138, 89068,
    90005, 90946, 91894, 92848, 93807, 94772, 95742, 96719, 97701, 98689, 99683, 100682,
    101688, 102699, 103716, 104739, 105768, 106803, 107843, 108890, 109942, 111001, 112065, 113135,
    114211, 115293, 116381, 117475, 118575, 119681, 120793, 121911, 123034, 124164, 125300, 126442,
    127590, 128745, 129905, 131071,
};
// clang-format on

// Cube roots of i / 256 in 2^-20, for i = 32..256: largest y with y^3 <= i 2^52, rounded.
struct CubeRootTable {
  static constexpr int32_t kFirst = 32;
  uint32_t value[225];
};

constexpr CubeRootTable make_cube_root_table() {
  CubeRootTable table{};
  uint64_t y = uint64_t{1} << 19;  // cube root of 32 / 256
  for (uint32_t i = 0; i < 225; ++i) {
    const uint64_t cube = (uint64_t{i} + CubeRootTable::kFirst) << 52;
    for (uint64_t step = uint64_t{1} << 13; step != 0; step >>= 1) {
      while ((y + step) * (y + step) * (y + step) <= cube) y += step;
    }
    // (y + 1/2)^3 = y^3 + 3/2 y^2 + 3/4 y + 1/8 decides the rounding.
    const bool up = cube - y * y * y > (6 * y * y + 3 * y) / 4;
    table.value[i] = static_cast<uint32_t>(y + (up ? 1 : 0));
  }
  return table;
}

constexpr CubeRootTable kCubeRoot = make_cube_root_table();

// CIELAB's f(t) in 2^-20 for t in 2^-32: the cube root above (6/29)^3, else a line.
static constexpr uint32_t lab_f(uint32_t t) {
  if (t < 38037066u) {                            // (6/29)^3 2^32
    return (((t >> 6) * 3987u) >> 15) + 144631u;  // t 841/108 + 4/29
  }
  uint32_t octaves = 0;  // t = m 8^-octaves with m in [1/8, 1)
  while (t < (1u << 29)) {
    t <<= 3;
    ++octaves;
  }
  const uint32_t i = (t >> 24) - CubeRootTable::kFirst;
  const uint32_t fraction = (t >> 8) & 0xffffu;
  const uint32_t low = kCubeRoot.value[i];
  const uint32_t root = low + (((kCubeRoot.value[i + 1] - low) * fraction) >> 16);
  return root >> octaves;
}

// The luma plane of the stored colour, for a gray pixel: L' of R = G = B = value.
static constexpr uint8_t lab_l_from_gray(uint8_t value) {
  const int32_t f = static_cast<int32_t>(lab_f(kLinearLight[value] << 15));
  return static_cast<uint8_t>((145 * f - (20 << 20) + (1 << 19)) >> 20);
}

static inline Lab lab_from_rgb(uint8_t red, uint8_t green, uint8_t blue) {
  const uint32_t r = kLinearLight[red];
  const uint32_t g = kLinearLight[green];
  const uint32_t b = kLinearLight[blue];
  // XYZ over the white point; each row of the matrix adds up to 2^15, so that grays have a = b = 0 exactly.
  const int32_t fx = static_cast<int32_t>(lab_f(14219 * r + 12328 * g + 6221 * b));
  const int32_t fy = static_cast<int32_t>(lab_f(6969 * r + 23434 * g + 2365 * b));
  const int32_t fz = static_cast<int32_t>(lab_f(582 * r + 3587 * g + 28599 * b));
  // L = 116 fy - 16, a = 500 (fx - fy), b = 200 (fy - fz), all over 0.8.
  return Lab{static_cast<uint8_t>((145 * fy - (20 << 20) + (1 << 19)) >> 20),
             static_cast<uint8_t>((625 * (fx - fy) + (108 << 20) + (1 << 19)) >> 20),
             static_cast<uint8_t>((250 * (fy - fz) + (135 << 20) + (1 << 19)) >> 20)};
}

// 76 R + 150 G + 29 B, at most 65025 (eq. 2 compares it).
static inline uint16_t luma_from_rgb(uint8_t red, uint8_t green, uint8_t blue) {
  return static_cast<uint16_t>(76 * red + 150 * green + 29 * blue);
}

}  // namespace bsm

#endif  // BSM_SIMD_LAB_H
