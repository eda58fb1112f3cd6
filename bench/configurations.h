// The configurations that the programs compare.
#ifndef BSM_BENCH_CONFIGURATIONS_H
#define BSM_BENCH_CONFIGURATIONS_H

#include <cstdint>
#include <string>
#include <vector>

#include "bsm/bsm.h"

namespace bsm::bench {

struct Configuration {
  std::string name;
  bsm_config config;
};

// A preset for colour or gray images; sizes and disparities are those of the pair that is matched.
Configuration preset_configuration(bsm_preset preset, bool gray = false);

// The local method with this library's refinement.
Configuration local_configuration(int32_t bits, bool gray = false);

// Semi-global aggregation as in the preset balanced, with another descriptor length.
Configuration sgm_configuration(int32_t bits, bool gray = false);

std::vector<Configuration> all_presets(bool gray = false);

// "local, n = 4096", "sgm, n = 256", "sgm, n = 512, 8 paths".
std::string describe(const bsm_config& config);

// The same configuration up to an earlier stage.
bsm_config at_stage(bsm_config config, bsm_stage stage);

// Asks for the confidence map; false when the library has none.
bool ask_for_confidence(bsm_config* config);

}  // namespace bsm::bench

#endif  // BSM_BENCH_CONFIGURATIONS_H
