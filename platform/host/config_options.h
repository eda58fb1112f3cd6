// The command-line options that fill a bsm_config, shared by the commands; defaults are the library's.
#ifndef BSM_HOST_CONFIG_OPTIONS_H
#define BSM_HOST_CONFIG_OPTIONS_H

#include <string>

#include "bsm/bsm.h"
#include "host/options.h"

namespace bsm::host {

class ConfigOptions {
 public:
  ConfigOptions();

  // Everything but --stage; options outlives this object.
  void add_search(Options* options);
  void add_stage(Options* options);

  // After parsing: the preset, then what was given besides. False when --isa names nothing that this machine has.
  bool finish(std::string* error);
  // The same for images of this format, which presets depend on.
  void set_format(int32_t format);
  const char* preset() const;

  bsm_config config;
  std::string isa = "auto";

 private:
  Options* options_ = nullptr;
  bsm_config parsed_{};
  int32_t preset_ = BSM_PRESET_BALANCED;
  bool no_median_ = false;
};

// The isa_mask that a name means: "auto" all, "scalar" none, a CPU feature that feature, those it builds upon and those
// whose names begin with its own, so that "avx512" is what the kernels of that name need.
bool isa_mask_of(const std::string& name, uint32_t* mask, std::string* error);

// Names of the bits, separated by spaces; "none" when no bit is set.
std::string feature_names(uint32_t features);

// A refused configuration in the words of the command line: the option to change and the library's sentence.
std::string config_error(bsm_status status);

// Names of presets, methods, stages and formats as options and reports use them.
const char* preset_name(int32_t preset);
const char* method_name(int32_t method);
const char* stage_name(int32_t stage);
const char* format_name(int32_t format);
std::vector<Choice> format_choices();

}  // namespace bsm::host

#endif  // BSM_HOST_CONFIG_OPTIONS_H
