// The set bits of every byte, as a table in the scratch: gathers read it from fast memory.
#ifndef BSM_SIMD_ARM_POPULATION_H
#define BSM_SIMD_ARM_POPULATION_H

#include <stddef.h>
#include <stdint.h>

namespace bsm {
namespace {

constexpr size_t kPopulationBytes = 256;

inline const uint8_t* make_population(void* memory) {
  uint8_t* const population = static_cast<uint8_t*>(memory);
  population[0] = 0;
  for (int32_t bit = 1; bit < 256; bit *= 2) {
    for (int32_t i = 0; i < bit; ++i) population[bit + i] = static_cast<uint8_t>(population[i] + 1);
  }
  return population;
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_POPULATION_H
