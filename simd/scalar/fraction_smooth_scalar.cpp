// fraction_smooth, scalar: mean of the neighbours on the same surface.
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kSameSurface = 16;  // sixteenths

// Weighted sums over a neighbourhood.
struct Sums {
  int32_t difference, weight;
};

Sums add_row(Sums sums, const uint16_t* levels, const uint8_t* weights, int32_t x, int32_t width, int32_t own) {
  for (int32_t i = x - kFractionRadius; i <= x + kFractionRadius; ++i) {
    if (i < 0 || i >= width) continue;
    const int32_t difference = levels[i] - own;
    if (difference < -kSameSurface || difference > kSameSurface) continue;
    sums.difference += weights[i] * difference;
    sums.weight += weights[i];
  }
  return sums;
}

}  // namespace

uint64_t fraction_smooth_scalar_scratch(const KernelShape&) {
  return 0;
}

void fraction_smooth_scalar(const FractionSmoothArgs& args) {
  const uint16_t* own = args.levels[kFractionRadius];
  for (int32_t x = 0; x < args.width; ++x) {
    Sums sums{0, 0};
    for (int32_t row = 0; row <= 2 * kFractionRadius; ++row) {
      if (args.levels[row] != nullptr) sums = add_row(sums, args.levels[row], args.weights[row], x, args.width, own[x]);
    }
    const int32_t reciprocal = sums.weight == 1 ? 32767 : (32768 + sums.weight / 2) / sums.weight;
    args.out[x] = static_cast<uint16_t>(own[x] + ((sums.difference * reciprocal + (1 << 14)) >> 15));
  }
}

}  // namespace bsm
