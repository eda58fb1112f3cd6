// mask_threshold, scalar: the pairs that look like the centre, those with w_i <= T (eq. 5-7).
#include "platform/compiler.h"
#include "simd/kernels.h"
#include "simd/scalar/sad.h"

namespace bsm {
namespace {

constexpr uint16_t kUnused = 0xffff;  // SAD of an offset that is in no pair

struct Scratch {
  uint16_t sad[kMaxWindowSide * kMaxWindowSide];  // SAD(x, x + offset), row by row of the window (eq. 5)
  uint16_t histogram[kMaxSad + 1];                // how many pairs have w_i = index
};

// center points at the middle of the window's SADs.
void mark_used(const Pattern& pattern, int32_t side, uint16_t* center) {
  const int32_t last = side * side / 2;
  for (int32_t i = -last; i <= last; ++i) center[i] = kUnused;
  for (const PixelPair* pair = pattern.pairs; pair != pattern.pairs + pattern.bits; ++pair) {
    center[pair->py * side + pair->px] = center[pair->qy * side + pair->qx] = 0;
  }
}

void window_sad(const MaskThresholdArgs& args, int32_t x, uint16_t* window) {
  const int32_t radius = args.pattern.radius;
  const uint8_t* center = args.rows[radius] + x;
  for (int32_t dy = 0; dy <= 2 * radius; ++dy) {
    const uint8_t* row = args.rows[dy] + x - radius;
    for (int32_t dx = 0; dx <= 2 * radius; ++dx, ++window) {
      if (*window != kUnused) *window = static_cast<uint16_t>(sad(center, row + dx, args.plane_stride, args.planes));
    }
  }
}

// w_i (eq. 6).
uint32_t pair_weight(const uint16_t* center, int32_t side, const PixelPair& pair) {
  const uint32_t p = center[pair.py * side + pair.px];
  const uint32_t q = center[pair.qy * side + pair.qx];
  return p < q ? q : p;
}

// T: the smallest value that at least `wanted` of the counted weights do not exceed.
uint32_t smallest_threshold(const uint16_t* histogram, int32_t wanted) {
  uint32_t threshold = 0;
  int32_t counted = histogram[0];
  while (counted < wanted) counted += histogram[++threshold];
  return threshold;
}

}  // namespace

uint64_t mask_threshold_scalar_scratch(const KernelShape&) {
  return sizeof(Scratch);
}

void mask_threshold_scalar(const MaskThresholdArgs& args) {
  Scratch& scratch = *static_cast<Scratch*>(args.scratch);
  const Pattern pattern = args.pattern;
  const int32_t side = 2 * pattern.radius + 1;
  uint16_t* const center = scratch.sad + pattern.radius * side + pattern.radius;
  mark_used(pattern, side, center);
  uint8_t* out = args.out;
  for (int32_t x = 0; x < args.width; ++x) {
    window_sad(args, x, scratch.sad);
    BSM_MEMSET(scratch.histogram, 0, sizeof scratch.histogram);
    for (int32_t i = 0; i < pattern.bits; ++i) ++scratch.histogram[pair_weight(center, side, pattern.pairs[i])];
    const uint32_t threshold = smallest_threshold(scratch.histogram, pattern.bits / 4);
    for (const PixelPair* pairs = pattern.pairs; pairs != pattern.pairs + pattern.bits; pairs += 8) {
      uint32_t bits = 0;
      for (int32_t i = 7; i >= 0; --i) bits = 2 * bits + (pair_weight(center, side, pairs[i]) <= threshold ? 1u : 0u);
      *out++ = static_cast<uint8_t>(bits);
    }
  }
}

}  // namespace bsm
