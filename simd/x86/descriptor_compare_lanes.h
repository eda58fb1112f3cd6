// descriptor_compare for AVX2 and SSE4.2: a pair is two compares of half a vector of luma values each.
// Include after the lanes of one instruction set.
#ifndef BSM_SIMD_X86_DESCRIPTOR_COMPARE_LANES_H
#define BSM_SIMD_X86_DESCRIPTOR_COMPARE_LANES_H

#include "simd/kernels.h"
#include "simd/x86/transpose_lanes.h"

namespace bsm {
namespace {

constexpr int32_t kWordsAtOnce = 512;

constexpr uint64_t kDescriptorScratch = kWordsAtOnce * sizeof(Word);

// Where luma at p is at most luma at q.
inline Bytes not_above(const uint16_t* p, const uint16_t* q) {
  const Bytes other = load(q);
  return equal16(max16(load(p), other), other);
}

inline void compare_descriptors(const DescriptorCompareArgs& args) {
  Word* words = static_cast<Word*>(args.scratch);
  const uint16_t* const* rows = args.rows + args.pattern.radius;
  const ptrdiff_t bytes = args.pattern.bits / 8;
  for (int32_t x = 0; x < args.width; x += kLanes) {
    const int32_t pixels = args.width - x < kLanes ? args.width - x : kLanes;
    for (int32_t first = 0; first < args.pattern.bits; first += kWordsAtOnce) {
      const int32_t count = args.pattern.bits - first < kWordsAtOnce ? args.pattern.bits - first : kWordsAtOnce;
      const PixelPair* pairs = args.pattern.pairs + first;
      for (int32_t i = 0; i < count; ++i) {
        const uint16_t* p = rows[pairs[i].py] + pairs[i].px + x;
        const uint16_t* q = rows[pairs[i].qy] + pairs[i].qx + x;
        words[i] = signs(pack(not_above(p, q), not_above(p + kLanes / 2, q + kLanes / 2)));
      }
      store_descriptors<true>(words, count, kPackedByte, pixels, args.out + x * bytes + first / 8, bytes);
    }
  }
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_DESCRIPTOR_COMPARE_LANES_H
