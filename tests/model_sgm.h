// model_sgm.h - a plain model of everything up to the winners: descriptors, masks, costs, the paths of the semi-global
// aggregation and winner-takes-all. Whole frames in std::vector, one function for each rule. It shares with the library only
// what is checked on its own: the pair patterns and the stored colours.
#ifndef BSM_TESTS_MODEL_SGM_H
#define BSM_TESTS_MODEL_SGM_H

#include <cstddef>
#include <vector>

#include "bsm/bsm.h"
#include "images.h"

namespace bsm::test {

// Levels are in 1/16 pixel, counted from min_disparity. These two stand where there is none.
inline constexpr int kModelNone = -1;
inline constexpr int kModelOccluded = -2;  // none, and the other view does not show the pixel

inline int model_whole(int level) {
  return (level + 8) / 16;
}  // nearest whole level, halves up

struct ModelColor {
  int luma, l, a, b;
};

int model_sad(const ModelColor& x, const ModelColor& y);  // eq. 5

// The colours of one view. Gray images have no a and b.
struct ModelView {
  int width = 0, height = 0;
  std::vector<ModelColor> colors;

  bool contains(int x, int y) const { return 0 <= x && x < width && 0 <= y && y < height; }
  size_t index(int x, int y) const { return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x); }
  const ModelColor& color(int x, int y) const { return colors[index(x, y)]; }
};

ModelView model_view(const ColorImage& image, bool gray);

// Winners of every pixel of both views at one stage before the check.
struct ModelWinners {
  std::vector<int> left, right;  // kModelNone: no candidates
  std::vector<int> margin;       // aggregated: of the left view, in 1/512 of the bits, 0..249; empty at other stages
};

// The stages cost, masked and (sgm) aggregated; the latter is left empty for the local method.
struct ModelMatches {
  ModelWinners cost, masked, aggregated;
};

ModelMatches model_matches(const bsm_config& config, const ModelView& left, const ModelView& right);

}  // namespace bsm::test

#endif  // BSM_TESTS_MODEL_SGM_H
