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

GuardedBuffer::GuardedBuffer(size_t bytes, Edge edge) : bytes_(bytes), page_(static_cast<size_t>(sysconf(_SC_PAGESIZE))) {
  const size_t inner = (bytes + page_ - 1) / page_ * page_;
  mapped_ = inner + 2 * page_;
  void* mapping = mmap(nullptr, mapped_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  REQUIRE(mapping != MAP_FAILED);
  mapping_ = static_cast<uint8_t*>(mapping);
  REQUIRE(mprotect(mapping_, page_, PROT_NONE) == 0);
  REQUIRE(mprotect(mapping_ + page_ + inner, page_, PROT_NONE) == 0);
  data_ = mapping_ + page_ + (edge == Edge::kEnd ? inner - bytes : 0);
}

GuardedBuffer::~GuardedBuffer() {
  if (mapping_) munmap(mapping_, mapped_);
}

void GuardedBuffer::make_read_only() {
  REQUIRE(mprotect(mapping_ + page_, mapped_ - 2 * page_, PROT_READ) == 0);
}

}  // namespace bsm::test

#else

namespace bsm::test {

bool GuardedBuffer::available() {
  return false;
}
GuardedBuffer::GuardedBuffer(size_t, Edge) {
  SKIP("this system has no mmap");
}
GuardedBuffer::~GuardedBuffer() = default;
void GuardedBuffer::make_read_only() {}

}  // namespace bsm::test

#endif
