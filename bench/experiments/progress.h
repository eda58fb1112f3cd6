// Says on standard error how far a long measurement has come.
#ifndef BSM_BENCH_EXPERIMENTS_PROGRESS_H
#define BSM_BENCH_EXPERIMENTS_PROGRESS_H

#include <chrono>
#include <string>

namespace bsm::bench {

class Progress {
 public:
  // `total` steps lie ahead.
  void begin(int total);
  // Begins the next step: a line with its number, the steps that remain and the time spent.
  void step(const std::string& what);
  int done() const { return done_; }
  int total() const { return total_; }

 private:
  int total_ = 0, done_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace bsm::bench

#endif  // BSM_BENCH_EXPERIMENTS_PROGRESS_H
