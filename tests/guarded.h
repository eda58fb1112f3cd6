// guarded.h - memory between pages that may not be touched, for proving that nothing is read or written outside a buffer.
#ifndef BSM_TESTS_GUARDED_H
#define BSM_TESTS_GUARDED_H

#include <cstddef>
#include <cstdint>

namespace bsm::test {

// `bytes` bytes that end (or begin) exactly at a page edge with an inaccessible page on the other side; or several rows of
// so many bytes, each of its own and `stride` bytes apart.
class GuardedBuffer {
 public:
  enum class Edge { kEnd, kBegin };
  // Whether this system has page protection that the class knows; without it the constructor skips the case.
  static bool available();
  GuardedBuffer(size_t bytes, Edge edge, size_t rows = 1);
  ~GuardedBuffer();
  GuardedBuffer(const GuardedBuffer&) = delete;
  GuardedBuffer& operator=(const GuardedBuffer&) = delete;
  uint8_t* data() { return data_; }
  size_t size() const { return bytes_; }
  uint8_t* row(size_t y) { return data_ + y * stride_; }
  ptrdiff_t stride() const { return static_cast<ptrdiff_t>(stride_); }
  // From here on a write into the buffer ends the program.
  void make_read_only();

 private:
  void protect(int protection);

  uint8_t* mapping_ = nullptr;
  size_t mapped_ = 0;
  uint8_t* data_ = nullptr;
  size_t bytes_ = 0, rows_ = 0;
  size_t page_ = 0, stride_ = 0;
};

}  // namespace bsm::test

#endif  // BSM_TESTS_GUARDED_H
