// descriptor_compare, AVX-512 BW, VBMI, GFNI: the pairs of a point are compared one after the other, 64 pixels at once: the
// point stays in registers, the words of the pairs go where their bits are. 512 words are a transposition.
// Bound, per pair and 64 pixels: one ALU does two compares, joins their masks and moves the word's bytes for 7/8 of a cycle;
// the two loads cross cache lines and take as many cycles.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/kernels.h"
#include "simd/pattern_order.h"
#include "simd/x86/transpose_avx512.h"

namespace bsm {
namespace {

struct alignas(64) Scratch {
  uint64_t tile[kTileWords];
  const uint16_t* points[kMaxPoints];  // luma at the points of pixel 0
  uint64_t words[1];                   // of all pairs: bit x is that of pixel x of the block
};

inline __mmask32 compare(__m512i p, const uint16_t* q) {
  return _mm512_cmpgt_epu16_mask(p, _mm512_loadu_si512(q));
}

// Words of the block of 32 kHalves pixels at x.
template <int32_t kHalves>
BSM_NOINLINE void compare_pairs(const PatternOrder& order, int32_t x, Scratch& scratch) {
  const uint8_t* points = reinterpret_cast<const uint8_t*>(scratch.points);
  const uint32_t* partner = order.partners;
  const PatternOrder::Group* const end = order.groups + order.groups_count;
  for (const PatternOrder::Group* group = order.groups; group != end; ++group) {
    const uint16_t* at;
    BSM_MEMCPY(&at, points + group->p, sizeof at);
    const __m512i low = _mm512_loadu_si512(at + x);
    const __m512i high = kHalves == 2 ? _mm512_loadu_si512(at + x + 32) : low;
    const uint32_t* const last = partner + group->size;
    do {
      const uint32_t pair = *partner;
      BSM_MEMCPY(&at, points + (pair & 0xffff), sizeof at);
      __mmask64 word = compare(low, at + x);
      if (kHalves == 2) word = _mm512_kunpackd(compare(high, at + x + 32), word);
      scratch.words[pair >> 16] = _cvtmask64_u64(word);
    } while (++partner != last);
  }
}

}  // namespace

uint64_t descriptor_compare_avx512_scratch(const KernelShape& shape) {
  return sizeof(Scratch) + sizeof(uint64_t) * static_cast<uint32_t>(shape.bits);
}

void descriptor_compare_avx512(const DescriptorCompareArgs& args) {
  Scratch& scratch = *static_cast<Scratch*>(args.scratch);
  const PatternOrder& order = *args.pattern.order;
  const uint16_t* const* rows = args.rows + args.pattern.radius;
  const ptrdiff_t bytes = args.pattern.bits / 8;
  for (int32_t i = 0; i < order.points.count; ++i) {
    scratch.points[i] = rows[order.points.points[i].dy] + order.points.points[i].dx;
  }
  for (int32_t x = 0; x < args.width; x += 64) {
    const int32_t pixels = args.width - x < 64 ? args.width - x : 64;
    if (pixels > 32) {
      compare_pairs<2>(order, x, scratch);
    } else {
      compare_pairs<1>(order, x, scratch);
    }
    for (int32_t first = 0; first < args.pattern.bits; first += kTileWords) {
      const int32_t count = args.pattern.bits - first < kTileWords ? args.pattern.bits - first : kTileWords;
      store_descriptors(scratch.words + first, count / 64, pixels, args.out + x * bytes + first / 8, bytes, scratch.tile);
    }
  }
}

}  // namespace bsm
#endif
