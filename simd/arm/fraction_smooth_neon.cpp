// fraction_smooth, NEON: eight neighbouring pixels at once.
// Bound, per neighbour and eight pixels: 2 loads, 7 operations. The mean's rounded product is one instruction.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "simd/arm/neon.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 8;
constexpr int32_t kSide = 2 * kFractionRadius + 1;
constexpr int32_t kColumns = kLanes + 2 * kFractionRadius;  // that a group looks at
constexpr uint16_t kSameSurface = 16;                       // sixteenths

struct Scratch {
  uint16_t levels[kSide][kColumns];
  uint8_t weights[kSide][kColumns + kLanes];
  uint16_t out[kLanes];
};

// r(w) in two bytes; a window's weights add up to at most 50.
struct Reciprocals {
  uint8_t low[128], high[128];
};

constexpr Reciprocals make_reciprocals() {
  Reciprocals table{};
  for (int32_t weight = 1; weight <= kSide * kSide * kMaxFractionWeight; ++weight) {
    const int32_t reciprocal = weight == 1 ? 32767 : (32768 + weight / 2) / weight;
    table.low[weight] = static_cast<uint8_t>(reciprocal & 0xff);
    table.high[weight] = static_cast<uint8_t>(reciprocal >> 8);
  }
  return table;
}

constexpr Reciprocals kReciprocals = make_reciprocals();

// Rows of levels and weights; entry x - kFractionRadius is the first that the pixel x looks at.
struct Rows {
  const uint16_t* levels[kSide];
  const uint8_t* weights[kSide];
};

inline int16x8_t reciprocal(const Table128& low, const Table128& high, uint16x8_t weight) {
  const uint8x16_t index = vcombine_u8(vmovn_u16(weight), vdup_n_u8(0));
  const uint16x8_t bytes = vmovl_u8(vget_low_u8(look_up(low, index)));
  return vreinterpretq_s16_u16(vorrq_u16(bytes, vshll_n_u8(vget_low_u8(look_up(high, index)), 8)));
}

inline uint16x8_t smooth_eight(const Rows& rows, ptrdiff_t x, const Table128& low, const Table128& high) {
  const uint16x8_t own = vld1q_u16(rows.levels[kFractionRadius] + x);
  int16x8_t difference = vdupq_n_s16(0);
  uint16x8_t weight = vdupq_n_u16(0);
  for (int32_t row = 0; row < kSide; ++row) {
    if (rows.levels[row] == nullptr) continue;
    BSM_UNROLL
    for (int32_t dx = -kFractionRadius; dx <= kFractionRadius; ++dx) {
      const uint16x8_t level = vld1q_u16(rows.levels[row] + x + dx);
      const uint16x8_t same = vcleq_u16(vabdq_u16(level, own), vdupq_n_u16(kSameSurface));
      const uint16x8_t kept = vandq_u16(vmovl_u8(vld1_u8(rows.weights[row] + x + dx)), same);
      const int16x8_t above = vreinterpretq_s16_u16(vsubq_u16(level, own));
      difference = vmlaq_s16(difference, above, vreinterpretq_s16_u16(kept));
      weight = vaddq_u16(weight, kept);
    }
  }
  // (2 e r + 2^15) >> 16
  const int16x8_t mean = vqrdmulhq_s16(difference, reciprocal(low, high, weight));
  return vaddq_u16(own, vreinterpretq_u16_s16(mean));
}

// The rows around eight pixels of which some look beyond the row: nothing weighs there.
void copy_window(const FractionSmoothArgs& args, int32_t x, Scratch& scratch, Rows& rows) {
  for (int32_t row = 0; row < kSide; ++row) {
    rows.levels[row] = nullptr;
    if (args.levels[row] == nullptr) continue;
    for (int32_t i = 0; i < kColumns; ++i) {
      const int32_t column = x - kFractionRadius + i;
      const bool inside = column >= 0 && column < args.width;
      scratch.levels[row][i] = inside ? args.levels[row][column] : 0;
      scratch.weights[row][i] = inside ? args.weights[row][column] : 0;
    }
    rows.levels[row] = scratch.levels[row] + kFractionRadius;
    rows.weights[row] = scratch.weights[row] + kFractionRadius;
  }
}

}  // namespace

uint64_t fraction_smooth_neon_scratch(const KernelShape&) {
  return sizeof(Scratch);
}

void fraction_smooth_neon(const FractionSmoothArgs& args) {
  Scratch& scratch = *static_cast<Scratch*>(args.scratch);
  const Table128 low = load_table128(kReciprocals.low);
  const Table128 high = load_table128(kReciprocals.high);
  Rows rows;
  for (int32_t row = 0; row < kSide; ++row) {
    rows.levels[row] = args.levels[row];
    rows.weights[row] = args.weights[row];
  }
  for (int32_t x = 0; x < args.width; x += kLanes) {
    if (x >= kFractionRadius && x + kLanes + kFractionRadius <= args.width) {
      vst1q_u16(args.out + x, smooth_eight(rows, x, low, high));
      continue;
    }
    Rows ends;
    copy_window(args, x, scratch, ends);
    vst1q_u16(scratch.out, smooth_eight(ends, 0, low, high));
    for (int32_t i = 0; i < kLanes && x + i < args.width; ++i) args.out[x + i] = scratch.out[i];
  }
}

}  // namespace bsm
#endif
