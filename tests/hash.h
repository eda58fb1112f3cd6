// hash.h - FNV-1a, 64 bit, over values in little-endian order: the same hash on every machine.
#ifndef BSM_TESTS_HASH_H
#define BSM_TESTS_HASH_H

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bsm::test {

class Hash {
 public:
  void add(uint8_t byte) { value_ = (value_ ^ byte) * 0x100000001b3u; }
  void add(const std::vector<uint8_t>& bytes) {
    for (const uint8_t byte : bytes) add(byte);
  }
  void add(const std::vector<int16_t>& values) {
    for (const int16_t value : values) {
      add(static_cast<uint8_t>(value & 255));
      add(static_cast<uint8_t>((static_cast<uint16_t>(value) >> 8) & 255));
    }
  }
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace bsm::test

#endif  // BSM_TESTS_HASH_H
