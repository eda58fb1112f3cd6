// rng.h - a small portable generator (splitmix64): the same numbers on every machine. Freestanding.
#ifndef BSM_TESTS_RNG_H
#define BSM_TESTS_RNG_H

#include <stdint.h>

namespace bsm::test {

class Rng {
 public:
  explicit Rng(uint64_t seed) : state_(seed) {}
  uint64_t next() {
    uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  // Uniform in low..high.
  int range(int low, int high) {
    const uint64_t span = static_cast<uint64_t>(static_cast<int64_t>(high) - low + 1);
    return static_cast<int>(low + static_cast<int64_t>((next() >> 11) % span));
  }
  uint8_t byte() { return static_cast<uint8_t>(next() >> 56); }
  bool one_in(int n) { return range(1, n) == 1; }

 private:
  uint64_t state_;
};

}  // namespace bsm::test

#endif  // BSM_TESTS_RNG_H
