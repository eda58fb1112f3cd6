// The candidates of a pixel that lie in the row, for the cost kernels of M-profile processors.
#ifndef BSM_SIMD_ARM_CANDIDATES_H
#define BSM_SIMD_ARM_CANDIDATES_H

#include "simd/kernels.h"

namespace bsm {
namespace {

struct Candidates {
  int32_t begin, end;  // levels
  int32_t first;  // the pixel that level `begin` meets; further levels go left for the left view, right for the right one
};

inline Candidates candidates_of(const CostHammingArgs& args, int32_t x) {
  const bool left = args.view == 0;
  const int32_t count = args.num_disparities;
  const int32_t nearest = left ? x - args.min_disparity : x + args.min_disparity;  // the pixel that level 0 meets
  const int32_t before = left ? nearest - args.width + 1 : -nearest;               // levels before the row
  const int32_t inside = left ? nearest + 1 : args.width - nearest;                // level from which on they lie behind it
  const int32_t begin = before < 0 ? 0 : before < count ? before : count;
  const int32_t end = inside < begin ? begin : inside < count ? inside : count;
  return Candidates{begin, end, left ? nearest - begin : nearest + begin};
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_CANDIDATES_H
