// cost_hamming, SVE: as many candidates of a pixel at once as a vector has 64-bit lanes.
// The counts of 64 bits are one instruction; sums of neighbouring lanes bring together the words of a descriptor that has 1,
// 2, 4, 8 or 16 of them. Others are counted one by one. Bound, per vector of a candidate: 1 XOR, 1 AND, 1 population count,
// 3 operations of the sums; 1 load.
#include "platform/compiler.h"

#if BSM_ARCH_SVE
#include "simd/arm/hamming_sve.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

// Costs of the pixels first, first + 1, .. of the other view; zero outside the row.
template <Fit kFit, int32_t kLevel>
BSM_INLINE svuint64_t count_candidates(const CostHammingArgs& args, const uint8_t* own, const uint8_t* mask, int32_t first) {
  constexpr int32_t kBytes = 8 << kLevel;
  const svuint8_t one = load_own<kFit, kBytes>(own, 0);
  const svuint8_t kept = load_own<kFit, kBytes>(mask, 0);
  const int32_t base = first * kBytes;
  const int32_t end = args.width * kBytes;
  return sum_words<kLevel>(
      [&](ptrdiff_t at) {
        const int32_t byte = base + static_cast<int32_t>(at);
        const svbool_t inside = inside8(byte, end);
        const svuint8_t other = svld1(inside, args.other + byte);
        if constexpr (kFit == Fit::kSeveral) {
          return count_words(svand_z(inside, sveor_x(inside, one, other), kept));
        } else {
          const svuint8_t differing = sveor_x(inside, load_own<kFit, kBytes>(own, at), other);
          return count_words(svand_z(inside, differing, load_own<kFit, kBytes>(mask, at)));
        }
      },
      0);
}

template <Fit kFit, int32_t kLevel>
void cost_row(const CostHammingArgs& args, const uint8_t* masks, ptrdiff_t mask_bytes) {
  const int32_t lanes = static_cast<int32_t>(svcntd());
  const bool left = args.view == 0;
  for (int32_t x = 0; x < args.width; ++x) {
    const uint8_t* own = args.own + ptrdiff_t{x} * (8 << kLevel);
    uint16_t* cost = args.cost + ptrdiff_t{x} * args.stride;
    for (int32_t level = 0; level < args.stride; level += lanes) {
      // The first of the others in memory; the left view meets them backwards.
      const int32_t disparity = args.min_disparity + level;
      const int32_t first = left ? x - disparity - (lanes - 1) : x + disparity;
      svuint64_t sums = count_candidates<kFit, kLevel>(args, own, masks + x * mask_bytes, first);
      svbool_t inside = svbic_z(svptrue_b64(), svwhilelt_b64(first, args.width), svwhilelt_b64(first, 0));
      if (left) {
        sums = svrev(sums);
        inside = svrev_b64(inside);
      }
      const svbool_t candidates = svand_z(svptrue_b64(), inside, svwhilelt_b64(level, args.num_disparities));
      svst1h(svwhilelt_b64(level, args.stride), cost + level, svsel(candidates, sums, svdup_u64(kNoCost)));
    }
  }
}

// Descriptors of any length, candidate by candidate.
void cost_any_row(const CostHammingArgs& args, const uint8_t* masks, ptrdiff_t mask_bytes) {
  const int32_t bytes = args.bits / 8;
  for (int32_t x = 0; x < args.width; ++x) {
    const uint8_t* own = args.own + ptrdiff_t{x} * bytes;
    const uint8_t* mask = masks + x * mask_bytes;
    uint16_t* cost = args.cost + ptrdiff_t{x} * args.stride;
    for (int32_t level = 0; level < args.stride; ++level) {
      const int32_t disparity = args.min_disparity + level;
      const int32_t matched = args.view == 0 ? x - disparity : x + disparity;
      cost[level] = kNoCost;
      if (level >= args.num_disparities || matched < 0 || matched >= args.width) continue;
      const uint8_t* other = args.other + ptrdiff_t{matched} * bytes;
      svuint64_t sums = svdup_u64(0);
      for (int32_t at = 0; at < bytes; at += lanes8()) {
        const svbool_t those = svwhilelt_b8(at, bytes);
        const svuint8_t differing = sveor_x(those, svld1(those, own + at), svld1(those, other + at));
        sums = svadd_x(svptrue_b64(), sums, count_words(svand_z(those, differing, svld1(those, mask + at))));
      }
      cost[level] = static_cast<uint16_t>(svaddv(svptrue_b64(), sums));
    }
  }
}

template <int32_t kLevel>
void cost_words_row(const CostHammingArgs& args, const uint8_t* masks, ptrdiff_t mask_bytes) {
  switch (fit_of(8 << kLevel)) {
    case Fit::kSeveral:
      return cost_row<Fit::kSeveral, kLevel>(args, masks, mask_bytes);
    case Fit::kParts:
      return cost_row<Fit::kParts, kLevel>(args, masks, mask_bytes);
    default:
      return cost_any_row(args, masks, mask_bytes);
  }
}

}  // namespace

uint64_t cost_hamming_sve_scratch(const KernelShape& shape) {
  return static_cast<uint32_t>(shape.bits) / 8;  // a mask of all bits
}

void cost_hamming_sve(const CostHammingArgs& args) {
  const uint8_t* masks = args.own_mask;
  ptrdiff_t mask_bytes = args.bits / 8;
  if (masks == nullptr) {
    BSM_MEMSET(args.scratch, 0xff, static_cast<size_t>(mask_bytes));
    masks = static_cast<const uint8_t*>(args.scratch);
    mask_bytes = 0;
  }
  switch (args.bits / 64) {
    case 1:
      return cost_words_row<0>(args, masks, mask_bytes);
    case 2:
      return cost_words_row<1>(args, masks, mask_bytes);
    case 4:
      return cost_words_row<2>(args, masks, mask_bytes);
    case 8:
      return cost_words_row<3>(args, masks, mask_bytes);
    case 16:
      return cost_words_row<4>(args, masks, mask_bytes);
    default:
      return cost_any_row(args, masks, mask_bytes);
  }
}

}  // namespace bsm
#endif
