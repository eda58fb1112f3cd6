// hash.h - FNV-1a, 64 bit, over values in little-endian order: the same hash on every machine. Needs no C library.
#ifndef BSM_TESTS_HASH_H
#define BSM_TESTS_HASH_H

#include <stdint.h>

namespace bsm::test {

class Hash {
 public:
  void add(uint8_t byte) { value_ = (value_ ^ byte) * 0x100000001b3u; }
  void add(int16_t value) {
    add(static_cast<uint8_t>(value & 255));
    add(static_cast<uint8_t>((static_cast<uint16_t>(value) >> 8) & 255));
  }
  template <class Values>
  void add_all(const Values& values) {
    for (const auto value : values) add(value);
  }
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace bsm::test

#endif  // BSM_TESTS_HASH_H
