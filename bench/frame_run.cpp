// Opens contexts and times their frames.
#include "bench/frame_run.h"

#include <chrono>

#include "host/config_options.h"
#include "host/pnm_read.h"
#include "host/run_match.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

bsm_image view_of(const host::Image8& image) {
  return bsm_image{{image.pixels.data(), nullptr}, {static_cast<ptrdiff_t>(image.row_bytes()), 0}};
}

bool read_view(const std::string& path, host::Image8* image, std::string* error) {
  host::SampleImage samples;
  if (!host::read_pnm_file(path, &samples, error)) return false;
  *image = host::to_image8(samples);
  return true;
}

}  // namespace

bool FrameRun::open(const bsm_config& config, std::string* error) {
  config_ = config;
  size_t bytes = 0;
  bsm_status status = bsm_memory_required(&config_, &bytes);
  if (status >= 0 && !arena_.allocate(bytes)) {
    *error = host::text("cannot allocate %zu bytes; fewer threads, disparities or bits need less", bytes);
    return false;
  }
  if (status >= 0) status = bsm_open(&config_, arena_.data(), arena_.size(), &context_);
  if (status < 0) {
    *error = host::config_error(status);
    return false;
  }
  disparity_.resize(static_cast<size_t>(config_.width) * static_cast<size_t>(config_.height));
  if (config_.max_jobs > 1) threads_ = std::make_unique<host::ThreadPool>(config_.max_jobs);
  return true;
}

bool FrameRun::match(const host::Image8& left, const host::Image8& right, double* milliseconds, std::string* error) {
  bsm_frame frame{};
  frame.left = view_of(left);
  frame.right = view_of(right);
  frame.disparity = bsm_map{disparity_.data(), ptrdiff_t{config_.width} * 2};
  if (threads_ != nullptr) {
    frame.parallel_for = host::ThreadPool::parallel_for;
    frame.parallel_user = threads_.get();
  }
  const auto begin = std::chrono::steady_clock::now();
  const bsm_status status = bsm_process(context_, &frame);
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - begin;
  *milliseconds = elapsed.count();
  if (status < 0) *error = bsm_status_string(status);
  return status >= 0;
}

bool read_views(const std::string& left_path, const std::string& right_path, host::Image8* left, host::Image8* right,
                std::string* error) {
  return read_view(left_path, left, error) && read_view(right_path, right, error) &&
         host::prepare_pair(left, left_path, right, right_path, error);
}

}  // namespace bsm::bench
