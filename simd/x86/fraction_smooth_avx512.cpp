// fraction_smooth, AVX-512 BW: 32 pixels at once. Bound, per tap of 25: 2 loads, 7 operations.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include <immintrin.h>

#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kPixelsAtOnce = 32;
constexpr int32_t kSameSurface = 16;  // sixteenths
constexpr int32_t kRows = 2 * kFractionRadius + 1;

// r(w) of a sum of weights, at most 50.
struct Reciprocals {
  alignas(64) uint16_t of[64];

  constexpr Reciprocals() : of() {
    for (int32_t w = 1; w < 64; ++w) of[w] = static_cast<uint16_t>(w == 1 ? 32767 : (32768 + w / 2) / w);
  }
};
constexpr Reciprocals kReciprocals{};

// Bits of the pixels i, i + 1, .. that lie within 0..width-1.
inline __mmask32 inside_row(int32_t i, int32_t width) {
  const uint32_t after = width - i >= kPixelsAtOnce ? ~uint32_t{0} : width - i > 0 ? ~(~uint32_t{0} << (width - i)) : 0;
  return static_cast<__mmask32>(i < 0 ? after & (~uint32_t{0} << -i) : after);
}

}  // namespace

uint64_t fraction_smooth_avx512_scratch(const KernelShape&) {
  return 0;
}

void fraction_smooth_avx512(const FractionSmoothArgs& args) {
  const __m512i reciprocals_low = _mm512_load_si512(kReciprocals.of);
  const __m512i reciprocals_high = _mm512_load_si512(kReciprocals.of + 32);
  const __m512i surface = _mm512_set1_epi16(kSameSurface);
  const __m512i span = _mm512_set1_epi16(2 * kSameSurface);
  for (int32_t x = 0; x < args.width; x += kPixelsAtOnce) {
    const __mmask32 here = inside_row(x, args.width);
    const __m512i own = _mm512_maskz_loadu_epi16(here, args.levels[kFractionRadius] + x);
    __m512i difference = _mm512_setzero_si512();
    __m512i weight = _mm512_setzero_si512();
    for (int32_t row = 0; row < kRows; ++row) {
      const uint16_t* levels = args.levels[row];
      const uint8_t* weights = args.weights[row];
      if (levels == nullptr) continue;
      BSM_UNROLL
      for (int32_t dx = -kFractionRadius; dx <= kFractionRadius; ++dx) {
        const __mmask32 inside = inside_row(x + dx, args.width);
        const __m512i step = _mm512_sub_epi16(_mm512_maskz_loadu_epi16(inside, levels + x + dx), own);
        // Within the surface when step + 16, without a sign, is at most 32: steps wrap around only between levels near 0 and
        // near 65536, and a level is at most 4093 * 16 + 15.
        const __mmask32 near = _mm512_mask_cmple_epu16_mask(inside, _mm512_add_epi16(step, surface), span);
        const __m512i own_weight = _mm512_cvtepu8_epi16(_mm256_maskz_loadu_epi8(inside, weights + x + dx));
        difference = _mm512_mask_add_epi16(difference, near, difference, _mm512_mullo_epi16(step, own_weight));
        weight = _mm512_mask_add_epi16(weight, near, weight, own_weight);
      }
    }
    const __m512i reciprocal = _mm512_permutex2var_epi16(reciprocals_low, weight, reciprocals_high);
    const __m512i level = _mm512_add_epi16(own, _mm512_mulhrs_epi16(difference, reciprocal));
    _mm512_mask_storeu_epi16(args.out + x, here, level);
  }
}

}  // namespace bsm
#endif
