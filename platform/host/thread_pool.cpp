// A bsm_parallel_for over persistent threads.
#include "host/thread_pool.h"

#include <chrono>

namespace bsm::host {
namespace {

constexpr std::chrono::microseconds kPatience{200};  // a thread that has to be woken up is late by tens of microseconds
constexpr int kLooks = 1024;                         // between yields, which take longer than most waits

// Looks until ready() is true; false when that takes longer than a thread should look.
template <class Function>
bool look_for(const Function& ready) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  do {
    for (int look = 0; look < kLooks; ++look) {
      if (ready()) return true;
    }
    std::this_thread::yield();
  } while (std::chrono::steady_clock::now() < end);
  return false;
}

}  // namespace

ThreadPool::ThreadPool(int32_t threads)
    : count_(threads < 1 ? 1 : threads), shares_(new Share[static_cast<size_t>(count_)]) {
  for (int32_t i = 1; i < count_; ++i) threads_.emplace_back([this, i] { worker(i); });
}

ThreadPool::~ThreadPool() {
  stop_.store(true);
  {
    const std::lock_guard<std::mutex> lock(mutex_);  // a worker is either before its test or asleep, never between
    work_.notify_all();
  }
  for (std::thread& thread : threads_) thread.join();
}

// Takes and does one job of a share; false when none is open.
bool ThreadPool::take_job(int32_t share) {
  std::atomic<int32_t>& open_jobs = shares_[static_cast<size_t>(share)].open;
  int32_t open = open_jobs.load(std::memory_order_relaxed);
  do {
    if (open == 0) return false;
  } while (!open_jobs.compare_exchange_weak(open, open - 1, std::memory_order_acquire, std::memory_order_relaxed));
  const int32_t n_jobs = n_jobs_;
  job_(job_context_, share + (open - 1) * count_);
  if (finished_jobs_.fetch_add(1) + 1 == n_jobs && run_sleeps_.load()) {
    const std::lock_guard<std::mutex> lock(mutex_);
    done_.notify_one();
  }
  return true;
}

// Does the jobs of a thread's own share, then those that other threads have not begun.
void ThreadPool::take_jobs(int32_t thread) {
  for (int32_t i = 0; i < count_; ++i) {
    while (take_job((thread + i) % count_)) {
    }
  }
}

void ThreadPool::worker(int32_t thread) {
  const std::atomic<int32_t>& own = shares_[static_cast<size_t>(thread)].open;
  const auto called = [this, &own] { return own.load() > 0 || stop_.load(); };
  for (;;) {
    if (!look_for(called)) {
      std::unique_lock<std::mutex> lock(mutex_);
      sleeping_.fetch_add(1);
      work_.wait(lock, called);
      sleeping_.fetch_sub(1);
    }
    if (stop_.load()) return;
    take_jobs(thread);
  }
}

void ThreadPool::run(int32_t n_jobs, bsm_job job, void* job_context) {
  if (count_ == 1 || n_jobs <= 1) {
    for (int32_t i = 0; i < n_jobs; ++i) job(job_context, i);
    return;
  }
  n_jobs_ = n_jobs;
  job_ = job;
  job_context_ = job_context;
  finished_jobs_.store(0, std::memory_order_relaxed);
  for (int32_t share = count_ - 1; share >= 0; --share) {
    if (share < n_jobs) shares_[static_cast<size_t>(share)].open.store((n_jobs - share - 1) / count_ + 1);
  }
  if (sleeping_.load() > 0) {
    const std::lock_guard<std::mutex> lock(mutex_);
    work_.notify_all();
  }
  take_jobs(0);
  if (look_for([this, n_jobs] { return finished_jobs_.load(std::memory_order_acquire) == n_jobs; })) return;
  std::unique_lock<std::mutex> lock(mutex_);
  run_sleeps_.store(true);
  done_.wait(lock, [this, n_jobs] { return finished_jobs_.load() == n_jobs; });
  run_sleeps_.store(false);
}

void ThreadPool::parallel_for(void* pool, int32_t n_jobs, bsm_job job, void* job_context) {
  static_cast<ThreadPool*>(pool)->run(n_jobs, job, job_context);
}

}  // namespace bsm::host
