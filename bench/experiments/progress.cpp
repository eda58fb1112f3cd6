// Prints progress.
#include "bench/experiments/progress.h"

#include <cstdio>

namespace bsm::bench {

void Progress::begin(int total) {
  total_ = total;
  done_ = 0;
  start_ = std::chrono::steady_clock::now();
}

void Progress::step(const std::string& what) {
  ++done_;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  const int seconds = static_cast<int>(elapsed.count());
  std::fprintf(stderr, "[%4d/%d, %d remain, %d:%02d] %s\n", done_, total_, total_ > done_ ? total_ - done_ : 0, seconds / 60,
               seconds % 60, what.c_str());
}

}  // namespace bsm::bench
