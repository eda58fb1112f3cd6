// Makes configurations.
#include "bench/configurations.h"

#include "host/text.h"

namespace bsm::bench {
namespace {

constexpr bsm_preset kPresets[] = {BSM_PRESET_PAPER, BSM_PRESET_LOCAL, BSM_PRESET_FAST, BSM_PRESET_BALANCED,
                                   BSM_PRESET_BEST};
constexpr const char* kPresetNames[] = {"paper", "fast", "balanced", "best", "local"};  // by value

bsm_config make(bsm_preset preset, bool gray) {
  bsm_config config{};
  bsm_config_init(&config, 1, 1);
  config.format = gray ? BSM_FORMAT_GRAY8 : BSM_FORMAT_RGB24;  // before the preset, which depends on it
  bsm_config_preset(&config, preset);
  return config;
}

template <typename Config>
auto ask(Config* config, int) -> decltype(config->confidence = 1, true) {
  config->confidence = 1;
  return true;
}
template <typename Config>
bool ask(Config*, long) {
  return false;
}

}  // namespace

Configuration preset_configuration(bsm_preset preset, bool gray) {
  return {kPresetNames[preset], make(preset, gray)};
}

Configuration local_configuration(int32_t bits, bool gray) {
  Configuration result{"", make(BSM_PRESET_LOCAL, gray)};
  result.config.bits = bits;
  result.name = describe(result.config);
  return result;
}

Configuration sgm_configuration(int32_t bits, bool gray) {
  Configuration result{"", make(BSM_PRESET_BALANCED, gray)};
  result.config.bits = bits;
  result.name = describe(result.config);
  return result;
}

std::string describe(const bsm_config& config) {
  const std::string bits = host::text("n = %d", static_cast<int>(config.bits));
  if (config.method == BSM_METHOD_LOCAL) return "local, " + bits;
  return "sgm, " + bits + (config.paths == 8 ? ", 8 paths" : "");
}

std::vector<Configuration> all_presets(bool gray) {
  std::vector<Configuration> presets;
  for (const bsm_preset preset : kPresets) presets.push_back(preset_configuration(preset, gray));
  return presets;
}

bsm_config at_stage(bsm_config config, bsm_stage stage) {
  config.stage = stage;
  return config;
}

bool ask_for_confidence(bsm_config* config) {
  return ask(config, 0);
}

}  // namespace bsm::bench
