// edge_threshold, AVX-512 BW: 64 pixels at once. Bound: six loads for 64 pixels of three planes.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include <immintrin.h>

#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kPixelsAtOnce = 64;

template <int32_t kPlanes>
void find_edges(const EdgeThresholdArgs& args) {
  const __m512i threshold = _mm512_set1_epi16(static_cast<int16_t>(args.threshold));
  for (int32_t x = 0; x < args.width; x += kPixelsAtOnce) {
    const int32_t pixels = args.width - x;
    const __mmask64 here = pixels < kPixelsAtOnce ? ~(~uint64_t{0} << pixels) : ~uint64_t{0};
    __m512i sads[2] = {_mm512_setzero_si512(), _mm512_setzero_si512()};
    BSM_UNROLL
    for (int32_t plane = 0; plane < kPlanes; ++plane) {
      const __m512i a = _mm512_maskz_loadu_epi8(here, args.lab + plane * args.plane_stride + x);
      const __m512i b = _mm512_maskz_loadu_epi8(here, args.previous + plane * args.plane_stride + x);
      const __m512i distance = _mm512_sub_epi8(_mm512_max_epu8(a, b), _mm512_min_epu8(a, b));
      sads[0] = _mm512_add_epi16(sads[0], _mm512_cvtepu8_epi16(_mm512_castsi512_si256(distance)));
      sads[1] = _mm512_add_epi16(sads[1], _mm512_cvtepu8_epi16(_mm512_extracti64x4_epi64(distance, 1)));
    }
    const uint64_t low = _mm512_cmpgt_epi16_mask(sads[0], threshold);
    const uint64_t high = _mm512_cmpgt_epi16_mask(sads[1], threshold);
    _mm512_mask_storeu_epi8(args.edge + x, here, _mm512_maskz_set1_epi8(low | high << 32, 1));
  }
}

}  // namespace

uint64_t edge_threshold_avx512_scratch(const KernelShape&) {
  return 0;
}

void edge_threshold_avx512(const EdgeThresholdArgs& args) {
  return args.planes == 3 ? find_edges<3>(args) : find_edges<1>(args);
}

}  // namespace bsm
#endif
