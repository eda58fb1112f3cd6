// descriptor_compare, AVX-512 BW, VBMI, GFNI: a pair is two compares of 32 luma values each, 64 pairs a transposition.
// Bound: four loads a pair and 64 pixels, all of them across cache lines.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/kernels.h"
#include "simd/x86/transpose_avx512.h"

namespace bsm {
namespace {

struct alignas(64) Scratch {
  uint64_t words[kTileWords];
  uint64_t tile[kTileWords];
};

// Bit x of the result: luma at p + x is above luma at q + x.
inline uint64_t compare_pair(const uint16_t* p, const uint16_t* q) {
  const uint64_t low = _mm512_cmpgt_epu16_mask(_mm512_loadu_si512(p), _mm512_loadu_si512(q));
  const uint64_t high = _mm512_cmpgt_epu16_mask(_mm512_loadu_si512(p + 32), _mm512_loadu_si512(q + 32));
  return high << 32 | low;
}

}  // namespace

uint64_t descriptor_compare_avx512_scratch(const KernelShape&) {
  return sizeof(Scratch);
}

void descriptor_compare_avx512(const DescriptorCompareArgs& args) {
  Scratch& scratch = *static_cast<Scratch*>(args.scratch);
  const uint16_t* const* rows = args.rows + args.pattern.radius;
  const ptrdiff_t bytes = args.pattern.bits / 8;
  for (int32_t x = 0; x < args.width; x += 64) {
    const int32_t pixels = args.width - x < 64 ? args.width - x : 64;
    for (int32_t first = 0; first < args.pattern.bits; first += kTileWords) {
      const int32_t count = args.pattern.bits - first < kTileWords ? args.pattern.bits - first : kTileWords;
      const PixelPair* pairs = args.pattern.pairs + first;
      for (int32_t i = 0; i < count; ++i) {
        scratch.words[i] = compare_pair(rows[pairs[i].py] + pairs[i].px + x, rows[pairs[i].qy] + pairs[i].qx + x);
      }
      store_descriptors(scratch.words, count / 64, pixels, args.out + x * bytes + first / 8, bytes, scratch.tile);
    }
  }
}

}  // namespace bsm
#endif
