// cost_hamming, scalar: masked costs of all candidates of one row, both views (eq. 4, 8).
#include "simd/kernels.h"
#include "simd/scalar/bits.h"

namespace bsm {
namespace {

constexpr uint64_t kAll = ~uint64_t{0};

// Differing bits of two descriptors under a mask; nullptr: all bits count.
uint16_t hamming(const uint8_t* a, const uint8_t* b, const uint8_t* mask, int32_t bytes) {
  uint32_t count = 0;
  for (int32_t i = 0; i < bytes; i += 8) {
    const uint64_t kept = mask != nullptr ? load_bits(mask + i) : kAll;
    count += count_bits((load_bits(a + i) ^ load_bits(b + i)) & kept);
  }
  return static_cast<uint16_t>(count);
}

}  // namespace

uint64_t cost_hamming_scalar_scratch(const KernelShape&) {
  return 0;
}

void cost_hamming_scalar(const CostHammingArgs& args) {
  const int32_t bytes = args.bits / 8;
  for (int32_t x = 0; x < args.width; ++x) {
    uint16_t* costs = args.cost + ptrdiff_t{x} * args.stride;
    const ptrdiff_t at = ptrdiff_t{x} * bytes;
    for (int32_t level = 0; level < args.stride; ++level) {
      const int32_t disparity = args.min_disparity + level;
      const int32_t matched = args.view == 0 ? x - disparity : x + disparity;
      const bool candidate = level < args.num_disparities && matched >= 0 && matched < args.width;
      costs[level] = candidate ? hamming(args.own + at, args.other + ptrdiff_t{matched} * bytes,
                                         args.own_mask != nullptr ? args.own_mask + at : nullptr, bytes)
                               : kNoCost;
    }
  }
}

}  // namespace bsm
