// Packed bits for the scalar kernels: 64-bit loads and a population count in plain integer operations.
#ifndef BSM_SIMD_SCALAR_BITS_H
#define BSM_SIMD_SCALAR_BITS_H

#include <stdint.h>

#include "platform/compiler.h"

namespace bsm {

// Eight packed bytes; the order of the bytes does not matter to counts and bitwise operations.
static inline uint64_t load_bits(const uint8_t* bytes) {
  uint64_t word;
  BSM_MEMCPY(&word, bytes, sizeof word);
  return word;
}

// Set bits of each pair of bits, in place.
static inline uint64_t count_pairs(uint64_t word) {
  return word - ((word >> 1) & 0x5555555555555555u);
}

// Set bits of three words: counts by nibble stay within 12, by byte within 24.
static inline uint32_t count_bits(uint64_t a, uint64_t b, uint64_t c) {
  constexpr uint64_t k2 = 0x3333333333333333u;
  a = count_pairs(a);
  b = count_pairs(b);
  c = count_pairs(c);
  const uint64_t nibbles = (a & k2) + ((a >> 2) & k2) + (b & k2) + ((b >> 2) & k2) + (c & k2) + ((c >> 2) & k2);
  const uint64_t bytes = (nibbles & 0x0f0f0f0f0f0f0f0fu) + ((nibbles >> 4) & 0x0f0f0f0f0f0f0f0fu);
  return static_cast<uint32_t>((bytes * 0x0101010101010101u) >> 56);
}

static inline uint32_t count_bits(uint64_t word) {
  return count_bits(word, 0, 0);
}

}  // namespace bsm

#endif  // BSM_SIMD_SCALAR_BITS_H
