// Stands in for sgbm_opencv.cpp where OpenCV was not found.
#include "bench/experiments/sgbm.h"

namespace bsm::bench {

bool sgbm_available() {
  return false;
}

std::string sgbm_name() {
  return "OpenCV (not found when this was built)";
}

host::DisparityMap sgbm_match(const Pair& pair) {
  return pair.truth;  // never called: see sgbm_available
}

}  // namespace bsm::bench
