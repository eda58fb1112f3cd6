// Simulated exposures and lightings of a view, for the radiometric study.
#ifndef BSM_BENCH_EXPERIMENTS_RADIOMETRY_H
#define BSM_BENCH_EXPERIMENTS_RADIOMETRY_H

#include <cstdint>

#include "host/image.h"

namespace bsm::bench {

constexpr int kConditions = 3;

// Exposure 0, 1, 2: gains of 1/4, 1 and 4 in linear light, Gaussian noise of standard deviation 2 levels, clipping, 8 bits.
// The noise is a function of the seed alone; without `noisy` there is none.
host::Image8 expose(const host::Image8& image, int exposure, uint32_t seed, bool noisy = true);
constexpr const char* kExposureNames[kConditions] = {"1/4", "1", "4"};

// Lighting 0, 1, 2: gains in linear light that are 1 everywhere; fall from 1.5 at the left edge to 0.5 at the right; have a
// bright spot of 2 off centre over 0.6. Clipping, 8 bits.
host::Image8 light(const host::Image8& image, int lighting);
constexpr const char* kLightingNames[kConditions] = {"even", "falling", "spot"};

}  // namespace bsm::bench

#endif  // BSM_BENCH_EXPERIMENTS_RADIOMETRY_H
