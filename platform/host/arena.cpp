// Owns the memory that a context lives in.
#include "host/arena.h"

#include <new>

namespace bsm::host {
namespace {

constexpr std::align_val_t kAlignment{64};

}  // namespace

Arena::~Arena() {
  ::operator delete(data_, kAlignment);
}

bool Arena::allocate(size_t bytes) {
  ::operator delete(data_, kAlignment);
  data_ = ::operator new(bytes, kAlignment, std::nothrow);
  size_ = data_ != nullptr ? bytes : 0;
  return data_ != nullptr;
}

}  // namespace bsm::host
