// Disparity maps in pixels, and reading them from files: PFM, 16-bit PGM and 8-bit PGM, results and ground truth.
#ifndef BSM_HOST_DISPARITY_FILE_H
#define BSM_HOST_DISPARITY_FILE_H

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace bsm::host {

// Value of a pixel without a disparity: unmatched in a result, unknown in a ground truth.
constexpr float kNoDisparity = std::numeric_limits<float>::infinity();

struct DisparityMap {
  int32_t width = 0;
  int32_t height = 0;
  std::vector<float> pixels;  // in pixels, kNoDisparity where there is none

  bool empty() const { return pixels.empty(); }
};

// From the library's map, rows without padding: 1/16 pixel, `invalid` where there is none.
DisparityMap disparity_map(const int16_t* values, int32_t width, int32_t height, int16_t invalid);

enum class MapRead { kDone, kBadFile, kBadScale };

// Reads a result: .pfm (in pixels; not finite = invalid), 16-bit .pgm (1/16 pixel; 65535 = invalid), 8-bit .pgm (value /
// scale; 0 = invalid). scale is 0 when none was given; an 8-bit file needs one and the others refuse it (kBadScale).
MapRead read_result(const std::string& path, double scale, DisparityMap* map, std::string* error);

// Reads a ground truth: .pgm of any depth (value / scale; 0 = unknown) or .pfm (not finite = unknown). scale is 0 when none
// was given; a .pgm needs one and a .pfm refuses it (kBadScale).
MapRead read_truth(const std::string& path, double scale, DisparityMap* map, std::string* error);

}  // namespace bsm::host

#endif  // BSM_HOST_DISPARITY_FILE_H
