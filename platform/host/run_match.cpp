// Matches two images held in memory with the library.
#include "host/run_match.h"

#include <algorithm>
#include <chrono>

#include "host/arena.h"
#include "host/text.h"
#include "host/thread_pool.h"

namespace bsm::host {
namespace {

bsm_image view_of(const Image8& image) {
  return bsm_image{{image.pixels.data(), nullptr}, {static_cast<ptrdiff_t>(image.row_bytes()), 0}};
}

bsm_map map_of(std::vector<int16_t>* values, int32_t width) {
  return bsm_map{values->empty() ? nullptr : values->data(), static_cast<ptrdiff_t>(width) * 2};
}

bsm_status match_frame(const MatchRequest& request, ThreadPool* threads, bsm_context* context, MatchResult* result) {
  bsm_frame frame{};
  frame.left = view_of(*request.left);
  frame.right = view_of(*request.right);
  frame.disparity = map_of(&result->disparity, request.left->width);
  frame.right_disparity = map_of(&result->right_disparity, request.left->width);
  if (!result->confidence.empty()) frame.confidence = bsm_byte_map{result->confidence.data(), request.left->width};
  if (result->config.max_jobs > 1) {
    frame.parallel_for = ThreadPool::parallel_for;
    frame.parallel_user = threads;
  }
  return bsm_process(context, &frame);
}

bsm_status match_rows(const MatchRequest& request, bsm_context* context, MatchResult* result) {
  const Image8& left = *request.left;
  const Image8& right = *request.right;
  const size_t width = static_cast<size_t>(left.width);
  size_t at = 0;  // first value of the next finished row
  const auto pull = [&] {
    int16_t* right_row = result->right_disparity.empty() ? nullptr : result->right_disparity.data() + at;
    uint8_t* confidence_row = result->confidence.empty() ? nullptr : result->confidence.data() + at;
    const bsm_status status = bsm_pull_row(context, result->disparity.data() + at, right_row, confidence_row);
    if (status == BSM_OK) at += width;
    return status;
  };
  bsm_status status = bsm_reset(context);
  for (int32_t y = 0; y < left.height && status >= 0; ++y) {
    const bsm_row left_row{{left.row(y), nullptr}}, right_row{{right.row(y), nullptr}};
    status = bsm_push_row(context, &left_row, &right_row);
    if (status >= 0) status = pull();
  }
  if (status >= 0) status = bsm_finish(context);
  while (status >= 0 && at < result->disparity.size()) status = pull();
  return status;
}

}  // namespace

double MatchResult::fastest() const {
  return *std::min_element(milliseconds.begin(), milliseconds.end());
}

double MatchResult::median() const {
  std::vector<double> sorted = milliseconds;
  std::sort(sorted.begin(), sorted.end());
  const size_t middle = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

bool prepare_pair(Image8* left, const std::string& left_name, Image8* right, const std::string& right_name,
                  std::string* error) {
  if (left->width != right->width || left->height != right->height) {
    *error = left_name + text(" is %d x %d pixels, but ", static_cast<int>(left->width), static_cast<int>(left->height)) +
             right_name + text(" %d x %d", static_cast<int>(right->width), static_cast<int>(right->height)) +
             "; both views of a rectified pair have the same size";
    return false;
  }
  if (left->channels != right->channels) {
    *left = to_rgb(*left);
    *right = to_rgb(*right);
  }
  return true;
}

bool run_match(const MatchRequest& request, MatchResult* result, bsm_status* status) {
  *result = MatchResult();
  bsm_config& config = result->config;
  config = request.config;
  config.width = request.left->width;
  config.height = request.left->height;
  config.format = request.left->channels == 3 ? BSM_FORMAT_RGB24 : BSM_FORMAT_GRAY8;

  Arena arena;
  bsm_context* context = nullptr;
  *status = bsm_memory_required(&config, &result->arena_bytes);
  if (*status >= 0 && !arena.allocate(result->arena_bytes)) *status = BSM_ERROR_ARENA;
  if (*status >= 0) *status = bsm_open(&config, arena.data(), arena.size(), &context);
  if (*status < 0) return false;
  result->kernels = kernel_names(context);

  const size_t count = static_cast<size_t>(config.width) * static_cast<size_t>(config.height);
  result->disparity.resize(count);
  if (config.right_map != 0) result->right_disparity.resize(count);
  if (config.confidence != 0) result->confidence.resize(count);
  ThreadPool threads(request.rows ? 1 : config.max_jobs);
  for (int32_t i = 0; i < request.repeat; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    *status = request.rows ? match_rows(request, context, result) : match_frame(request, &threads, context, result);
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - begin;
    if (*status < 0) return false;
    result->milliseconds.push_back(elapsed.count());
  }
  return true;
}

std::vector<std::string> kernel_names(const bsm_context* context) {
  std::vector<std::string> names;
  for (int32_t kernel = 0; kernel < BSM_KERNEL_COUNT; ++kernel) {
    const char* name = bsm_kernel_name(context, static_cast<bsm_kernel>(kernel));
    if (name != nullptr) names.push_back(name);
  }
  return names;
}

}  // namespace bsm::host
