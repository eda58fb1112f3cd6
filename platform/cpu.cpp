// Names of CPU features, from the list in platform/cpu_features.def.
#include "platform/cpu.h"

namespace bsm {

const char* cpu_feature_name(int32_t bit) {
  switch (bit) {
#define BSM_CPU_FEATURE(number, symbol, name, machine) \
  case number:                                         \
    return name;
#include "platform/cpu_features.def"
#undef BSM_CPU_FEATURE
    default:
      return nullptr;
  }
}

}  // namespace bsm
