// vote_weigh, scalar: pixels without a level take the one with the largest summed weight (eq. 9, 10).
#include "platform/compiler.h"
#include "simd/kernels.h"
#include "simd/scalar/sad.h"

namespace bsm {
namespace {

// Sums the weights of all levels in the window around x (eq. 9). At most 65 x 65 votes of at most 65535 fit 32 bits.
void collect_votes(const VoteWeighArgs& args, int32_t x, uint32_t* votes) {
  const int32_t radius = args.radius;
  const uint8_t* center = args.lab[radius] + x;
  for (int32_t dy = -radius; dy <= radius; dy += args.step) {
    const uint16_t* levels = args.levels[dy + radius];
    if (levels == nullptr) continue;
    const uint8_t* lab = args.lab[dy + radius];
    const uint16_t* steps = args.distance_steps + ptrdiff_t{dy < 0 ? -dy : dy} * (radius + 1);
    for (int32_t dx = -radius; dx <= radius; dx += args.step) {
      const int32_t i = x + dx;
      if (i < 0 || i >= args.width || levels[i] >= kOccluded) continue;
      const uint32_t color_steps = (sad(center, lab + i, args.plane_stride, args.planes) * args.color_scale + 512) >> 10;
      const uint32_t exponent = color_steps + steps[dx < 0 ? -dx : dx];
      if (exponent < static_cast<uint32_t>(args.weights_count)) votes[whole_level(levels[i])] += args.weights[exponent];
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

}  // namespace

uint64_t vote_weigh_scalar_scratch(const KernelShape& shape) {
  return uint64_t{4} * static_cast<uint32_t>(shape.num_disparities);
}

void vote_weigh_scalar(const VoteWeighArgs& args) {
  uint32_t* votes = static_cast<uint32_t*>(args.scratch);
  const uint16_t* levels = args.levels[args.radius];
  for (int32_t x = 0; x < args.width; ++x) {
    args.out[x] = static_cast<uint16_t>(whole_level(levels[x]) << kLevelShift);
    if (levels[x] < kOccluded) continue;
    BSM_MEMSET(votes, 0, sizeof(uint32_t) * static_cast<uint32_t>(args.num_disparities));
    collect_votes(args, x, votes);
    const bool capped = args.cap != nullptr && args.cap[x] < args.num_disparities - 1;
    args.out[x] = winning_level(votes, capped ? args.cap[x] + 1 : args.num_disparities);
    if (capped && args.out[x] == kNoLevel) args.out[x] = winning_level(votes, args.num_disparities);
  }
}

}  // namespace bsm
