// Stands in for opencv_matcher.cpp where OpenCV was not found: nothing but opencv_available may be called.
#include "bench/opencv_matcher.h"

namespace bsm::bench {

struct OpencvMatcher::State {};

bool opencv_available() {
  return false;
}

std::string opencv_name() {
  return "OpenCV (not found when this was built)";
}

OpencvMatcher::OpencvMatcher(const Pair&, OpencvMethod) {}
OpencvMatcher::~OpencvMatcher() = default;

double OpencvMatcher::match() {
  return 0.0;
}

host::DisparityMap OpencvMatcher::map() const {
  return {};
}

}  // namespace bsm::bench
