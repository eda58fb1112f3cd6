// Runs OpenCV's StereoSGBM.
#include "bench/experiments/sgbm.h"

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace bsm::bench {
namespace {

constexpr int kBlock = 3, kMultiple = 16;  // StereoSGBM wants a multiple of 16 disparities
constexpr int kPreFilterCap = 63, kMaxDifference = 1;

cv::Mat extended(const host::Image8& image, int columns) {
  cv::Mat view(image.height, image.width, image.channels == 3 ? CV_8UC3 : CV_8UC1,
               const_cast<uint8_t*>(image.pixels.data()));  // only read
  cv::Mat result;
  cv::copyMakeBorder(view, result, 0, 0, columns, 0, cv::BORDER_REPLICATE);
  return result;
}

// Invalid pixels of a row take the lower of the nearest valid disparities.
void fill_row(float* row, int32_t width) {
  for (int32_t x = 0; x < width;) {
    if (row[x] != host::kNoDisparity) {
      ++x;
      continue;
    }
    int32_t end = x;
    while (end < width && row[end] == host::kNoDisparity) ++end;
    const float before = x > 0 ? row[x - 1] : host::kNoDisparity, after = end < width ? row[end] : host::kNoDisparity;
    std::fill(row + x, row + end, std::min(before, after));
    x = end;
  }
}

}  // namespace

bool sgbm_available() {
  return true;
}

std::string sgbm_name() {
  return "OpenCV " + cv::getVersionString() + " StereoSGBM";
}

host::DisparityMap sgbm_match(const Pair& pair) {
  cv::setNumThreads(1);
  const int disparities = (pair.num_disparities + kMultiple - 1) / kMultiple * kMultiple;
  const int area = pair.left.channels * kBlock * kBlock;
  const cv::Ptr<cv::StereoSGBM> matcher = cv::StereoSGBM::create(0, disparities, kBlock, 8 * area, 32 * area, kMaxDifference,
                                                                 kPreFilterCap, 0, 0, 0, cv::StereoSGBM::MODE_SGBM_3WAY);
  cv::Mat values;
  matcher->compute(extended(pair.left, disparities), extended(pair.right, disparities), values);

  host::DisparityMap map;
  map.width = pair.left.width;
  map.height = pair.left.height;
  map.pixels.reserve(pair.truth.pixels.size());
  for (int32_t y = 0; y < map.height; ++y) {
    for (int32_t x = 0; x < map.width; ++x) {
      const int16_t value = values.at<int16_t>(y, x + disparities);
      map.pixels.push_back(value >= 0 ? static_cast<float>(value) / 16.0f : host::kNoDisparity);
    }
    fill_row(map.pixels.data() + static_cast<size_t>(y) * static_cast<size_t>(map.width), map.width);
  }
  return map;
}

}  // namespace bsm::bench
