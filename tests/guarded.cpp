// guarded.cpp - page-edge buffers by mmap and mprotect; nothing on systems without them.
#include "guarded.h"

#include "check.h"

#if defined(__unix__) || defined(__APPLE__)
#include <sys/mman.h>
#include <unistd.h>

namespace bsm::test {

bool GuardedBuffer::available() {
  return true;
}

GuardedBuffer::GuardedBuffer(size_t bytes, Edge edge, size_t rows)
    : bytes_(bytes), rows_(rows), page_(static_cast<size_t>(sysconf(_SC_PAGESIZE))) {
  const size_t inner = (bytes + page_ - 1) / page_ * page_;
  stride_ = inner + page_;
  mapped_ = page_ + rows * stride_;
  void* mapping = mmap(nullptr, mapped_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  REQUIRE(mapping != MAP_FAILED);
  mapping_ = static_cast<uint8_t*>(mapping);
  protect(PROT_READ | PROT_WRITE);
  data_ = mapping_ + page_ + (edge == Edge::kEnd ? inner - bytes : 0);
}

GuardedBuffer::~GuardedBuffer() {
  if (mapping_) munmap(mapping_, mapped_);
}

void GuardedBuffer::make_read_only() {
  protect(PROT_READ);
}

// What may be done to the rows; nothing to the pages around them.
void GuardedBuffer::protect(int protection) {
  for (size_t y = 0; y < rows_; ++y) {
    REQUIRE(mprotect(mapping_ + page_ + y * stride_, stride_ - page_, protection) == 0);
  }
}

}  // namespace bsm::test

#else

namespace bsm::test {

bool GuardedBuffer::available() {
  return false;
}
GuardedBuffer::GuardedBuffer(size_t, Edge, size_t) {
  SKIP("this system has no mmap");
}
GuardedBuffer::~GuardedBuffer() = default;
void GuardedBuffer::make_read_only() {}
void GuardedBuffer::protect(int) {}

}  // namespace bsm::test

#endif
