// Population counts of descriptors that lie one after the other, for the kernels that count several of them in a vector.
#ifndef BSM_SIMD_ARM_HAMMING_SVE_H
#define BSM_SIMD_ARM_HAMMING_SVE_H

#include "simd/arm/sve.h"

namespace bsm {
namespace {

// How vectors and descriptors of `bytes` bytes fit together: a vector holds several whole ones, or they hold whole vectors.
enum class Fit { kSeveral, kParts, kNone };

inline Fit fit_of(int32_t bytes) {
  return lanes8() % bytes == 0 ? Fit::kSeveral : bytes % lanes8() == 0 ? Fit::kParts : Fit::kNone;
}

// The bytes of one descriptor or mask that stand against those at `at` of descriptors one after the other.
template <Fit kFit, int32_t kBytes>
BSM_INLINE svuint8_t load_own(const uint8_t* own, ptrdiff_t at) {
  if constexpr (kFit == Fit::kSeveral) {
    const svuint8_t one = svld1(svwhilelt_b8(int32_t{0}, kBytes), own);
    return svtbl(one, svand_x(svptrue_b8(), svindex_u8(0, 1), static_cast<uint8_t>(kBytes - 1)));
  } else {
    return svld1(svptrue_b8(), own + at % kBytes);
  }
}

BSM_INLINE svuint64_t count_words(svuint8_t bits) {
  return svcnt_x(svptrue_b64(), svreinterpret_u64(bits));
}

// Sums of 1 << kLevel neighbouring words each: lane i holds those of the i-th group from `at` on. words(at) gives the counts
// of the words of one vector.
template <int32_t kLevel, class Words>
BSM_INLINE svuint64_t sum_words(const Words& words, ptrdiff_t at) {
  if constexpr (kLevel == 0) {
    return words(at);
  } else {
    const svuint64_t a = sum_words<kLevel - 1>(words, at);
    const svuint64_t b = sum_words<kLevel - 1>(words, at + (ptrdiff_t{lanes8()} << (kLevel - 1)));
    return svadd_x(svptrue_b64(), svuzp1(a, b), svuzp2(a, b));
  }
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_HAMMING_SVE_H
