// Folders of stereo pairs with ground truth, laid out like Middlebury's, read into memory.
//
// A pair is a folder with left.ppm, right.ppm and disparity.pgm (value / scale, 0 = unknown); it may hold the region masks
// nonocc.pgm, all.pgm and disc.pgm (255 = counts), and disparity_right.pgm.
#ifndef BSM_BENCH_PAIR_SET_H
#define BSM_BENCH_PAIR_SET_H

#include <cstdint>
#include <string>
#include <vector>

#include "bench/pair_table.h"
#include "host/disparity_file.h"
#include "host/evaluate.h"
#include "host/image.h"

namespace bsm::bench {

// The regions of the benchmark, in the order of its table.
enum Region { kNonOccluded = 0, kAll = 1, kDiscontinuous = 2 };
constexpr int kRegionCount = 3;
constexpr const char* kRegionNames[kRegionCount] = {"nonocc", "all", "disc"};

struct Pair {
  std::string name;  // the folder's
  host::Image8 left, right;
  host::DisparityMap truth;        // of the left view
  host::Mask masks[kRegionCount];  // 255 = counts; kAll empty = every pixel of known truth
  bool has_region[kRegionCount] = {false, true, false};
  bool official_regions = false;  // the masks came with the pair; otherwise they are derived from the truths
  int32_t num_disparities = 0;    // searched from 0 up
  double scale = 0.0;             // of the ground-truth file
};

struct PairSetOptions {
  std::string pairs_file;  // a table that comes before the folder's and the standard one; empty = none
  bool gray = false;       // images as luma
};

// Reads every pair in `folder`, one or two levels down, or the folder itself when it is a pair; in the table's order.
// Regions that have no mask: non-occluded by cross-checking both truths, all = known truth, disc from the jumps of the
// truth.
bool load_pairs(const std::string& folder, const PairSetOptions& options, std::vector<Pair>* pairs, std::string* error);

// Luma of an image in 8 bits, rounded: 76 R + 150 G + 29 B over 255.
host::Image8 to_gray(const host::Image8& image);

}  // namespace bsm::bench

#endif  // BSM_BENCH_PAIR_SET_H
