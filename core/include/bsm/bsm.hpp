// bsm.hpp - thin C++17 wrapper over bsm.h: a Config with defaults, a Matcher over the caller's arena, no exceptions.
//
// The wrapper adds types, not behaviour: every call forwards to the C function of the same name and returns its status.
#ifndef BSM_BSM_HPP
#define BSM_BSM_HPP

#include "bsm/bsm.h"

namespace bsm {

// bsm_config that starts with the defaults for an image size; every field can then be set.
struct Config : bsm_config {
  Config(int32_t image_width, int32_t image_height) : bsm_config{} { bsm_config_init(this, image_width, image_height); }

  // Bytes of arena that Matcher::open needs; 0 when the configuration is invalid (validate() says why).
  size_t memory_required() const {
    size_t bytes = 0;
    return bsm_memory_required(this, &bytes) == BSM_OK ? bytes : 0;
  }
  // Rows by which the row API lags; a negative bsm_status when the configuration is invalid or has no row mode.
  int32_t row_delay() const {
    int32_t rows = 0;
    const bsm_status status = bsm_row_delay(this, &rows);
    return status == BSM_OK ? rows : static_cast<int32_t>(status);
  }
  bsm_status validate() const {
    size_t bytes = 0;
    return bsm_memory_required(this, &bytes);
  }
  int16_t invalid_disparity() const { return bsm_invalid_disparity(this); }
};

// Image: pixels at data, rows `stride` bytes apart; formats of two planes have the second at chroma.
inline bsm_image image(const void* data, ptrdiff_t stride, const void* chroma = nullptr, ptrdiff_t chroma_stride = 0) {
  return bsm_image{{data, chroma}, {stride, chroma_stride}};
}

// Row of an image.
inline bsm_row row(const void* data, const void* chroma = nullptr) {
  return bsm_row{{data, chroma}};
}

// A context in the caller's arena. Copies refer to the same context; nothing is freed.
class Matcher {
 public:
  bsm_status open(const bsm_config& config, void* arena, size_t bytes) { return bsm_open(&config, arena, bytes, &context_); }
  bsm_status process(const bsm_frame& frame) { return bsm_process(context_, &frame); }
  bsm_status push_row(const bsm_row& left, const bsm_row& right) { return bsm_push_row(context_, &left, &right); }
  bsm_status pull_row(int16_t* disparity, int16_t* right_disparity = nullptr, uint8_t* confidence = nullptr) {
    return bsm_pull_row(context_, disparity, right_disparity, confidence);
  }
  bsm_status finish() { return bsm_finish(context_); }
  bsm_status reset() { return bsm_reset(context_); }
  const char* kernel_name(bsm_kernel kernel) const { return bsm_kernel_name(context_, kernel); }
  bsm_context* get() const { return context_; }

 private:
  bsm_context* context_ = nullptr;
};

}  // namespace bsm

#endif  // BSM_BSM_HPP
