// yard.h - where the memory of a kernel's trial comes from: pieces with known bytes around them. Freestanding.
#ifndef BSM_TESTS_YARD_H
#define BSM_TESTS_YARD_H

#include <stddef.h>
#include <stdint.h>

namespace bsm::test {

class Yard {
 public:
  // A piece of `bytes` bytes, its address a multiple of alignment, a power of two.
  virtual uint8_t* take(size_t bytes, size_t alignment) = 0;
  template <typename T>
  T* take_array(size_t count, size_t alignment = alignof(T)) {
    return reinterpret_cast<T*>(take(count * sizeof(T), alignment));
  }
  // True while nothing has been written around the pieces.
  virtual bool intact() const = 0;

 protected:
  ~Yard() = default;
};

}  // namespace bsm::test

#endif  // BSM_TESTS_YARD_H
