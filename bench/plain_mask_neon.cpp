// The plain form of mask_threshold_neon, made of the kernel's own parts.
#include "bench/plain_forms.h"
#include "platform/compiler.h"

#if BSM_ARCH_NEON
// The kernel once more, under a name of its own.
#define mask_threshold_neon mask_threshold_neon_again
#define mask_threshold_neon_scratch mask_threshold_neon_again_scratch
#include "simd/arm/mask_threshold_neon.cpp"

namespace bsm::bench {

void mask_of_all_bits_neon(const MaskThresholdArgs& args) {
  if (args.pattern.bits < kLong) return mask_threshold_neon_again(args);
  Scratch& scratch = *static_cast<Scratch*>(args.scratch);
  list_points(args, scratch);
  const int32_t bits = args.pattern.bits;
  BSM_MEMSET(scratch.many.sad, 0, sizeof scratch.many.sad);
  for (int32_t x = 0; x < args.width; x += kTile) {
    const int32_t pixels = args.width - x < kTile ? args.width - x : kTile;
    const int32_t groups = (pixels + kLanes - 1) / kLanes;
    for (int32_t g = 0; g < groups; ++g) {
      window_sad<kTile>(args, x + g * kLanes, scratch, scratch.many.sad + g * kLanes);
    }
    int32_t top = 8;
    uint8x16_t threshold[kGroups];
    find_thresholds(scratch, bits, groups, &top, threshold);
    find_within(scratch, threshold);
    store_tile(scratch, bits, pixels, args.out + ptrdiff_t{x} * (bits / 8));
    for (int32_t g = 0; g < groups; ++g) store_beyond(args, x + g * kLanes, pixels - g * kLanes, threshold[g], scratch);
  }
}

}  // namespace bsm::bench
#endif
