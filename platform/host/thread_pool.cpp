// A bsm_parallel_for over persistent threads.
#include "host/thread_pool.h"

namespace bsm::host {
namespace {

constexpr int kSpins = 40000;  // looks at the counters before sleeping; tens of microseconds

}  // namespace

ThreadPool::ThreadPool(int32_t threads) {
  for (int32_t i = 1; i < threads; ++i) threads_.emplace_back([this] { worker(); });
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
    stop_spinning_.store(true, std::memory_order_relaxed);
  }
  work_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

// Takes and does one job; false when none is open.
bool ThreadPool::take_job() {
  int32_t open = open_jobs_.load(std::memory_order_relaxed);
  do {
    if (open == 0) return false;
  } while (!open_jobs_.compare_exchange_weak(open, open - 1, std::memory_order_acquire, std::memory_order_relaxed));
  const int32_t n_jobs = n_jobs_;
  job_(job_context_, n_jobs - open);
  if (finished_jobs_.fetch_add(1, std::memory_order_acq_rel) + 1 == n_jobs) {
    const std::lock_guard<std::mutex> lock(mutex_);  // run is either before its test or asleep, never between
    done_.notify_one();
  }
  return true;
}

void ThreadPool::worker() {
  for (;;) {
    for (int spin = 0; spin < kSpins && !stop_spinning_.load(std::memory_order_relaxed); ++spin) {
      if (take_job()) spin = -1;
      if (spin % 64 == 63) std::this_thread::yield();
    }
    std::unique_lock<std::mutex> lock(mutex_);
    work_.wait(lock, [this] { return stop_ || open_jobs_.load(std::memory_order_relaxed) > 0; });
    if (stop_) return;
  }
}

void ThreadPool::run(int32_t n_jobs, bsm_job job, void* job_context) {
  if (threads_.empty() || n_jobs <= 1) {
    for (int32_t i = 0; i < n_jobs; ++i) job(job_context, i);
    return;
  }
  n_jobs_ = n_jobs;
  job_ = job;
  job_context_ = job_context;
  finished_jobs_.store(0, std::memory_order_relaxed);
  {
    const std::lock_guard<std::mutex> lock(mutex_);  // a worker about to sleep sees the jobs or is woken
    open_jobs_.store(n_jobs, std::memory_order_release);
  }
  work_.notify_all();
  while (take_job()) {
  }
  for (int spin = 0; spin < kSpins; ++spin) {
    if (finished_jobs_.load(std::memory_order_acquire) == n_jobs) return;
  }
  std::unique_lock<std::mutex> lock(mutex_);
  done_.wait(lock, [this, n_jobs] { return finished_jobs_.load(std::memory_order_acquire) == n_jobs; });
}

void ThreadPool::parallel_for(void* pool, int32_t n_jobs, bsm_job job, void* job_context) {
  static_cast<ThreadPool*>(pool)->run(n_jobs, job, job_context);
}

}  // namespace bsm::host
