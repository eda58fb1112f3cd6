// The plain forms of mask_threshold_avx512, made of the kernel's own parts.
#include <algorithm>

#include "bench/plain_forms.h"
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
// The kernel once more, under a name of its own.
#define mask_threshold_avx512 mask_threshold_avx512_again
#define mask_threshold_avx512_scratch mask_threshold_avx512_again_scratch
#include "simd/x86/mask_threshold_avx512.cpp"

namespace bsm::bench {
namespace {

template <int32_t kPlanes>
void window_sad_alone(const MaskThresholdArgs& args, int32_t x, Scratch& scratch) {
  const uint8_t* own = args.rows[args.pattern.radius] + x;
  for (int32_t i = 0; i < scratch.points->count; ++i) {
    __m512i sad = _mm512_setzero_si512();
    BSM_UNROLL
    for (int32_t plane = 0; plane < kPlanes; ++plane) {
      const ptrdiff_t offset = plane * args.plane_stride;
      const __m512i color = _mm512_loadu_si512(scratch.at[i] + x + offset);
      sad = _mm512_adds_epu8(sad, distance(_mm512_loadu_si512(own + offset), color));
    }
    _mm512_store_si512(scratch.sad[i], sad);
  }
}

// All pairs once more, those that count twice two times.
struct EachPair {
  PatternOrder order;
  PatternOrder::Triple triples[2 * BSM_MAX_BITS];
};

}  // namespace

void mask_by_equal_steps_avx512(const MaskThresholdArgs& args) {
  threshold_masks(args, [&args](Scratch& scratch, int32_t x, __mmask64 wanted) {
    if (args.planes == 3) {
      window_sad_alone<3>(args, x, scratch);
    } else {
      window_sad_alone<1>(args, x, scratch);
    }
    Bracket bracket{_mm512_setzero_si512(), _mm512_set1_epi8(-1)};
    for (;;) {
      const __m512i width = _mm512_maskz_sub_epi8(wanted, bracket.high, bracket.low);
      if (_mm512_test_epi8_mask(width, width) == 0) return bracket.low;
      narrow(scratch, args.pattern.bits, _mm512_cmpgt_epu8_mask(width, _mm512_set1_epi8(8)), bracket);
    }
  });
}

void mask_counting_each_avx512(const MaskThresholdArgs& args) {
  static EachPair each;  // large, and the same for all rows: made once
  if (each.order.triples_count == 0) {
    each.order = *args.pattern.order;
    const PatternOrder& order = *args.pattern.order;
    PatternOrder::Triple* end = std::copy_n(order.triples, order.triples_twice, each.triples);
    end = std::copy_n(order.triples, order.triples_count, end);
    each.order.triples = each.triples;
    each.order.triples_count = static_cast<int32_t>(end - each.triples);
    each.order.triples_twice = 0;
  }
  MaskThresholdArgs unordered = args;
  unordered.pattern.order = &each.order;
  threshold_masks(unordered, [&unordered](Scratch& scratch, int32_t x, __mmask64 wanted) {
    if (unordered.planes == 3) {
      window_sad<3>(unordered, x, scratch);
    } else {
      window_sad<1>(unordered, x, scratch);
    }
    return find_threshold(scratch, unordered.pattern.bits, wanted);
  });
}

}  // namespace bsm::bench
#endif
