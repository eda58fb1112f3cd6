// Owns the memory that a context lives in.
#ifndef BSM_HOST_ARENA_H
#define BSM_HOST_ARENA_H

#include <cstddef>

namespace bsm::host {

class Arena {
 public:
  Arena() = default;
  ~Arena();
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  // Replaces what it holds by `bytes` bytes at a cache line's start; false when there is not that much.
  bool allocate(size_t bytes);

  void* data() const { return data_; }
  size_t size() const { return size_; }

 private:
  void* data_ = nullptr;
  size_t size_ = 0;
};

}  // namespace bsm::host

#endif  // BSM_HOST_ARENA_H
