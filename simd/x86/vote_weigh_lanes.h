// vote_weigh for AVX2 and SSE4.2: exponents of kLanes / 2 neighbours at once, weights and votes one by one.
// Votes go to four sets of sums in turn, so that neighbours of one level do not wait for each other. Bound, for each
// neighbour: the look-up of its weight and one addition in memory.
// Include after the lanes of one instruction set.
#ifndef BSM_SIMD_X86_VOTE_WEIGH_LANES_H
#define BSM_SIMD_X86_VOTE_WEIGH_LANES_H

#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kColumnsAtOnce = kLanes / 2;
constexpr int32_t kMaxWeights = 1024;
constexpr int32_t kSets = 4;               // of sums
constexpr int32_t kMaxLevelsOfSets = 256;  // with more levels there is one set
constexpr int32_t kCenter = BSM_MAX_VOTE_RADIUS + kColumnsAtOnce;

struct alignas(64) VoteScratch {
  uint16_t distance[BSM_MAX_VOTE_RADIUS + 1]
                   [2 * kCenter];  // exponents by |dy| and kCenter + dx; no weight outside the window
  uint16_t weights[kMaxWeights + 1];
  uint16_t exponent[2 * BSM_MAX_VOTE_RADIUS + 1 + 2 * kColumnsAtOnce];  // of the columns of a row
  uint16_t level[2 * BSM_MAX_VOTE_RADIUS + 1 + 2 * kColumnsAtOnce];     // their levels; num_disparities for none
};

struct Ballot {
  const VoteWeighArgs& args;
  VoteScratch& scratch;
  uint32_t* votes;
  int32_t sets;
  int32_t set_size;
};

inline int32_t sets_of(int32_t num_disparities) {
  return num_disparities <= kMaxLevelsOfSets ? kSets : 1;
}

// Each set ends with a place for the votes of pixels without a level.
inline int32_t set_size_of(int32_t num_disparities) {
  return num_disparities + 1;
}

inline uint64_t vote_scratch_bytes(const KernelShape& shape) {
  const uint64_t sums =
      static_cast<uint64_t>(set_size_of(shape.num_disparities)) * static_cast<uint32_t>(sets_of(shape.num_disparities));
  return sizeof(VoteScratch) + sizeof(uint32_t) * sums;
}

inline void prepare(const Ballot& ballot) {
  const VoteWeighArgs& args = ballot.args;
  VoteScratch& scratch = ballot.scratch;
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

// Votes of every step-th of the columns begin..end-1 of row dy.
template <int32_t kPlanes>
inline void collect_row(const Ballot& ballot, int32_t x, int32_t dy, int32_t begin, int32_t end,
                        const Bytes (&center)[kPlanes]) {
  const VoteWeighArgs& args = ballot.args;
  VoteScratch& scratch = ballot.scratch;
  const uint16_t* levels = args.levels[dy + args.radius];
  const uint8_t* lab = args.lab[dy + args.radius];
  const uint16_t* distances = scratch.distance[dy < 0 ? -dy : dy] + kCenter - x;
  const Bytes scale = set16(static_cast<int32_t>(args.color_scale));
  const int32_t start = begin / kColumnsAtOnce * kColumnsAtOnce;
  for (int32_t i = start; i < end; i += kColumnsAtOnce) {
    Bytes sad = zero();
    for (int32_t plane = 0; plane < kPlanes; ++plane) {
      const Bytes color = widen(lab + plane * args.plane_stride + i);
      sad = add16(sad, sub8(max16(color, center[plane]), min16(color, center[plane])));
    }
    // (sad * scale + 512) >> 10 of a 32-bit product in two halves.
    const Bytes high = left16<6>(multiply16_high(sad, scale));
    const Bytes low = average16(right16<9>(multiply16_low(sad, scale)), zero());
    const Bytes exponent = add16_saturated(add16(high, low), load(distances + i));
    store(scratch.exponent + (i - start), min16(exponent, set16(kMaxWeights)));
    const Bytes level = load(levels + i);
    const Bytes missing = equal16(max16(level, set16(kOccluded)), level);
    const Bytes whole = right16<kLevelShift>(add16(level, set16(8)));
    store(scratch.level + (i - start), choose(whole, set16(args.num_disparities), missing));
  }
  const int32_t last_set = ballot.sets - 1;
  for (int32_t i = begin; i < end; i += args.step) {
    const uint16_t weight = scratch.weights[scratch.exponent[i - start]];
    ballot.votes[(i & last_set) * ballot.set_size + scratch.level[i - start]] += weight;
  }
}

template <int32_t kPlanes>
inline void collect_window(const Ballot& ballot, int32_t x) {
  const VoteWeighArgs& args = ballot.args;
  BSM_MEMSET(ballot.votes, 0, sizeof(uint32_t) * static_cast<size_t>(ballot.sets * ballot.set_size));
  Bytes center[kPlanes];
  for (int32_t plane = 0; plane < kPlanes; ++plane)
    center[plane] = set16(args.lab[args.radius][x + plane * args.plane_stride]);
  const int32_t begin = x < args.radius ? x % args.step : x - args.radius;
  const int32_t end = x + args.radius < args.width ? x + args.radius + 1 : args.width;
  for (int32_t dy = -args.radius; dy <= args.radius; dy += args.step) {
    if (args.levels[dy + args.radius] != nullptr) collect_row<kPlanes>(ballot, x, dy, begin, end, center);
  }
}

// The level below `end` with the most votes of all sets, in 1/16 pixel.
inline uint16_t winning_level(const Ballot& ballot, int32_t end) {
  uint32_t most = 0;
  int32_t winner = -1;
  for (int32_t level = 0; level < end; ++level) {
    const uint32_t* votes = ballot.votes + level;
    uint32_t sum = votes[0];
    if (ballot.sets == kSets) {
      BSM_UNROLL
      for (int32_t set = 1; set < kSets; ++set) sum += votes[set * ballot.set_size];
    }
    winner = sum > most ? level : winner;
    most = sum > most ? sum : most;
  }
  return winner < 0 ? kNoLevel : static_cast<uint16_t>(winner << kLevelShift);
}

template <int32_t kPlanes>
inline void vote_row(const Ballot& ballot) {
  const VoteWeighArgs& args = ballot.args;
  const uint16_t* levels = args.levels[args.radius];
  for (int32_t x = 0; x < args.width; ++x) {
    args.out[x] = static_cast<uint16_t>(whole_level(levels[x]) << kLevelShift);
    if (levels[x] < kOccluded) continue;
    collect_window<kPlanes>(ballot, x);
    const bool capped = args.cap != nullptr && args.cap[x] < args.num_disparities - 1;
    args.out[x] = winning_level(ballot, capped ? args.cap[x] + 1 : args.num_disparities);
    if (capped && args.out[x] == kNoLevel) args.out[x] = winning_level(ballot, args.num_disparities);
  }
}

inline void vote_weighed(const VoteWeighArgs& args) {
  VoteScratch& scratch = *static_cast<VoteScratch*>(args.scratch);
  const Ballot ballot{args, scratch, reinterpret_cast<uint32_t*>(&scratch + 1), sets_of(args.num_disparities),
                      set_size_of(args.num_disparities)};
  prepare(ballot);
  if (args.planes == 3) {
    vote_row<3>(ballot);
  } else {
    vote_row<1>(ballot);
  }
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_VOTE_WEIGH_LANES_H
