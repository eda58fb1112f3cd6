// cost_hamming, NEON: eight candidates of a pixel at once.
// Bound, per 128 bits of a candidate: 1 XOR, 1 AND, 1 population count, 1 addition; 1 load.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "simd/arm/neon.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kAtOnce = 8;  // candidates at once, neighbours in the other view

// Sums of eight vectors of counts, each within 3 x 8: the sums of each half stay within 192.
inline uint16x8_t add_up(const uint8x16_t (&c)[kAtOnce]) {
  const uint8x16_t low = add_pairs8(add_pairs8(c[0], c[1]), add_pairs8(c[2], c[3]));
  const uint8x16_t high = add_pairs8(add_pairs8(c[4], c[5]), add_pairs8(c[6], c[7]));
  return vpaddlq_u8(add_pairs8(low, high));
}

// kVectors vectors of a pixel's descriptor and mask.
template <int32_t kVectors>
struct Own {
  uint8x16_t descriptor[kVectors], mask[kVectors];
};

template <int32_t kVectors>
inline Own<kVectors> load_own(const uint8_t* descriptor, const uint8_t* mask) {
  Own<kVectors> own;
  BSM_UNROLL
  for (int32_t v = 0; v < kVectors; ++v) {
    own.descriptor[v] = vld1q_u8(descriptor + 16 * v);
    own.mask[v] = vld1q_u8(mask + 16 * v);
  }
  return own;
}

// Costs of the pixels other, other + stride, .. by kVectors vectors of a descriptor.
template <int32_t kVectors>
inline uint16x8_t count(const Own<kVectors>& own, const uint8_t* other, ptrdiff_t stride) {
  static_assert(kVectors <= 3, "eight bytes' counts add up within 255");
  uint8x16_t counts[kAtOnce];
  BSM_UNROLL
  for (int32_t v = 0; v < kVectors; ++v) {
    BSM_UNROLL
    for (int32_t i = 0; i < kAtOnce; ++i) {
      const uint8x16_t differing = veorq_u8(own.descriptor[v], vld1q_u8(other + i * stride + 16 * v));
      const uint8x16_t count = vcntq_u8(vandq_u8(differing, own.mask[v]));
      counts[i] = v == 0 ? count : vaddq_u8(counts[i], count);
    }
  }
  return add_up(counts);
}

// The same by the last eight bytes of a descriptor.
inline uint16x8_t count_half(const uint8_t* own, const uint8_t* mask, const uint8_t* other, ptrdiff_t stride) {
  uint8x16_t counts[kAtOnce];
  const uint8x16_t descriptor = load_half(own);
  const uint8x16_t kept = load_half(mask);
  BSM_UNROLL
  for (int32_t i = 0; i < kAtOnce; ++i) {
    counts[i] = vcntq_u8(vandq_u8(veorq_u8(descriptor, load_half(other + i * stride)), kept));
  }
  return add_up(counts);
}

// A row's descriptors of kBytes bytes; 0: any number.
template <ptrdiff_t kBytes, bool kLeft>
struct Row {
  const CostHammingArgs& args;
  ptrdiff_t bytes;
  uint16x8_t beyond;  // all bits set in the last eight levels that do not exist

  // Costs of a pixel and the eight others, which lie in memory one after the other; the left view meets them backwards.
  inline uint16x8_t eight_costs(const uint8_t* own, const uint8_t* mask, const uint8_t* other) const {
    if constexpr (kBytes != 0) {
      constexpr ptrdiff_t kStride = kLeft ? -kBytes : kBytes;
      return count<kBytes / 16>(load_own<kBytes / 16>(own, mask), kLeft ? other + (kAtOnce - 1) * kBytes : other, kStride);
    } else {
      const ptrdiff_t stride = kLeft ? -bytes : bytes;
      if (kLeft) other += (kAtOnce - 1) * bytes;
      uint16x8_t sums = vdupq_n_u16(0);
      ptrdiff_t at = 0;
      for (; at + 32 <= bytes; at += 32)
        sums = vaddq_u16(sums, count<2>(load_own<2>(own + at, mask + at), other + at, stride));
      if (at + 16 <= bytes) {
        sums = vaddq_u16(sums, count<1>(load_own<1>(own + at, mask + at), other + at, stride));
        at += 16;
      }
      if (at < bytes) sums = vaddq_u16(sums, count_half(own + at, mask + at, other + at, stride));
      return sums;
    }
  }

  // The same where not all, but some of the eight lie in the row, from `first` on: others are looked at and moved to their
  // lanes.
  uint16x8_t partial_costs(const uint8_t* own, const uint8_t* mask, int32_t first) const {
    uint16_t costs[3 * kAtOnce];
    for (uint16_t& cost : costs) cost = kNoCost;
    uint16_t* middle = costs + kAtOnce;
    if (args.width >= kAtOnce) {
      const int32_t start = first < 0 ? 0 : first > args.width - kAtOnce ? args.width - kAtOnce : first;
      const int32_t moved = kLeft ? start - first : first - start;
      vst1q_u16(middle, eight_costs(own, mask, args.other + start * bytes));
      return vld1q_u16(middle + moved);
    }
    for (int32_t i = 0; i < kAtOnce; ++i) {
      if (first + i < 0 || first + i >= args.width) continue;
      const uint8_t* other = args.other + (first + i) * bytes;
      uint64_t sum = 0;
      for (ptrdiff_t at = 0; at < bytes; at += 8) {
        const uint8x8_t differing = veor_u8(vld1_u8(own + at), vld1_u8(other + at));
        const uint8x8_t counts = vcnt_u8(vand_u8(differing, vld1_u8(mask + at)));
        sum += vget_lane_u64(vpaddl_u32(vpaddl_u16(vpaddl_u8(counts))), 0);
      }
      middle[kLeft ? kAtOnce - 1 - i : i] = static_cast<uint16_t>(sum);
    }
    return vld1q_u16(middle);
  }

  // Of the eight others of a pixel's first vector, the first in memory.
  int32_t first_other(int32_t x) const { return kLeft ? x - args.min_disparity - (kAtOnce - 1) : x + args.min_disparity; }

  // Levels that are no candidate: those of the last vector from num_disparities on, and the whole vectors after it.
  void end_pixel(uint16_t* cost, uint16_t* end) const {
    vst1q_u16(cost - kAtOnce, vorrq_u16(vld1q_u16(cost - kAtOnce), beyond));
    for (; cost < end; cost += kAtOnce) vst1q_u16(cost, vdupq_n_u16(kNoCost));
  }

  // Costs of `vectors` vectors of levels of a pixel whose others lie in the row, those of the first from `other` on.
  inline void cost_vectors(const uint8_t* own, const uint8_t* mask, const uint8_t* other, int32_t vectors,
                           uint16_t* cost) const {
    constexpr int32_t kAdvance = kLeft ? -kAtOnce : kAtOnce;
    if constexpr (kBytes != 0) {  // the pixel's own bits stay in registers
      constexpr int32_t kVectors = kBytes / 16;
      constexpr ptrdiff_t kStride = kLeft ? -kBytes : kBytes;
      const Own<kVectors> bits = load_own<kVectors>(own, mask);
      if (kLeft) other += (kAtOnce - 1) * kBytes;
      for (; vectors >= 2; vectors -= 2, cost += 2 * kAtOnce, other += 2 * kAdvance * kBytes) {
        const uint16x8_t first = count<kVectors>(bits, other, kStride);
        const uint16x8_t second = count<kVectors>(bits, other + kAdvance * kBytes, kStride);
        vst1q_u16(cost, first);
        vst1q_u16(cost + kAtOnce, second);
      }
      if (vectors != 0) vst1q_u16(cost, count<kVectors>(bits, other, kStride));
    } else {
      for (; vectors != 0; --vectors, cost += kAtOnce, other += kAdvance * bytes)
        vst1q_u16(cost, eight_costs(own, mask, other));
    }
  }

  // Pixels begin..end-1, all of whose vectors' others lie in the row; masks lie mask_bytes apart.
  void cost_inside(int32_t begin, int32_t end, const uint8_t* masks, ptrdiff_t mask_bytes) const {
    const ptrdiff_t stride = args.stride;
    const int32_t count = (args.num_disparities + kAtOnce - 1) / kAtOnce;
    const uint8_t* own = args.own + begin * bytes;
    const uint8_t* mask = masks + begin * mask_bytes;
    const uint8_t* other = args.other + first_other(begin) * bytes;
    uint16_t* cost = args.cost + begin * stride;
    for (int32_t left = end - begin; left > 0; --left, cost += stride) {
      cost_vectors(own, mask, other, count, cost);
      end_pixel(cost + count * kAtOnce, cost + stride);
      own += bytes;
      mask += mask_bytes;
      other += bytes;
    }
  }

  // Any pixel.
  BSM_NOINLINE void cost_pixel(int32_t x, const uint8_t* mask) const {
    constexpr int32_t kAdvance = kLeft ? -kAtOnce : kAtOnce;
    const uint8_t* own = args.own + x * bytes;
    uint16_t* cost = args.cost + ptrdiff_t{x} * args.stride;
    uint16_t* const end = cost + args.stride;
    int32_t left = (args.num_disparities + kAtOnce - 1) / kAtOnce;
    int32_t first = first_other(x);
    while (left > 0) {
      // The vectors from here on whose others lie in the row.
      const int32_t room = kLeft ? first : args.width - kAtOnce - first;
      const bool inside = first >= 0 && first <= args.width - kAtOnce;
      const int32_t fit = inside ? room / kAtOnce + 1 : 0;
      const int32_t count = fit == 0 ? 1 : fit < left ? fit : left;
      if (inside) {
        cost_vectors(own, mask, args.other + first * bytes, count, cost);
      } else {
        const bool outside = first <= -kAtOnce || first >= args.width;
        vst1q_u16(cost, outside ? vdupq_n_u16(kNoCost) : partial_costs(own, mask, first));
      }
      cost += count * kAtOnce;
      first += count * kAdvance;
      left -= count;
    }
    end_pixel(cost, end);
  }

  // All pixels; masks lie mask_bytes apart.
  void cost_pixels(const uint8_t* masks, ptrdiff_t mask_bytes) const {
    // From the first pixel whose first vector and last vector lie inside to the last one.
    const int32_t span = (args.num_disparities - 1) / kAtOnce * kAtOnce;
    const int32_t first = (kLeft ? span : 0) - first_other(0);
    const int32_t last = args.width - kAtOnce - (kLeft ? 0 : span) - first_other(0);
    const int32_t begin = first < 0 ? 0 : first < args.width ? first : args.width;
    const int32_t end = last < begin ? begin : last < args.width ? last + 1 : args.width;
    for (int32_t x = 0; x < begin; ++x) cost_pixel(x, masks + x * mask_bytes);
    cost_inside(begin, end, masks, mask_bytes);
    for (int32_t x = end; x < args.width; ++x) cost_pixel(x, masks + x * mask_bytes);
  }
};

template <ptrdiff_t kBytes, bool kLeft>
void cost_row(const CostHammingArgs& args) {
  alignas(16) static constexpr uint16_t kLanes[kAtOnce] = {0, 1, 2, 3, 4, 5, 6, 7};
  const uint16x8_t last = vdupq_n_u16(static_cast<uint16_t>((args.num_disparities - 1) % kAtOnce));
  const Row<kBytes, kLeft> row{args, kBytes != 0 ? kBytes : args.bits / 8, vcgtq_u16(vld1q_u16(kLanes), last)};
  if (args.own_mask == nullptr) {
    uint8_t* all = static_cast<uint8_t*>(args.scratch);
    BSM_MEMSET(all, 0xff, static_cast<size_t>(row.bytes));
    row.cost_pixels(all, 0);
  } else {
    row.cost_pixels(args.own_mask, row.bytes);
  }
}

template <ptrdiff_t kBytes>
void cost_row_of(const CostHammingArgs& args) {
  return args.view == 0 ? cost_row<kBytes, true>(args) : cost_row<kBytes, false>(args);
}

}  // namespace

uint64_t cost_hamming_neon_scratch(const KernelShape& shape) {
  return static_cast<uint32_t>(shape.bits) / 8;  // a mask of all bits
}

void cost_hamming_neon(const CostHammingArgs& args) {
  switch (args.bits / 8) {
    case 16:
      return cost_row_of<16>(args);
    case 32:
      return cost_row_of<32>(args);
    default:
      return cost_row_of<0>(args);
  }
}

}  // namespace bsm
#endif
