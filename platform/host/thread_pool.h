// A bsm_parallel_for over threads that live as long as the pool: they spin shortly for the next work, then sleep.
// Thread t of T begins with the jobs t, t + T and so on, so that a job finds in its core's cache what the same job left
// there in the run before; then it helps with what others have not begun.
#ifndef BSM_HOST_THREAD_POOL_H
#define BSM_HOST_THREAD_POOL_H

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
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
  // Jobs of one thread that nobody has taken yet. A job is taken by counting it down, so that whoever takes one knows that
  // run is still waiting for it and that the three fields below hold.
  struct alignas(64) Share {
    std::atomic<int32_t> open{0};
  };

  bool take_job(int32_t share);
  void take_jobs(int32_t thread);
  void worker(int32_t thread);

  const int32_t count_;  // of threads, with the caller of run
  std::unique_ptr<Share[]> shares_;
  int32_t n_jobs_ = 0;
  bsm_job job_ = nullptr;
  void* job_context_ = nullptr;
  alignas(64) std::atomic<int32_t> finished_jobs_{0};
  // Who sleeps, or is about to and looks once more at what it waits for: whoever changes that looks here afterwards.
  alignas(64) std::atomic<int32_t> sleeping_{0};  // workers
  std::atomic<bool> run_sleeps_{false};
  std::atomic<bool> stop_{false};

  std::mutex mutex_;
  std::condition_variable work_;  // a share has opened, or stop_
  std::condition_variable done_;  // finished_jobs_ has reached n_jobs_
  std::vector<std::thread> threads_;
};

}  // namespace bsm::host

#endif  // BSM_HOST_THREAD_POOL_H
