// Sorts bad pixels by the likely cause of the error.
#ifndef BSM_BENCH_EXPERIMENTS_CAUSE_SHARES_H
#define BSM_BENCH_EXPERIMENTS_CAUSE_SHARES_H

#include <array>
#include <cstdint>
#include <vector>

#include "bench/pair_set.h"
#include "host/colormap.h"

namespace bsm::bench {

// A pixel with several causes counts for the first.
enum Cause {
  kBorder = 0,         // its match lies outside the right image
  kOccluded = 1,       // hidden in the right view, inside the image
  kDiscontinuity = 2,  // near a jump of the true disparity
  kTextureless = 3,    // the mean squared horizontal difference of the luma in 3 x 3 pixels is below 4 x 4
  kRepeated = 4,       // some other place of the row within the search range looks the same
  kSlanted = 5,        // the true disparity changes by a tenth of a pixel per pixel or more
  kOther = 6
};
constexpr int kCauseCount = 7;
constexpr const char* kCauseNames[kCauseCount] = {"border",   "occluded", "discontinuity", "textureless",
                                                  "repeated", "slanted",  "other"};
constexpr host::Color kCauseColors[kCauseCount] = {{214, 93, 14},  {226, 171, 26}, {200, 36, 66},  {45, 125, 210},
                                                   {150, 70, 190}, {22, 152, 110}, {128, 136, 146}};

// The cause class of every pixel, bad or not.
std::vector<uint8_t> classify(const Pair& pair);

struct CauseShares {
  int64_t counted = 0;                           // pixels of known truth in the region all
  std::array<int64_t, kCauseCount> pixels_in{};  // of those: in each class
  std::array<int64_t, kCauseCount> bad_in{};     // of those: with an error above one pixel, or invalid
  double bad_percent(size_t cause) const;        // of the counted pixels
  double share_percent(size_t cause) const;      // of the bad pixels
  void add(const CauseShares& other);
};

CauseShares count_causes(const Pair& pair, const std::vector<uint8_t>& classes, const host::DisparityMap& map);

// The left view, darkened, with the bad pixels in the colours of their causes.
host::Image8 draw_causes(const Pair& pair, const std::vector<uint8_t>& classes, const host::DisparityMap& map);

}  // namespace bsm::bench

#endif  // BSM_BENCH_EXPERIMENTS_CAUSE_SHARES_H
