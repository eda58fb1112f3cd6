// The reciprocals of a neighbourhood's weights, for the fraction kernels of M-profile processors.
#ifndef BSM_SIMD_ARM_FRACTION_RECIPROCALS_H
#define BSM_SIMD_ARM_FRACTION_RECIPROCALS_H

#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kFractionSide = 2 * kFractionRadius + 1;
constexpr int32_t kMostFractionWeight = kFractionSide * kFractionSide * kMaxFractionWeight;

struct FractionReciprocals {
  uint16_t value[kMostFractionWeight + 1];
};

constexpr FractionReciprocals make_fraction_reciprocals() {
  FractionReciprocals table{};
  for (int32_t weight = 1; weight <= kMostFractionWeight; ++weight) {
    table.value[weight] = static_cast<uint16_t>(weight == 1 ? 32767 : (32768 + weight / 2) / weight);
  }
  return table;
}

constexpr FractionReciprocals kFractionReciprocals = make_fraction_reciprocals();

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_FRACTION_RECIPROCALS_H
