// The plain forms of descriptor_compare_avx2 and mask_threshold_avx2, made of the kernel's own parts.
#include "bench/plain_forms.h"
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/lanes_avx2.h"

#include "simd/x86/descriptor_compare_lanes.h"
#include "simd/x86/mask_threshold_lanes.h"

namespace bsm::bench {
namespace {

Bytes pair_weight(const MaskScratch& scratch, uint32_t pair) {
  constexpr ptrdiff_t kScale = kLanes / 8;
  const uint8_t* sad = reinterpret_cast<const uint8_t*>(&scratch.sad);
  return max8(load(sad + kScale * (pair & 0xffff)), load(sad + kScale * (pair >> 16)));
}

Bytes is_within(Bytes value, Bytes threshold) {
  return equal8(min8(value, threshold), value);
}

// All ones in the bytes of the pixels that have at least bits / 4 pairs within their threshold.
Bytes enough_within(const MaskScratch& scratch, int32_t bits, Bytes threshold) {
  Bytes even = zero(), odd = zero();  // 16-bit counts of the pixels of a 16-bit lane
  for (int32_t i = 0; i < bits;) {
    Bytes counts = zero();
    for (const int32_t end = bits - i < 255 ? bits : i + 255; i < end; ++i) {
      counts = sub8(counts, is_within(pair_weight(scratch, scratch.points->pairs[i]), threshold));
    }
    even = add16(even, both(counts, set16(255)));
    odd = add16(odd, right16<8>(counts));
  }
  const Bytes wanted = set16(bits / 4);
  const Bytes low = both(equal16(max16(even, wanted), even), set16(255));
  return either(low, left16<8>(equal16(max16(odd, wanted), odd)));
}

Bytes bisect(MaskScratch& scratch, int32_t bits) {
  Bytes low = zero(), high = set8(-1);
  for (int32_t step = 0; step < 8; ++step) {
    const Bytes middle = add8(low, both(right16<1>(sub8(high, low)), set8(0x7f)));
    const Bytes enough = enough_within(scratch, bits, middle);
    high = choose(high, middle, enough);
    low = choose(add8(middle, set8(1)), low, enough);
  }
  return high;
}

Bytes search_evenly(MaskScratch& scratch, int32_t bits) {
  Bracket bracket{zero(), set8(-1)};
  narrow<5>(scratch, bits, bracket);
  narrow<2>(scratch, bits, bracket);
  narrow<0>(scratch, bits, bracket);
  return bracket.low;
}

// Words of the pairs from `first` on: bit x says that the pair of pixel x is within its threshold.
void threshold_pairs(const MaskThresholdArgs& args, int32_t x, int32_t pixels, Bytes threshold, int32_t first, int32_t count,
                     MaskScratch& scratch) {
  const uint32_t* pairs = scratch.points->pairs + first;
  Word* const words = scratch.words[0];
  for (int32_t i = 0; i < count; ++i) words[i] = signs(is_within(pair_weight(scratch, pairs[i]), threshold));
  const Word beyond = signs(both(equal8(threshold, set8(-1)), lanes_of(pixels)));
  if (beyond == 0) return;
  for (int32_t pixel = 0; pixel < pixels; ++pixel) {
    if ((beyond >> pixel & 1) == 0) continue;
    const uint32_t exact = exact_threshold(args, x + pixel, *scratch.points, scratch.exact_sad, scratch.histogram);
    const Word bit = Word{1} << pixel;
    for (int32_t i = 0; i < count; ++i) {
      const bool within =
          scratch.exact_sad[(pairs[i] & 0xffff) / 8] <= exact && scratch.exact_sad[(pairs[i] >> 16) / 8] <= exact;
      words[i] = within ? words[i] | bit : words[i] & ~bit;
    }
  }
}

}  // namespace

void descriptors_by_pair_avx2(const DescriptorCompareArgs& args) {
  DescriptorScratch& scratch = *static_cast<DescriptorScratch*>(args.scratch);
  const PatternPoints& points = args.pattern.order->points;
  const uint16_t* const* rows = args.rows + args.pattern.radius;
  const ptrdiff_t bytes = args.pattern.bits / 8;
  for (int32_t i = 0; i < points.count; ++i) scratch.points[i] = rows[points.points[i].dy] + points.points[i].dx;
  for (int32_t x = 0; x < args.width; x += kLanes) {
    for (int32_t i = 0; i < args.pattern.bits; ++i) {
      const uint16_t* const p = scratch.points[(points.pairs[i] & 0xffff) / 8] + x;
      const uint16_t* const q = scratch.points[(points.pairs[i] >> 16) / 8] + x;
      const Bytes low = not_above(load(p), q);
      scratch.words[i] = signs(pack(low, not_above(load(p + kLanes / 2), q + kLanes / 2)));
    }
    const int32_t pixels = args.width - x < kLanes ? args.width - x : kLanes;
    store_descriptors<true>(scratch.words, args.pattern.bits, kPackedByte, pixels, args.out + x * bytes, bytes);
  }
}

void mask_counting_each_avx2(const MaskThresholdArgs& args) {
  static PatternOrder order;  // large, and the same for all rows: copied once
  if (order.singles_count == 0) order = *args.pattern.order;
  order.singles = order.points.pairs;
  order.singles_count = args.pattern.bits;
  order.singles_twice = 0;
  MaskThresholdArgs each = args;
  each.pattern.order = &order;
  threshold_masks(each);
}

void mask_threshold_by_pair_avx2(const MaskThresholdArgs& args) {
  static constexpr int32_t kInOrder[kLanes / 8] = {0, 1, 2, 3};
  const int32_t bits = args.pattern.bits;
  MaskScratch& scratch = begin_row(args);
  for (int32_t x = 0; x < args.width; x += kLanes) {
    const int32_t pixels = args.width - x < kLanes ? args.width - x : kLanes;
    window_sad(args, x, scratch);
    const Bytes threshold = find_threshold(scratch, bits, lanes_of(pixels));
    for (int32_t first = 0; first < bits; first += kWordsAtOnce) {
      const int32_t count = bits - first < kWordsAtOnce ? bits - first : kWordsAtOnce;
      threshold_pairs(args, x, pixels, threshold, first, count, scratch);
      uint8_t* const out = args.out + (ptrdiff_t{x} * bits + first) / 8;
      store_descriptors<false>(scratch.words[0], count, kInOrder, pixels, out, bits / 8);
    }
  }
}

void mask_by_bisection_avx2(const MaskThresholdArgs& args) {
  threshold_masks(args, [&args](MaskScratch& scratch, int32_t) { return bisect(scratch, args.pattern.bits); });
}

void mask_by_even_steps_avx2(const MaskThresholdArgs& args) {
  threshold_masks(args, [&args](MaskScratch& scratch, int32_t) { return search_evenly(scratch, args.pattern.bits); });
}

}  // namespace bsm::bench
#endif
