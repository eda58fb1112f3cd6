// fraction_smooth, DSP: two neighbours of a pixel in a register; SMLAD weighs and adds both.
// Bound, per two neighbours: 2 loads, 8 operations.
#include "platform/compiler.h"

#if BSM_ARCH_DSP
#include "simd/arm/dsp.h"
#include "simd/arm/fraction_reciprocals.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr uint32_t kSameSurface = 16;  // sixteenths

// Weighted sums over a neighbourhood; of weights, in two halves.
struct Sums {
  uint32_t difference, weight;
};

// Two neighbours; own: the pixel's level, twice.
inline Sums add_pair(Sums sums, uint32_t levels, uint32_t weights, uint32_t own) {
  const uint32_t difference = __usub16(levels, own);
  __usub16(twice(2 * kSameSurface), __uadd16(difference, twice(kSameSurface)));
  const uint32_t kept = __sel(weights, 0);
  sums.difference = static_cast<uint32_t>(
      __smlad(static_cast<int16x2_t>(difference), static_cast<int16x2_t>(kept), static_cast<int32_t>(sums.difference)));
  sums.weight += kept;
  return sums;
}

}  // namespace

uint64_t fraction_smooth_dsp_scratch(const KernelShape&) {
  return 0;
}

void fraction_smooth_dsp(const FractionSmoothArgs& args) {
  const uint16_t* own = args.levels[kFractionRadius];
  for (int32_t x = 0; x < args.width; ++x) {
    const uint32_t center = twice(own[x]);
    Sums sums{0, 0};
    const bool inside = x >= kFractionRadius && x + kFractionRadius < args.width;
    const int32_t begin = x < kFractionRadius ? 0 : x - kFractionRadius;
    const int32_t end = x + kFractionRadius < args.width ? x + kFractionRadius + 1 : args.width;
    for (int32_t row = 0; row < kFractionSide; ++row) {
      const uint16_t* levels = args.levels[row];
      const uint8_t* weights = args.weights[row];
      if (levels == nullptr) continue;
      if (inside) {
        levels += begin;
        weights += begin;
        // Five weights in two words.
        const uint32_t four = load32(weights);
        const uint32_t even = even_bytes(four);
        const uint32_t odd = even_bytes(four >> 8);
        sums = add_pair(sums, load32(levels), even << 16 >> 16 | odd << 16, center);
        sums = add_pair(sums, load32(levels + 2), even >> 16 | (odd >> 16 << 16), center);
        sums = add_pair(sums, levels[4], weights[4], center);
      } else {
        for (int32_t i = begin; i < end; ++i) sums = add_pair(sums, levels[i], weights[i], center);
      }
    }
    const uint32_t weight = (sums.weight & 0xffff) + (sums.weight >> 16);
    const int32_t reciprocal = kFractionReciprocals.value[weight];
    const int32_t difference = static_cast<int32_t>(sums.difference);
    args.out[x] = static_cast<uint16_t>(own[x] + ((difference * reciprocal + (1 << 14)) >> 15));
  }
}

}  // namespace bsm
#endif
