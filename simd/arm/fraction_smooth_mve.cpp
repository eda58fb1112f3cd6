// fraction_smooth, MVE: eight neighbouring pixels at once.
// Bound, per neighbour and eight pixels: 2 loads, 6 operations. The mean's rounded product is one instruction.
#include "platform/compiler.h"

#if BSM_ARCH_MVE
#include "simd/arm/fraction_reciprocals.h"
#include "simd/arm/inside.h"
#include "simd/arm/mve.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 8;
constexpr uint16_t kSameSurface = 16;  // sixteenths

// Eight pixels from x on; kEnd: some of their neighbours lie outside the row, where nothing weighs.
template <bool kEnd>
uint16x8_t smooth_eight(const FractionSmoothArgs& args, int32_t x, uint16x8_t own) {
  const uint16x8_t zero = vdupq_n_u16(0);
  const uint16x8_t end = vdupq_n_u16(2 * kSameSurface + 1);
  uint16x8_t difference = zero;
  uint16x8_t weight = zero;
  for (int32_t row = 0; row < kFractionSide; ++row) {
    if (args.levels[row] == nullptr) continue;
    for (int32_t at = x - kFractionRadius; at <= x + kFractionRadius; ++at) {
      const mve_pred16_t inside = kEnd ? lanes_inside(at, args.width) : mve_pred16_t{0xffff};
      const uint16x8_t level = kEnd ? vldrhq_z_u16(args.levels[row] + at, inside) : vldrhq_u16(args.levels[row] + at);
      const uint16x8_t weighs = kEnd ? vldrbq_z_u16(args.weights[row] + at, inside) : vldrbq_u16(args.weights[row] + at);
      const uint16x8_t above = vsubq_u16(level, own);
      const uint16x8_t kept = add_where_less(zero, weighs, vaddq_n_u16(above, kSameSurface), end);
      difference = vaddq_u16(difference, vmulq_u16(above, kept));
      weight = vaddq_u16(weight, kept);
    }
  }
  const uint16x8_t reciprocal = vldrhq_gather_shifted_offset_u16(kFractionReciprocals.value, weight);
  // (2 e r + 2^15) >> 16
  const int16x8_t mean = vqrdmulhq_s16(vreinterpretq_s16_u16(difference), vreinterpretq_s16_u16(reciprocal));
  return vaddq_u16(own, vreinterpretq_u16_s16(mean));
}

}  // namespace

uint64_t fraction_smooth_mve_scratch(const KernelShape&) {
  return 0;
}

void fraction_smooth_mve(const FractionSmoothArgs& args) {
  const uint16_t* levels = args.levels[kFractionRadius];
  for (int32_t x = 0; x < args.width; x += kLanes) {
    if (x >= kFractionRadius && x + kLanes + kFractionRadius <= args.width) {
      vstrhq_u16(args.out + x, smooth_eight<false>(args, x, vldrhq_u16(levels + x)));
    } else {
      const mve_pred16_t inside = vctp16q(static_cast<uint32_t>(args.width - x));
      vstrhq_p_u16(args.out + x, smooth_eight<true>(args, x, vldrhq_z_u16(levels + x, inside)), inside);
    }
  }
}

}  // namespace bsm
#endif
