// Runs OpenCV's StereoBM and StereoSGBM.
#include "bench/opencv_matcher.h"

#include <algorithm>
#include <chrono>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace bsm::bench {
namespace {

constexpr int kMultiple = 16;  // OpenCV wants a multiple of 16 disparities
constexpr int kBlockSide = 9, kSgbmSide = 3;
// What gave OpenCV the least error on Middlebury v2.
constexpr int kPreFilterCap = 15, kMaxDifference = 1, kTexture = 10, kBlockUniqueness = 15, kSgbmUniqueness = 10;

cv::Mat extended(const host::Image8& image, int columns) {
  cv::Mat view(image.height, image.width, image.channels == 3 ? CV_8UC3 : CV_8UC1,
               const_cast<uint8_t*>(image.pixels.data()));  // only read
  cv::Mat result;
  cv::copyMakeBorder(view, result, 0, 0, columns, 0, cv::BORDER_REPLICATE);
  return result;
}

cv::Ptr<cv::StereoMatcher> make_matcher(OpencvMethod method, int disparities, int channels) {
  if (method == OpencvMethod::kBlock) {
    const cv::Ptr<cv::StereoBM> matcher = cv::StereoBM::create(disparities, kBlockSide);
    matcher->setTextureThreshold(kTexture);
    matcher->setUniquenessRatio(kBlockUniqueness);
    matcher->setPreFilterCap(kPreFilterCap);
    matcher->setDisp12MaxDiff(kMaxDifference);
    return matcher;
  }
  const int area = channels * kSgbmSide * kSgbmSide;
  return cv::StereoSGBM::create(
      0, disparities, kSgbmSide, 8 * area, 32 * area, kMaxDifference, kPreFilterCap, kSgbmUniqueness, 0, 0,
      method == OpencvMethod::kSgbm3Way ? cv::StereoSGBM::MODE_SGBM_3WAY : cv::StereoSGBM::MODE_SGBM);
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

struct OpencvMatcher::State {
  int columns;  // that the views are extended by
  cv::Ptr<cv::StereoMatcher> matcher;
  cv::Mat left, right, values;
};

bool opencv_available() {
  return true;
}

std::string opencv_name() {
  return "OpenCV " + cv::getVersionString();
}

OpencvMatcher::OpencvMatcher(const Pair& pair, OpencvMethod method) : state_(std::make_unique<State>()) {
  cv::setNumThreads(1);
  state_->columns = (pair.num_disparities + kMultiple - 1) / kMultiple * kMultiple;
  state_->matcher = make_matcher(method, state_->columns, pair.left.channels);
  state_->left = extended(pair.left, state_->columns);
  state_->right = extended(pair.right, state_->columns);
}

OpencvMatcher::~OpencvMatcher() = default;

double OpencvMatcher::match() {
  const auto begin = std::chrono::steady_clock::now();
  state_->matcher->compute(state_->left, state_->right, state_->values);
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - begin;
  return elapsed.count();
}

host::DisparityMap OpencvMatcher::map() const {
  host::DisparityMap map;
  map.width = state_->values.cols - state_->columns;
  map.height = state_->values.rows;
  map.pixels.reserve(static_cast<size_t>(map.width) * static_cast<size_t>(map.height));
  for (int32_t y = 0; y < map.height; ++y) {
    for (int32_t x = 0; x < map.width; ++x) {
      const int16_t value = state_->values.at<int16_t>(y, x + state_->columns);
      map.pixels.push_back(value >= 0 ? static_cast<float>(value) / 16.0f : host::kNoDisparity);
    }
    fill_row(map.pixels.data() + static_cast<size_t>(y) * static_cast<size_t>(map.width), map.width);
  }
  return map;
}

}  // namespace bsm::bench
