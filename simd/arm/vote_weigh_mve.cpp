// vote_weigh, MVE: eight taps of a row at once, whose colours, levels and weights are gathered; votes one by one.
// Bound, per eight taps: 2 loads or gathers and 1 a plane, 1 gather for the weights, 9 operations and 1 a plane; a load, an
// addition and a store a vote.
#include "platform/compiler.h"

#if BSM_ARCH_MVE
#include "simd/arm/mve.h"
#include "simd/build.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 8;
constexpr int32_t kMostTaps = 2 * BSM_MAX_VOTE_RADIUS + 1;
constexpr int32_t kTapValues = (kMostTaps + kLanes - 1) / kLanes * kLanes;

// The taps of one row of a window: their exponents by distance, and where they lie.
struct alignas(4) Scratch {
  uint16_t distance[kTapValues];
  uint16_t level[kLanes], weight[kLanes];
};

// The taps begin, begin + step, .. of a window's row that lie in the image.
struct Taps {
  int32_t begin, count;
};

template <int32_t kPlanes>
void collect_row(const VoteWeighArgs& args, int32_t x, int32_t dy, const Taps& taps, const uint8_t* own, Scratch& scratch,
                 uint32_t* votes) {
  const uint16_t* levels = args.levels[dy + args.radius] + taps.begin;
  const uint8_t* lab = args.lab[dy + args.radius] + taps.begin;
  const uint16_t* steps = args.distance_steps + ptrdiff_t{dy < 0 ? -dy : dy} * (args.radius + 1);
  int32_t dx = taps.begin - x;
  for (int32_t i = 0; i < taps.count; ++i, dx += args.step) scratch.distance[i] = steps[dx < 0 ? -dx : dx];
  const uint16x8_t offsets = places(static_cast<uint32_t>(args.step));
  for (int32_t i = 0; i < taps.count; i += kLanes) {
    const mve_pred16_t exist = vctp16q(static_cast<uint32_t>(taps.count - i));
    const ptrdiff_t at = ptrdiff_t{i} * args.step;
    const uint16x8_t level = vldrhq_gather_shifted_offset_z_u16(levels + at, offsets, exist);
    uint16x8_t sad = vdupq_n_u16(0);
    for (int32_t plane = 0; plane < kPlanes; ++plane) {
      const uint8_t* from = lab + plane * args.plane_stride + at;
      sad = vaddq_u16(
          sad, vabdq_u16(vdupq_n_u16(own[plane * args.plane_stride]), vldrbq_gather_offset_z_u16(from, offsets, exist)));
    }
    // (c * scale + 512) >> 10; 16 bits hold the largest, 765 * 65535 >> 10.
    const uint32x4_t even = vmullbq_int_u16(sad, vdupq_n_u16(static_cast<uint16_t>(args.color_scale)));
    const uint32x4_t odd = vmulltq_int_u16(sad, vdupq_n_u16(static_cast<uint16_t>(args.color_scale)));
    const uint16x8_t color = vqrshrntq_n_u32(vqrshrnbq_n_u32(vdupq_n_u16(0), even, 10), odd, 10);
    const uint16x8_t exponent = vqaddq_u16(color, vldrhq_u16(scratch.distance + i));
    const uint32_t none =
        vcmpcsq_n_u16(level, kOccluded) | vcmpcsq_n_u16(exponent, static_cast<uint16_t>(args.weights_count));
    const mve_pred16_t weighs = static_cast<mve_pred16_t>(exist & ~none);
    if (weighs == 0) continue;
    const uint16x8_t weight = vldrhq_gather_shifted_offset_z_u16(args.weights, exponent, weighs);
    vstrhq_u16(scratch.weight, weight);
    vstrhq_u16(scratch.level, vshrq_n_u16(vaddq_n_u16(level, 8), kLevelShift));
    for (uint32_t left = weighs; left != 0;) {
      const int32_t lane = __builtin_ctz(left) / 2;
      votes[scratch.level[lane]] += scratch.weight[lane];
      left &= ~(3u << 2 * lane);
    }
  }
}

template <int32_t kPlanes>
void collect_votes(const VoteWeighArgs& args, int32_t x, Scratch& scratch, uint32_t* votes) {
  const int32_t before = args.radius / args.step;                        // taps on either side
  const int32_t left = x / args.step < before ? x / args.step : before;  // of them inside the image
  const int32_t possible = (args.width - 1 - x) / args.step;
  const int32_t right = possible < before ? possible : before;
  const Taps taps{x - left * args.step, left + 1 + right};
  for (int32_t dy = -args.radius; dy <= args.radius; dy += args.step) {
    if (args.levels[dy + args.radius] == nullptr) continue;
    collect_row<kPlanes>(args, x, dy, taps, args.lab[args.radius] + x, scratch, votes);
  }
}

// The level below `end` with the most votes, in 1/16 pixel.
uint16_t winning_level(const uint32_t* votes, int32_t end) {
  uint32_t most = 0;
  uint16_t winner = kNoLevel;
  for (int32_t level = 0; level < end; ++level) {
    if (votes[level] > most) {
      most = votes[level];
      winner = static_cast<uint16_t>(level << kLevelShift);
    }
  }
  return winner;
}

}  // namespace

uint64_t vote_weigh_mve_scratch(const KernelShape& shape) {
  return sizeof(Scratch) + sizeof(uint32_t) * static_cast<uint32_t>(shape.num_disparities);
}

void vote_weigh_mve(const VoteWeighArgs& args) {
  Scratch& scratch = *static_cast<Scratch*>(args.scratch);
  uint32_t* votes = reinterpret_cast<uint32_t*>(&scratch + 1);
  const uint16_t* levels = args.levels[args.radius];
  for (int32_t x = 0; x < args.width; ++x) {
    args.out[x] = static_cast<uint16_t>(whole_level(levels[x]) << kLevelShift);
    if (levels[x] < kOccluded) continue;
    BSM_MEMSET(votes, 0, sizeof(uint32_t) * static_cast<uint32_t>(args.num_disparities));
    if (kHasColor && args.planes == 3) {
      collect_votes<3>(args, x, scratch, votes);
    } else {
      collect_votes<1>(args, x, scratch, votes);
    }
    const bool capped = args.cap != nullptr && args.cap[x] < args.num_disparities - 1;
    args.out[x] = winning_level(votes, capped ? args.cap[x] + 1 : args.num_disparities);
    if (capped && args.out[x] == kNoLevel) args.out[x] = winning_level(votes, args.num_disparities);
  }
}

}  // namespace bsm
#endif
