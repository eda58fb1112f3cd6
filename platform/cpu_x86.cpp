// x86: features from CPUID and from XCR0, which tells what register state the operating system saves. A CPU that has AVX-512
// under a system that does not enable it must not run it.
#include "platform/compiler.h"
#include "platform/cpu.h"

#if BSM_ARCH_X86
#if defined(_MSC_VER) && !defined(__clang__)
#include <intrin.h>
#else
#include <cpuid.h>
#endif
#endif

namespace bsm {
namespace {

// Positions in CPUID.1:ECX.
constexpr uint32_t kSse3 = 1u << 0;
constexpr uint32_t kSsse3 = 1u << 9;
constexpr uint32_t kSse41 = 1u << 19;
constexpr uint32_t kSse42 = 1u << 20;
constexpr uint32_t kPopcnt = 1u << 23;
constexpr uint32_t kOsXsave = 1u << 27;
constexpr uint32_t kAvx = 1u << 28;
// Positions in CPUID.7.0:EBX.
constexpr uint32_t kAvx2 = 1u << 5;
constexpr uint32_t kAvx512F = 1u << 16;
constexpr uint32_t kAvx512Dq = 1u << 17;
constexpr uint32_t kAvx512Bw = 1u << 30;
constexpr uint32_t kAvx512Vl = 1u << 31;
// Positions in CPUID.7.0:ECX.
constexpr uint32_t kVbmi = 1u << 1;
constexpr uint32_t kGfni = 1u << 8;
constexpr uint32_t kVpopcntdq = 1u << 14;
// Positions in XCR0.
constexpr uint64_t kYmmState = 0x06;  // XMM and the upper halves of YMM
constexpr uint64_t kZmmState = 0xe6;  // the same, mask registers, upper halves of ZMM0..15, ZMM16..31

template <class Word>
constexpr bool has(Word word, Word bits) {
  return (word & bits) == bits;
}

}  // namespace

uint32_t x86_features(const X86Registers& registers) {
  uint32_t features = 0;
  if (registers.max_leaf < 1) return features;
  const uint32_t leaf1 = registers.leaf1_ecx;
  if (has(leaf1, kPopcnt)) features |= kCpuPopcnt;
  if (has(leaf1, kSse3 | kSsse3 | kSse41 | kSse42)) features |= kCpuSse42;
  if (registers.max_leaf < 7 || !has(leaf1, kOsXsave | kAvx)) return features;

  const uint32_t ebx = registers.leaf7_ebx;
  if (!has(registers.xcr0, kYmmState) || !has(ebx, kAvx2)) return features;
  features |= kCpuAvx2;
  if (!has(registers.xcr0, kZmmState) || !has(ebx, kAvx512F | kAvx512Bw | kAvx512Dq | kAvx512Vl)) return features;
  features |= kCpuAvx512;
  if (has(registers.leaf7_ecx, kVbmi)) features |= kCpuAvx512Vbmi;
  if (has(registers.leaf7_ecx, kGfni)) features |= kCpuAvx512Gfni;
  if (has(registers.leaf7_ecx, kVpopcntdq)) features |= kCpuAvx512Vpopcntdq;
  return features;
}

#if BSM_ARCH_X86
namespace {

struct Leaf {
  uint32_t eax, ebx, ecx, edx;
};

Leaf cpuid(uint32_t number) {
  Leaf leaf{};
#if defined(_MSC_VER) && !defined(__clang__)
  int words[4];
  __cpuidex(words, static_cast<int>(number), 0);
  leaf = Leaf{static_cast<uint32_t>(words[0]), static_cast<uint32_t>(words[1]), static_cast<uint32_t>(words[2]),
              static_cast<uint32_t>(words[3])};
#else
  __cpuid_count(number, 0, leaf.eax, leaf.ebx, leaf.ecx, leaf.edx);
#endif
  return leaf;
}

uint64_t read_xcr0() {
#if defined(_MSC_VER) && !defined(__clang__)
  return _xgetbv(0);
#else
  uint32_t low, high;
  __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
  return uint64_t{high} << 32 | low;
#endif
}

}  // namespace

uint32_t cpu_features() {
  X86Registers registers{};
  registers.max_leaf = cpuid(0).eax;
  if (registers.max_leaf >= 1) registers.leaf1_ecx = cpuid(1).ecx;
  if (registers.max_leaf >= 7) {
    const Leaf leaf = cpuid(7);
    registers.leaf7_ebx = leaf.ebx;
    registers.leaf7_ecx = leaf.ecx;
  }
  if (has(registers.leaf1_ecx, kOsXsave)) registers.xcr0 = read_xcr0();
  return x86_features(registers);
}
#endif

}  // namespace bsm
