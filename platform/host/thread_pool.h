// A bsm_parallel_for over threads that live as long as the pool: they spin shortly for the next work, then sleep.
#ifndef BSM_HOST_THREAD_POOL_H
#define BSM_HOST_THREAD_POOL_H

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include "bsm/bsm.h"

namespace bsm::host {

class ThreadPool {
 public:
  // `threads` counts the caller of run, which works too; 1 or less makes no thread.
  explicit ThreadPool(int32_t threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  // Calls job(job_context, i) once for each i in 0..n_jobs-1 and returns when all have returned. One run at a time: neither
  // two threads nor a job itself may start another run of the same pool meanwhile.
  void run(int32_t n_jobs, bsm_job job, void* job_context);

  // run with the signature of bsm_parallel_for; `pool` is the ThreadPool.
  static void parallel_for(void* pool, int32_t n_jobs, bsm_job job, void* job_context);

 private:
  bool take_job();
  void worker();

  // Jobs that nobody has taken yet. A job is taken by counting it down, so that whoever takes one knows that run is still
  // waiting for it and that the four fields below hold.
  std::atomic<int32_t> open_jobs_{0};
  std::atomic<int32_t> finished_jobs_{0};
  int32_t n_jobs_ = 0;
  bsm_job job_ = nullptr;
  void* job_context_ = nullptr;

  std::mutex mutex_;
  std::condition_variable work_;  // open_jobs_ has risen, or stop_
  std::condition_variable done_;  // finished_jobs_ has reached n_jobs_
  bool stop_ = false;             // under mutex_
  std::atomic<bool> stop_spinning_{false};
  std::vector<std::thread> threads_;
};

}  // namespace bsm::host

#endif  // BSM_HOST_THREAD_POOL_H
