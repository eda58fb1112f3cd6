// fraction_smooth, NEON: sixteen neighbouring pixels at once. Differences that count, and sums of weights, fit a byte.
// Bound, per neighbour and sixteen pixels: 3 loads, 10 operations. The mean's rounded product is one instruction.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "simd/arm/columns.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 16;
constexpr int32_t kSide = 2 * kFractionRadius + 1;
constexpr int32_t kColumns = kLanes + 2 * kFractionRadius;  // that a group looks at
constexpr uint8_t kSameSurface = 16;                        // sixteenths

struct Scratch {
  uint16_t levels[kSide][kColumns + kColumnsAtOnce];
  uint8_t weights[kSide][kColumns + kColumnsAtOnce];
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

// (2 e r + 2^15) >> 16 for sums e of eight pixels, r in two bytes.
inline uint16x8_t mean(int16x8_t difference, uint8x8_t low, uint8x8_t high) {
  const uint16x8_t reciprocal = vorrq_u16(vmovl_u8(low), vshll_n_u8(high, 8));
  return vreinterpretq_u16_s16(vqrdmulhq_s16(difference, vreinterpretq_s16_u16(reciprocal)));
}

// Levels stay so far below 2^16 that a difference which wraps is not a small one.
inline int8x8_t difference_from(uint16x8_t own, const uint16_t* level) {
  return vqmovn_s16(vreinterpretq_s16_u16(vsubq_u16(vld1q_u16(level), own)));
}

inline void smooth_sixteen(const Rows& rows, ptrdiff_t x, const Table128& low, const Table128& high, uint16_t* out) {
  const uint16x8_t own[2] = {vld1q_u16(rows.levels[kFractionRadius] + x), vld1q_u16(rows.levels[kFractionRadius] + x + 8)};
  int16x8_t difference[2] = {vdupq_n_s16(0), vdupq_n_s16(0)};
  uint8x16_t weight = vdupq_n_u8(0);
  for (int32_t row = 0; row < kSide; ++row) {
    if (rows.levels[row] == nullptr) continue;
    const uint16_t* const levels = rows.levels[row] + x;
    const uint8_t* const weights = rows.weights[row] + x;
    BSM_UNROLL
    for (int32_t dx = -kFractionRadius; dx <= kFractionRadius; ++dx) {
      const int8x16_t above = vcombine_s8(difference_from(own[0], levels + dx), difference_from(own[1], levels + dx + 8));
      const uint8x16_t same = vcleq_u8(vreinterpretq_u8_s8(vabsq_s8(above)), vdupq_n_u8(kSameSurface));
      const uint8x16_t kept = vandq_u8(vld1q_u8(weights + dx), same);
      const int8x16_t factor = vreinterpretq_s8_u8(kept);
      difference[0] = vmlal_s8(difference[0], vget_low_s8(above), vget_low_s8(factor));
      difference[1] = vmlal_s8(difference[1], vget_high_s8(above), vget_high_s8(factor));
      weight = vaddq_u8(weight, kept);
    }
  }
  const uint8x16_t low_bytes = look_up(low, weight);
  const uint8x16_t high_bytes = look_up(high, weight);
  vst1q_u16(out, vaddq_u16(own[0], mean(difference[0], vget_low_u8(low_bytes), vget_low_u8(high_bytes))));
  vst1q_u16(out + 8, vaddq_u16(own[1], mean(difference[1], vget_high_u8(low_bytes), vget_high_u8(high_bytes))));
}

// The rows around sixteen pixels of which some look beyond the row: nothing weighs there.
void copy_window(const FractionSmoothArgs& args, int32_t x, Scratch& scratch, Rows& rows) {
  for (int32_t row = 0; row < kSide; ++row) {
    rows.levels[row] = nullptr;
    if (args.levels[row] == nullptr) continue;
    const int32_t first = x - kFractionRadius;
    copy_columns(args.levels[row], args.width, first, kColumns, uint16_t{0}, uint16_t{0}, scratch.levels[row]);
    copy_columns(args.weights[row], args.width, first, kColumns, uint8_t{0}, uint8_t{0}, scratch.weights[row]);
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
      smooth_sixteen(rows, x, low, high, args.out + x);
      continue;
    }
    Rows ends;
    copy_window(args, x, scratch, ends);
    smooth_sixteen(ends, 0, low, high, scratch.out);
    for (int32_t i = 0; i < kLanes && x + i < args.width; ++i) args.out[x + i] = scratch.out[i];
  }
}

}  // namespace bsm
#endif
