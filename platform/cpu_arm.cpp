// ARM: features from the capability words on Linux and Android, elsewhere from what the compiler was told to assume.
#include "platform/compiler.h"
#include "platform/cpu.h"

#if BSM_ARCH_NEON && defined(__linux__)
// Of the C library, declared here to include none of its headers.
extern "C" unsigned long getauxval(unsigned long type);
#endif

namespace bsm {
namespace {

// Positions in the capability words of 64-bit programs.
constexpr uint64_t kAsimd64 = uint64_t{1} << 1;
constexpr uint64_t kDotProd64 = uint64_t{1} << 20;
constexpr uint64_t kSve64 = uint64_t{1} << 22;
constexpr uint64_t kSve2In2 = uint64_t{1} << 1;  // second word
// Positions in the capability words of 32-bit programs.
constexpr uint64_t kNeon32 = uint64_t{1} << 12;
constexpr uint64_t kDotProd32 = uint64_t{1} << 24;

constexpr uint32_t kShortSve = 512 / 8;  // bytes: vectors below it are short

}  // namespace

uint32_t arm64_features(const ArmCapabilities& capabilities) {
  if ((capabilities.hwcap & kAsimd64) == 0) return 0;
  uint32_t features = kCpuNeon;
  if ((capabilities.hwcap & kDotProd64) != 0) features |= kCpuDotProd;
  if ((capabilities.hwcap & kSve64) == 0) return features;
  features |= kCpuSve;
  if ((capabilities.hwcap2 & kSve2In2) != 0) features |= kCpuSve2;
  if (capabilities.sve_bytes < kShortSve) features |= kCpuSveShort;
  return features;
}

uint32_t arm32_features(const ArmCapabilities& capabilities) {
  if ((capabilities.hwcap & kNeon32) == 0) return 0;
  return (capabilities.hwcap & kDotProd32) != 0 ? kCpuNeon | kCpuDotProd : uint32_t{kCpuNeon};
}

#if BSM_ARCH_ARM
namespace {

// What the compiler may use anyway: Apple's and Windows' machines, bare metal.
constexpr uint32_t compiled_features() {
  uint32_t features = 0;
#if defined(__ARM_NEON) || defined(_M_ARM64)
  features |= kCpuNeon;
#endif
#if defined(__ARM_FEATURE_DOTPROD)
  features |= kCpuDotProd;
#endif
#if defined(__ARM_FEATURE_SVE)
  features |= kCpuSve;
  if (__ARM_FEATURE_SVE_BITS < 8 * kShortSve) features |= kCpuSveShort;  // 0: not known
#endif
#if defined(__ARM_FEATURE_SVE2)
  features |= kCpuSve2;
#endif
#if defined(__ARM_FEATURE_DSP) && __ARM_ARCH_PROFILE == 'M'
  features |= kCpuArmDsp;
#endif
#if defined(__ARM_FEATURE_MVE) && (__ARM_FEATURE_MVE & 1)
  features |= kCpuMve;
#endif
  return features;
}

#if BSM_ARCH_NEON && defined(__linux__) && defined(__aarch64__)
// Asks Linux itself, prctl(PR_SVE_GET_VL), for the bytes of an SVE vector, which are the lowest 16 bits. There must be SVE.
uint32_t sve_vector_bytes() {
  register long call asm("x8") = 167;
  register long result asm("x0") = 51;
  asm volatile("svc #0" : "+r"(result) : "r"(call) : "memory");
  return static_cast<uint32_t>(result) & 0xffffu;
}
#endif

}  // namespace

uint32_t cpu_features() {
  uint32_t features = compiled_features();
#if BSM_ARCH_NEON && defined(__linux__)
  constexpr unsigned long kHwcap = 16;
  constexpr unsigned long kHwcap2 = 26;
  ArmCapabilities capabilities{getauxval(kHwcap), getauxval(kHwcap2), 0};
#if defined(__aarch64__)
  if ((capabilities.hwcap & kSve64) != 0) capabilities.sve_bytes = sve_vector_bytes();
  features = arm64_features(capabilities);
#else
  features = arm32_features(capabilities);
#endif
#endif
  return features;
}
#endif

}  // namespace bsm
