// vote_weigh, NEON: exponents of eight neighbours at once, weights one by one.
// Neighbours mostly hold one level: the weights of eight such are added up before they vote; eight without any weight are
// left out. Bound, per neighbour: extraction, look-up and addition of its weight. Windows whose taps lie apart have few of
// them and go tap by tap.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "simd/arm/neon.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 8;
constexpr int32_t kMaxWeights = 1024;
constexpr int32_t kCenter = BSM_MAX_VOTE_RADIUS + kLanes;

struct Scratch {
  uint16_t distance[BSM_MAX_VOTE_RADIUS + 1]
                   [2 * kCenter];  // exponents by |dy| and kCenter + dx; no weight outside the window
  uint16_t weights[kMaxWeights + 1];
};

struct Ballot {
  const VoteWeighArgs& args;
  const Scratch& scratch;
  uint32_t* votes;
};

void prepare(const VoteWeighArgs& args, Scratch& scratch) {
  BSM_MEMSET(scratch.weights, 0, sizeof scratch.weights);
  BSM_MEMCPY(scratch.weights, args.weights, sizeof(uint16_t) * static_cast<size_t>(args.weights_count));
  for (int32_t dy = 0; dy <= args.radius; ++dy) {
    BSM_MEMSET(scratch.distance[dy], 0xff, sizeof scratch.distance[dy]);
    const uint16_t* steps = args.distance_steps + ptrdiff_t{dy} * (args.radius + 1);
    for (int32_t dx = 0; dx <= args.radius; ++dx) {
      scratch.distance[dy][kCenter + dx] = scratch.distance[dy][kCenter - dx] = steps[dx];
    }
  }
}

// Sum of the weights of eight exponents, none above kMaxWeights.
inline uint32_t sum_weights(const uint16_t* weights, uint16x8_t exponent) {
  return uint32_t{weights[vgetq_lane_u16(exponent, 0)]} + weights[vgetq_lane_u16(exponent, 1)] +
         weights[vgetq_lane_u16(exponent, 2)] + weights[vgetq_lane_u16(exponent, 3)] + weights[vgetq_lane_u16(exponent, 4)] +
         weights[vgetq_lane_u16(exponent, 5)] + weights[vgetq_lane_u16(exponent, 6)] + weights[vgetq_lane_u16(exponent, 7)];
}

template <int32_t kLane>
inline void vote(const Ballot& ballot, uint16x8_t level, uint16x8_t exponent) {
  ballot.votes[vgetq_lane_u16(level, kLane)] += ballot.scratch.weights[vgetq_lane_u16(exponent, kLane)];
}

// Votes of the columns begin..end-1 of row dy.
template <int32_t kPlanes>
inline void collect_row(const Ballot& ballot, int32_t x, int32_t dy, int32_t begin, int32_t end,
                        const uint8x8_t (&center)[kPlanes]) {
  alignas(16) static constexpr uint16_t kColumn[kLanes] = {0, 1, 2, 3, 4, 5, 6, 7};
  const VoteWeighArgs& args = ballot.args;
  const uint16_t* levels = args.levels[dy + args.radius];
  const uint8_t* lab = args.lab[dy + args.radius];
  const uint16_t* distances = ballot.scratch.distance[dy < 0 ? -dy : dy] + kCenter - x;
  const uint16x4_t scale = vdup_n_u16(static_cast<uint16_t>(args.color_scale));
  const uint16x8_t most = vdupq_n_u16(kMaxWeights);
  for (int32_t i = begin / kLanes * kLanes; i < end; i += kLanes) {
    uint16x8_t sad = vabdl_u8(center[0], vld1_u8(lab + i));
    for (int32_t plane = 1; plane < kPlanes; ++plane) {
      sad = vabal_u8(sad, center[plane], vld1_u8(lab + plane * args.plane_stride + i));
    }
    const uint16x8_t steps = vcombine_u16(vrshrn_n_u32(vmull_u16(vget_low_u16(sad), scale), 10),
                                          vrshrn_n_u32(vmull_u16(vget_high_u16(sad), scale), 10));
    const uint16x8_t level = vld1q_u16(levels + i);
    uint16x8_t missing = vcgeq_u16(level, vdupq_n_u16(kOccluded));
    if (i + kLanes > end) {  // columns beyond the row
      missing = vorrq_u16(missing, vcgeq_u16(vld1q_u16(kColumn), vdupq_n_u16(static_cast<uint16_t>(end - i))));
    }
    const uint16x8_t exponent = vminq_u16(vorrq_u16(vqaddq_u16(steps, vld1q_u16(distances + i)), missing), most);
    if (least16(exponent) >= args.weights_count) continue;
    const uint16x8_t whole = vshrq_n_u16(vaddq_u16(level, vdupq_n_u16(8)), kLevelShift);
    const uint16_t lowest = least16(vorrq_u16(whole, missing));
    const uint16_t highest = most16(vbicq_u16(whole, missing));
    if (lowest == highest) {
      ballot.votes[lowest] += sum_weights(ballot.scratch.weights, exponent);
      continue;
    }
    const uint16x8_t voted = vbslq_u16(missing, vdupq_n_u16(lowest), whole);  // with no weight
    vote<0>(ballot, voted, exponent);
    vote<1>(ballot, voted, exponent);
    vote<2>(ballot, voted, exponent);
    vote<3>(ballot, voted, exponent);
    vote<4>(ballot, voted, exponent);
    vote<5>(ballot, voted, exponent);
    vote<6>(ballot, voted, exponent);
    vote<7>(ballot, voted, exponent);
  }
}

// The taps of row dy that lie apart, from begin to end.
template <int32_t kPlanes>
inline void collect_taps(const Ballot& ballot, int32_t x, int32_t dy, int32_t begin, int32_t end) {
  const VoteWeighArgs& args = ballot.args;
  const uint16_t* levels = args.levels[dy + args.radius];
  const uint8_t* lab = args.lab[dy + args.radius];
  const uint8_t* own = args.lab[args.radius] + x;
  const uint16_t* distances = ballot.scratch.distance[dy < 0 ? -dy : dy] + kCenter - x;
  for (int32_t i = begin; i < end; i += args.step) {
    if (levels[i] >= kOccluded) continue;
    uint32_t sad = 0;
    for (int32_t plane = 0; plane < kPlanes; ++plane) {
      const int32_t difference = own[plane * args.plane_stride] - lab[plane * args.plane_stride + i];
      sad += static_cast<uint32_t>(difference < 0 ? -difference : difference);
    }
    const uint32_t exponent = ((sad * args.color_scale + 512) >> 10) + distances[i];
    if (exponent < kMaxWeights) ballot.votes[whole_level(levels[i])] += ballot.scratch.weights[exponent];
  }
}

template <int32_t kPlanes>
void collect_window(const Ballot& ballot, int32_t x) {
  const VoteWeighArgs& args = ballot.args;
  BSM_MEMSET(ballot.votes, 0, sizeof(uint32_t) * static_cast<size_t>(args.num_disparities));
  uint8x8_t center[kPlanes];
  for (int32_t plane = 0; plane < kPlanes; ++plane) {
    center[plane] = vdup_n_u8(args.lab[args.radius][x + plane * args.plane_stride]);
  }
  int32_t begin = x - args.radius;
  if (begin < 0) begin = args.step == 1 ? 0 : begin + (-begin + args.step - 1) / args.step * args.step;
  const int32_t end = x + args.radius < args.width ? x + args.radius + 1 : args.width;
  for (int32_t dy = -args.radius; dy <= args.radius; dy += args.step) {
    if (args.levels[dy + args.radius] == nullptr) continue;
    if (args.step == 1) {
      collect_row<kPlanes>(ballot, x, dy, begin, end, center);
    } else {
      collect_taps<kPlanes>(ballot, x, dy, begin, end);
    }
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

template <int32_t kPlanes>
void vote_row(const Ballot& ballot) {
  const VoteWeighArgs& args = ballot.args;
  const uint16_t* levels = args.levels[args.radius];
  for (int32_t x = 0; x < args.width; ++x) {
    args.out[x] = static_cast<uint16_t>(whole_level(levels[x]) << kLevelShift);
    if (levels[x] < kOccluded) continue;
    collect_window<kPlanes>(ballot, x);
    const bool capped = args.cap != nullptr && args.cap[x] < args.num_disparities - 1;
    args.out[x] = winning_level(ballot.votes, capped ? args.cap[x] + 1 : args.num_disparities);
    if (capped && args.out[x] == kNoLevel) args.out[x] = winning_level(ballot.votes, args.num_disparities);
  }
}

}  // namespace

uint64_t vote_weigh_neon_scratch(const KernelShape& shape) {
  return sizeof(Scratch) + sizeof(uint32_t) * static_cast<uint64_t>(shape.num_disparities + 1);
}

void vote_weigh_neon(const VoteWeighArgs& args) {
  Scratch& scratch = *static_cast<Scratch*>(args.scratch);
  prepare(args, scratch);
  uint32_t* votes = static_cast<uint32_t*>(args.scratch) + (sizeof(Scratch) + 3) / 4;
  const Ballot ballot{args, scratch, votes};
  if (args.planes == 3) {
    vote_row<3>(ballot);
  } else {
    vote_row<1>(ballot);
  }
}

}  // namespace bsm
#endif
