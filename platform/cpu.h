// CPU facts: which instruction set extensions that kernels exist for this machine has. Includes nothing of ours.
#ifndef BSM_PLATFORM_CPU_H
#define BSM_PLATFORM_CPU_H

#include <stdint.h>

namespace bsm {

// kCpuPopcnt and so on: one bit per feature of platform/cpu_features.def.
enum CpuFeature : uint32_t {
#define BSM_CPU_FEATURE(bit, symbol, name, machine) kCpu##symbol = uint32_t{1} << (bit),
#include "platform/cpu_features.def"
#undef BSM_CPU_FEATURE
};

// Features of the machine that runs the call; 0 where only the scalar kernels can run.
uint32_t cpu_features();

// Name of the feature with this bit number (0..31), nullptr when the bit has no meaning.
const char* cpu_feature_name(int32_t bit);

// Detection proper: from what the machine reports to features. Callable on any machine, so that every case can be tried.

// Registers of an x86 processor; zero where a leaf or register does not exist.
struct X86Registers {
  uint32_t max_leaf;  // CPUID leaf 0: EAX
  uint32_t leaf1_ecx;
  uint32_t leaf7_ebx;
  uint32_t leaf7_ecx;
  uint64_t xcr0;  // register state that the operating system saves; read only when OSXSAVE is set
};
uint32_t x86_features(const X86Registers& registers);

// Hardware capability words that Linux hands to a program, by the machine's word size.
struct ArmCapabilities {
  uint64_t hwcap;
  uint64_t hwcap2;
  uint32_t sve_bytes;  // of a vector; read only with SVE
};
uint32_t arm64_features(const ArmCapabilities& capabilities);
uint32_t arm32_features(const ArmCapabilities& capabilities);

}  // namespace bsm

#endif  // BSM_PLATFORM_CPU_H
