// descriptor_compare for AVX2 and SSE4.2: the pairs of a point are compared one after the other, the way of
// descriptor_compare_avx512.cpp; a pair is two compares of half a vector of luma values each.
// Include after the lanes of one instruction set.
#ifndef BSM_SIMD_X86_DESCRIPTOR_COMPARE_LANES_H
#define BSM_SIMD_X86_DESCRIPTOR_COMPARE_LANES_H

#include "simd/kernels.h"
#include "simd/pattern_order.h"
#include "simd/x86/transpose_lanes.h"

namespace bsm {
namespace {

struct DescriptorScratch {
  const uint16_t* points[kMaxPoints];  // luma at the points of pixel 0
  Word words[1];                       // of all pairs
};

inline uint64_t descriptor_scratch(const KernelShape& shape) {
  return sizeof(DescriptorScratch) + sizeof(Word) * static_cast<uint32_t>(shape.bits);
}

// Where p is at most luma at q.
inline Bytes not_above(Bytes p, const uint16_t* q) {
  const Bytes other = load(q);
  return equal16(max16(p, other), other);
}

// The numbers of points are 8 apart, the addresses so many times closer.
constexpr uint32_t kCloser = 8 / sizeof(const uint16_t*);

inline void compare_pairs(const PatternOrder& order, int32_t x, DescriptorScratch& scratch) {
  const uint8_t* points = reinterpret_cast<const uint8_t*>(scratch.points);
  Word* const words = scratch.words;
  const uint32_t* partner = order.partners;
  const PatternOrder::Group* const end = order.groups + order.groups_count;
  for (const PatternOrder::Group* group = order.groups; group != end; ++group) {
    const uint16_t* at;
    BSM_MEMCPY(&at, points + group->p / kCloser, sizeof at);
    const Bytes low = load(at + x);
    const Bytes high = load(at + x + kLanes / 2);
    const uint32_t* const last = partner + group->size;
    do {
      const uint32_t pair = *partner;
      BSM_MEMCPY(&at, points + (pair & 0xffff) / kCloser, sizeof at);
      words[pair >> 16] = signs(pack(not_above(low, at + x), not_above(high, at + x + kLanes / 2)));
    } while (++partner != last);
  }
}

inline void compare_descriptors(const DescriptorCompareArgs& args) {
  DescriptorScratch& scratch = *static_cast<DescriptorScratch*>(args.scratch);
  const PatternOrder& order = *args.pattern.order;
  const uint16_t* const* rows = args.rows + args.pattern.radius;
  const ptrdiff_t bytes = args.pattern.bits / 8;
  for (int32_t i = 0; i < order.points.count; ++i) {
    scratch.points[i] = rows[order.points.points[i].dy] + order.points.points[i].dx;
  }
  for (int32_t x = 0; x < args.width; x += kLanes) {
    const int32_t pixels = args.width - x < kLanes ? args.width - x : kLanes;
    compare_pairs(order, x, scratch);
    store_descriptors<true>(scratch.words, args.pattern.bits, kPackedByte, pixels, args.out + x * bytes, bytes);
  }
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_DESCRIPTOR_COMPARE_LANES_H
