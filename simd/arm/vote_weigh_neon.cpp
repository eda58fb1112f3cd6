// vote_weigh, NEON: exponents of eight neighbours at once, weights one by one.
// Neighbours mostly hold one level: the weights of eight such are added up before they vote; eight without any weight are
// left out. Bound, per neighbour: extraction, look-up and addition of its weight. Windows whose taps lie apart go tap by
// tap, for eight pixels at once where at least kFewPixels of them want votes.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "simd/arm/neon.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 8;
constexpr int32_t kFewPixels = 3;
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
  uint32_t* votes;  // by level; those of the next pixels of a group follow
};

void prepare(const VoteWeighArgs& args, Scratch& scratch) {
  BSM_MEMSET(scratch.weights, 0, sizeof scratch.weights);
  BSM_MEMCPY(scratch.weights, args.weights, sizeof(uint16_t) * static_cast<size_t>(args.weights_count));
  for (int32_t dy = 0; dy <= args.radius; dy += args.step) {
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
inline void vote(uint32_t* votes, const uint16_t* weights, uint16x8_t level, uint16x8_t exponent) {
  votes[vgetq_lane_u16(level, kLane)] += weights[vgetq_lane_u16(exponent, kLane)];
}

// Eight votes; those of a pixel lie `pixel` after the one before.
inline void vote_all(uint32_t* votes, ptrdiff_t pixel, const uint16_t* weights, uint16x8_t level, uint16x8_t exponent) {
  vote<0>(votes, weights, level, exponent);
  vote<1>(votes + pixel, weights, level, exponent);
  vote<2>(votes + 2 * pixel, weights, level, exponent);
  vote<3>(votes + 3 * pixel, weights, level, exponent);
  vote<4>(votes + 4 * pixel, weights, level, exponent);
  vote<5>(votes + 5 * pixel, weights, level, exponent);
  vote<6>(votes + 6 * pixel, weights, level, exponent);
  vote<7>(votes + 7 * pixel, weights, level, exponent);
}

// Exponents of eight SADs in table steps.
inline uint16x8_t color_steps(uint16x8_t sad, uint16x4_t scale) {
  return vcombine_u16(vrshrn_n_u32(vmull_u16(vget_low_u16(sad), scale), 10),
                      vrshrn_n_u32(vmull_u16(vget_high_u16(sad), scale), 10));
}

inline uint16x8_t whole_levels(uint16x8_t sixteenths) {
  return vshrq_n_u16(vaddq_u16(sixteenths, vdupq_n_u16(8)), kLevelShift);
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
    const uint16x8_t steps = color_steps(sad, scale);
    const uint16x8_t level = vld1q_u16(levels + i);
    uint16x8_t missing = vcgeq_u16(level, vdupq_n_u16(kOccluded));
    if (i + kLanes > end) {  // columns beyond the row
      missing = vorrq_u16(missing, vcgeq_u16(vld1q_u16(kColumn), vdupq_n_u16(static_cast<uint16_t>(end - i))));
    }
    uint16x8_t exponent = vminq_u16(vorrq_u16(vqaddq_u16(steps, vld1q_u16(distances + i)), missing), most);
    if (least16(exponent) >= args.weights_count) continue;
    exponent = taken_here(exponent);
    const uint16x8_t whole = whole_levels(level);
    const uint16_t lowest = least16(vorrq_u16(whole, missing));
    const uint16_t highest = most16(vbicq_u16(whole, missing));
    if (lowest == highest) {
      ballot.votes[lowest] += sum_weights(ballot.scratch.weights, exponent);
      continue;
    }
    const uint16x8_t voted = taken_here(vbslq_u16(missing, vdupq_n_u16(lowest), whole));  // with no weight
    vote_all(ballot.votes, 0, ballot.scratch.weights, voted, exponent);
  }
}

// The tap of pixel x at column `at` of row dy.
template <int32_t kPlanes>
inline void collect_tap(const Ballot& ballot, uint32_t* votes, int32_t x, int32_t dy, int32_t at) {
  const VoteWeighArgs& args = ballot.args;
  const uint16_t level = args.levels[dy + args.radius][at];
  if (level >= kOccluded) return;
  const uint8_t* lab = args.lab[dy + args.radius];
  const uint8_t* own = args.lab[args.radius] + x;
  uint32_t sad = 0;
  for (int32_t plane = 0; plane < kPlanes; ++plane) {
    const int32_t difference = own[plane * args.plane_stride] - lab[plane * args.plane_stride + at];
    sad += static_cast<uint32_t>(difference < 0 ? -difference : difference);
  }
  const uint16_t distance = ballot.scratch.distance[dy < 0 ? -dy : dy][kCenter + at - x];
  const uint32_t exponent = ((sad * args.color_scale + 512) >> 10) + distance;
  if (exponent < kMaxWeights) votes[whole_level(level)] += ballot.scratch.weights[exponent];
}

// Votes of the pixels x..x + 7 in a window whose taps lie apart.
template <int32_t kPlanes>
void collect_group(const Ballot& ballot, int32_t x) {
  const VoteWeighArgs& args = ballot.args;
  const ptrdiff_t stride = args.plane_stride;
  const ptrdiff_t pixel = args.num_disparities;
  const uint16x4_t scale = vdup_n_u16(static_cast<uint16_t>(args.color_scale));
  const uint16x8_t most = vdupq_n_u16(kMaxWeights);
  BSM_MEMSET(ballot.votes, 0, kLanes * sizeof(uint32_t) * static_cast<size_t>(args.num_disparities));
  uint8x8_t center[kPlanes];
  for (int32_t plane = 0; plane < kPlanes; ++plane) center[plane] = vld1_u8(args.lab[args.radius] + x + plane * stride);
  for (int32_t dy = -args.radius; dy <= args.radius; dy += args.step) {
    const uint16_t* levels = args.levels[dy + args.radius];
    if (levels == nullptr) continue;
    const uint8_t* lab = args.lab[dy + args.radius];
    const uint16_t* distances = ballot.scratch.distance[dy < 0 ? -dy : dy] + kCenter;
    for (int32_t dx = -args.radius; dx <= args.radius; dx += args.step) {
      const int32_t at = x + dx;
      if (at < 0 || at + kLanes > args.width) {  // some lie outside the row, or all
        for (int32_t i = 0; i < kLanes; ++i) {
          if (at + i >= 0 && at + i < args.width) collect_tap<kPlanes>(ballot, ballot.votes + i * pixel, x + i, dy, at + i);
        }
        continue;
      }
      uint16x8_t sad = vabdl_u8(center[0], vld1_u8(lab + at));
      for (int32_t plane = 1; plane < kPlanes; ++plane) {
        sad = vabal_u8(sad, center[plane], vld1_u8(lab + plane * stride + at));
      }
      const uint16x8_t level = vld1q_u16(levels + at);
      const uint16x8_t missing = vcgeq_u16(level, vdupq_n_u16(kOccluded));  // whole_levels makes 0 of it
      const uint16x8_t steps = vqaddq_u16(color_steps(sad, scale), vdupq_n_u16(distances[dx]));
      const uint16x8_t exponent = vminq_u16(vorrq_u16(steps, missing), most);
      vote_all(ballot.votes, pixel, ballot.scratch.weights, whole_levels(level), exponent);
    }
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
      for (int32_t at = begin; at < end; at += args.step) collect_tap<kPlanes>(ballot, ballot.votes, x, dy, at);
    }
  }
}

// The level below `end` with the most votes, in 1/16 pixel.
uint16_t winning_level(const uint32_t* votes, int32_t end) {
  uint32x4_t four = vdupq_n_u32(0);
  int32_t level = 0;
  for (; level + 4 <= end; level += 4) four = vmaxq_u32(four, vld1q_u32(votes + level));
  uint32_t most = most32(four);
  for (; level < end; ++level) most = votes[level] > most ? votes[level] : most;
  if (most == 0) return kNoLevel;
  level = 0;
  while (votes[level] != most) ++level;
  return static_cast<uint16_t>(level << kLevelShift);
}

// The level of pixel x from its votes.
void elect(const VoteWeighArgs& args, const uint32_t* votes, int32_t x) {
  const bool capped = args.cap != nullptr && args.cap[x] < args.num_disparities - 1;
  args.out[x] = winning_level(votes, capped ? args.cap[x] + 1 : args.num_disparities);
  if (capped && args.out[x] == kNoLevel) args.out[x] = winning_level(votes, args.num_disparities);
}

// Of the pixels first..first + 7, a bit for each from x on that has no level.
inline uint32_t missing_levels(const uint16_t* levels, int32_t first, int32_t x) {
  uint32_t missing = 0;
  for (int32_t i = x - first; i < kLanes; ++i) missing |= (levels[first + i] >= kOccluded ? 1u : 0u) << i;
  return missing;
}

// All levels to whole ones.
void round_levels(const uint16_t* levels, int32_t width, uint16_t* out) {
  int32_t x = 0;
  for (; x + kLanes <= width; x += kLanes) vst1q_u16(out + x, vshlq_n_u16(whole_levels(vld1q_u16(levels + x)), kLevelShift));
  for (; x < width; ++x) out[x] = static_cast<uint16_t>(whole_level(levels[x]) << kLevelShift);
}

// The first pixel from x on without a level; the width when there is none.
inline int32_t next_missing(const uint16_t* levels, int32_t x, int32_t width) {
  while (x + kLanes <= width && most16(vld1q_u16(levels + x)) < kOccluded) x += kLanes;
  while (x < width && levels[x] < kOccluded) ++x;
  return x;
}

template <int32_t kPlanes>
void vote_row(const Ballot& ballot) {
  const VoteWeighArgs& args = ballot.args;
  const uint16_t* levels = args.levels[args.radius];
  round_levels(levels, args.width, args.out);
  const bool groups = args.step != 1 && args.width >= kLanes;
  int32_t x = 0;
  while ((x = next_missing(levels, x, args.width)) < args.width) {
    const int32_t first = x + kLanes <= args.width ? x : args.width - kLanes;  // of a group
    const uint32_t missing = groups ? missing_levels(levels, first, x) : 0;
    if (__builtin_popcount(missing) < kFewPixels) {
      collect_window<kPlanes>(ballot, x);
      elect(args, ballot.votes, x);
      ++x;
      continue;
    }
    collect_group<kPlanes>(ballot, first);
    for (int32_t i = 0; i < kLanes; ++i) {
      if ((missing >> i & 1) != 0) elect(args, ballot.votes + ptrdiff_t{i} * args.num_disparities, first + i);
    }
    x = first + kLanes;
  }
}

}  // namespace

uint64_t vote_weigh_neon_scratch(const KernelShape& shape) {
  return sizeof(Scratch) + sizeof(uint32_t) * (kLanes * static_cast<uint64_t>(shape.num_disparities) + 1);
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
