// Integer weights of the refinement: exp(-(c / color + e / distance)) as one table over a sum of steps (eq. 10).
#ifndef BSM_CORE_WEIGHTS_H
#define BSM_CORE_WEIGHTS_H

#include <stdint.h>

namespace bsm {

// Vote: weight[k] = 65535 exp(-k / 64), rounded; from 710 steps on it is 0 or 1 and left out.
struct VoteWeights {
  static constexpr int32_t kCount = 710;
  uint16_t weight[kCount];
};

extern const VoteWeights kVoteWeights;

// VoteWeighArgs::color_scale for a weight that falls by e over `color` CIELAB units (1..64); a stored unit is 0.8.
uint32_t vote_color_scale(int32_t color);

// Steps of the exponent for a neighbour dx, dy pixels away: 64 sqrt(dx^2 + dy^2) / distance, rounded.
uint16_t vote_distance_steps(int32_t dx, int32_t dy, int32_t distance);

// Weighted median: weight[k] = 255 exp(-k / 16), rounded, so that the weights of a window add up within 16 bits.
struct SmoothWeights {
  uint8_t weight[128];
};

extern const SmoothWeights kSmoothWeights;

// MedianWeightedArgs::color_scale, as for the vote.
uint32_t smooth_color_scale(int32_t color);

// Steps of the exponent for a neighbour dx, dy pixels away: 16 sqrt(dx^2 + dy^2) / distance, rounded, at most 127.
uint8_t smooth_distance_steps(int32_t dx, int32_t dy, int32_t distance);

}  // namespace bsm

#endif  // BSM_CORE_WEIGHTS_H
