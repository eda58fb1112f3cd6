// caller_memory.h - the caller's memory around a context: images and maps with drawn strides, gaps and contents, which know
// what may have changed in them.
#ifndef BSM_TESTS_CALLER_MEMORY_H
#define BSM_TESTS_CALLER_MEMORY_H

#include <algorithm>
#include <vector>

#include "call_sequence.h"

namespace bsm::test {

// Rows of a plane or a map in the caller's memory, with gaps and a stride of either sign.
class Plane {
 public:
  Plane() = default;
  Plane(PageYard& yard, const Draw& draw, int rows, int bytes, int unit) : rows_(rows), bytes_(bytes) {
    const ptrdiff_t stride = bytes + unit * draw(0, 3);
    const size_t size = static_cast<size_t>((rows - 1) * stride + bytes);
    uint8_t* const memory = yard.take(size, static_cast<size_t>(unit));
    const bool upward = draw(0, 1) == 1;
    first_ = memory + (upward ? (rows - 1) * stride : 0);
    stride_ = upward ? -stride : stride;
    memory_ = memory;
    for (size_t i = 0; i < size; ++i) memory_[i] = static_cast<uint8_t>(draw(0, 255));
    before_.assign(memory_, memory_ + size);
  }
  uint8_t* first() const { return first_; }
  ptrdiff_t stride() const { return stride_; }
  uint8_t* row(int y) const { return first_ + y * stride_; }
  void set(const uint8_t* rows, ptrdiff_t stride) {
    for (int y = 0; y < rows_; ++y) std::copy_n(rows + y * stride, bytes_, row(y));
    accept();
  }
  // What is in the memory now is right.
  void accept() { before_.assign(memory_, memory_ + before_.size()); }
  bool unchanged() const { return std::equal(before_.begin(), before_.end(), memory_); }
  // The first `rows` rows hold these values, and nothing beside them has changed.
  bool holds(const void* values, int rows) const {
    std::vector<uint8_t> expected = before_;
    for (int y = 0; y < rows; ++y) {
      std::copy_n(static_cast<const uint8_t*>(values) + y * bytes_, bytes_, expected.begin() + (row(y) - memory_));
    }
    return std::equal(expected.begin(), expected.end(), memory_);
  }

 private:
  uint8_t* memory_ = nullptr;
  uint8_t* first_ = nullptr;
  ptrdiff_t stride_ = 0;
  int rows_ = 0, bytes_ = 0;
  std::vector<uint8_t> before_;
};

// An image in the caller's memory.
struct Picture {
  Picture() = default;
  Picture(PageYard& yard, const Draw& draw, const PixelImage& image)
      : pixels(yard, draw, image.height, row_bytes(image.format, image.width), 1) {
    pixels.set(image.bytes.data(), image.stride);
    view = bsm_image{{pixels.first(), nullptr}, {pixels.stride(), 0}};
    if (image.chroma.empty()) return;
    chroma = Plane(yard, draw, (image.height + 1) / 2, chroma_row_bytes(image.width), 1);
    chroma.set(image.chroma.data(), image.chroma_stride);
    view.plane[1] = chroma.first();
    view.stride[1] = chroma.stride();
  }
  bool unchanged() const { return pixels.unchanged() && chroma.unchanged(); }
  Plane pixels, chroma;
  bsm_image view{};
};

// The three outputs.
struct Outputs {
  Outputs(PageYard& yard, const Draw& draw, int rows, int width)
      : left(yard, draw, rows, 2 * width, 2),
        right(yard, draw, rows, 2 * width, 2),
        confidence(yard, draw, rows, width, 1) {}
  int16_t* left_data() const { return reinterpret_cast<int16_t*>(left.first()); }
  int16_t* right_data() const { return reinterpret_cast<int16_t*>(right.first()); }
  bool unchanged() const { return left.unchanged() && right.unchanged() && confidence.unchanged(); }
  void accept() {
    left.accept();
    right.accept();
    confidence.accept();
  }
  Plane left, right, confidence;
};

}  // namespace bsm::test

#endif  // BSM_TESTS_CALLER_MEMORY_H
