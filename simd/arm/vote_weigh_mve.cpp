// vote_weigh, MVE: eight taps of a row at once, whose colours, levels and weights are gathered; votes one by one.
// Bound, per eight taps: 1 load, 3 gathers and 1 a plane, 9 operations and 2 a plane; 3 loads, an addition and a store a
// vote.
#include "platform/compiler.h"

#if BSM_ARCH_MVE
#include <arm_acle.h>

#include "simd/arm/mve.h"
#include "simd/build.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 8;
constexpr int32_t kMostTaps = 2 * BSM_MAX_VOTE_RADIUS + 1;
constexpr int32_t kTapValues = (kMostTaps + kLanes - 1) / kLanes * kLanes;

struct alignas(4) Scratch {
  uint16_t distance[kTapValues];  // |dx| of the taps of a row
  uint16_t level[kLanes], weight[kLanes];
};

// The taps begin, begin + step, .. of a window's row that lie in the image.
struct Taps {
  int32_t begin, count;
};

// One tap: the last of a row, where it is left over, as of windows with eight others.
template <int32_t kPlanes>
inline void collect_tap(const VoteWeighArgs& args, uint32_t level, const uint8_t* lab, const uint8_t* own, uint32_t distance,
                        uint32_t* votes) {
  if (level >= kOccluded) return;
  uint32_t sad = 0;
  BSM_UNROLL
  for (int32_t plane = 0; plane < kPlanes; ++plane) {
    sad = __usada8(own[plane * args.plane_stride], lab[plane * args.plane_stride], sad);
  }
  const uint32_t exponent = ((sad * args.color_scale + 512) >> 10) + distance;
  if (exponent < static_cast<uint32_t>(args.weights_count)) {
    votes[whole_level(static_cast<uint16_t>(level))] += args.weights[exponent];
  }
}

template <int32_t kPlanes>
inline void collect_row(const VoteWeighArgs& args, int32_t dy, const Taps& taps, const uint8_t* center,
                        const uint16x8_t (&own)[kPlanes], Scratch& scratch, uint32_t* votes) {
  const uint16_t* levels = args.levels[dy + args.radius] + taps.begin;
  const uint8_t* lab = args.lab[dy + args.radius] + taps.begin;
  const uint16_t* steps = args.distance_steps + ptrdiff_t{dy < 0 ? -dy : dy} * (args.radius + 1);
  const uint16x8_t offsets = places(static_cast<uint32_t>(args.step));
  int32_t count = taps.count;
  if (count % kLanes == 1) {
    const ptrdiff_t at = ptrdiff_t{--count} * args.step;
    collect_tap<kPlanes>(args, levels[at], lab + at, center, steps[scratch.distance[count]], votes);
  }
  for (int32_t i = 0; i < count; i += kLanes) {
    const mve_pred16_t exist = vctp16q(static_cast<uint32_t>(count - i));
    const ptrdiff_t at = ptrdiff_t{i} * args.step;
    const uint16x8_t level = vldrhq_gather_shifted_offset_z_u16(levels + at, offsets, exist);
    uint16x8_t sad = vdupq_n_u16(0);
    BSM_UNROLL
    for (int32_t plane = 0; plane < kPlanes; ++plane) {
      const uint8_t* from = lab + plane * args.plane_stride + at;
      sad = vaddq_u16(sad, vabdq_u16(own[plane], vldrbq_gather_offset_z_u16(from, offsets, exist)));
    }
    // (c * scale + 512) >> 10; 16 bits hold the largest, 765 * 65535 >> 10.
    const uint32x4_t even = vmullbq_int_u16(sad, vdupq_n_u16(static_cast<uint16_t>(args.color_scale)));
    const uint32x4_t odd = vmulltq_int_u16(sad, vdupq_n_u16(static_cast<uint16_t>(args.color_scale)));
    const uint16x8_t color = vqrshrntq_n_u32(vqrshrnbq_n_u32(vdupq_n_u16(0), even, 10), odd, 10);
    const uint16x8_t distance = vldrhq_gather_shifted_offset_z_u16(steps, vldrhq_u16(scratch.distance + i), exist);
    const uint16x8_t exponent = vqaddq_u16(color, distance);
    const uint32_t none =
        vcmpcsq_n_u16(level, kOccluded) | vcmpcsq_n_u16(exponent, static_cast<uint16_t>(args.weights_count));
    const mve_pred16_t weighs = static_cast<mve_pred16_t>(exist & ~none);
    if (weighs == 0) continue;
    const uint16x8_t weight = vldrhq_gather_shifted_offset_z_u16(args.weights, exponent, weighs);
    const uint16x8_t whole = vshrq_n_u16(vaddq_n_u16(level, 8), kLevelShift);
    vstrhq_u16(scratch.weight, weight);
    vstrhq_u16(scratch.level, vpselq_u16(whole, vdupq_n_u16(0), weighs));  // where nothing weighs, level 0 gets nothing
    BSM_UNROLL
    for (int32_t lane = 0; lane < kLanes; ++lane) votes[scratch.level[lane]] += scratch.weight[lane];
  }
}

template <int32_t kPlanes>
void collect_votes(const VoteWeighArgs& args, int32_t x, Scratch& scratch, uint32_t* votes) {
  const int32_t before = args.radius / args.step;                        // taps on either side
  const int32_t left = x / args.step < before ? x / args.step : before;  // of them inside the image
  const int32_t possible = (args.width - 1 - x) / args.step;
  const int32_t right = possible < before ? possible : before;
  const Taps taps{x - left * args.step, left + 1 + right};
  for (int32_t i = 0; i < taps.count; ++i) {
    scratch.distance[i] = static_cast<uint16_t>((i < left ? left - i : i - left) * args.step);
  }
  const uint8_t* lab = args.lab[args.radius] + x;
  uint16x8_t own[kPlanes];
  for (int32_t plane = 0; plane < kPlanes; ++plane) own[plane] = vdupq_n_u16(lab[plane * args.plane_stride]);
  for (int32_t dy = -args.radius; dy <= args.radius; dy += args.step) {
    if (args.levels[dy + args.radius] == nullptr) continue;
    collect_row<kPlanes>(args, dy, taps, lab, own, scratch, votes);
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
    for (int32_t level = 0; level < args.num_disparities; level += 4) {
      vstrwq_p_u32(votes + level, vdupq_n_u32(0), vctp32q(static_cast<uint32_t>(args.num_disparities - level)));
    }
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
