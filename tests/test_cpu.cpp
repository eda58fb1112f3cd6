// test_cpu.cpp - CPU detection from register values: every feature by its own bit, and only with the operating system's
// help.
#include <cstring>
#include <set>
#include <string>

#include "bsm/bsm.h"
#include "check.h"
#include "platform/cpu.h"
#include "simd/isa.h"

using namespace bsm;
using namespace bsm::test;

namespace {

constexpr uint32_t kX86All =
    kCpuPopcnt | kCpuSse42 | kCpuAvx2 | kCpuAvx512 | kCpuAvx512Vbmi | kCpuAvx512Gfni | kCpuAvx512Vpopcntdq;

// A recent x86 server under a system that saves everything.
X86Registers full_machine() {
  X86Registers registers{};
  registers.max_leaf = 16;
  registers.leaf1_ecx = 1u << 0 | 1u << 9 | 1u << 19 | 1u << 20 | 1u << 23 | 1u << 27 | 1u << 28;
  registers.leaf7_ebx = 1u << 5 | 1u << 16 | 1u << 17 | 1u << 30 | 1u << 31;
  registers.leaf7_ecx = 1u << 1 | 1u << 8 | 1u << 14;
  registers.xcr0 = 0xe7;
  return registers;
}

uint32_t without_leaf1(int bit) {
  X86Registers registers = full_machine();
  registers.leaf1_ecx &= ~(1u << bit);
  return x86_features(registers);
}
uint32_t without_leaf7_ebx(int bit) {
  X86Registers registers = full_machine();
  registers.leaf7_ebx &= ~(1u << bit);
  return x86_features(registers);
}
uint32_t without_leaf7_ecx(int bit) {
  X86Registers registers = full_machine();
  registers.leaf7_ecx &= ~(1u << bit);
  return x86_features(registers);
}
uint32_t with_xcr0(uint64_t xcr0) {
  X86Registers registers = full_machine();
  registers.xcr0 = xcr0;
  return x86_features(registers);
}
uint32_t with_max_leaf(uint32_t leaf) {
  X86Registers registers = full_machine();
  registers.max_leaf = leaf;
  return x86_features(registers);
}

}  // namespace

TEST_CASE(x86_full_machine) {
  CHECK_EQ(x86_features(full_machine()), kX86All);
}

TEST_CASE(x86_nothing) {
  CHECK_EQ(x86_features(X86Registers{}), 0u);
}

TEST_CASE(x86_each_bit_alone) {
  CHECK_EQ(without_leaf1(23), kX86All & ~kCpuPopcnt);
  for (const int bit : {0, 9, 19, 20}) CHECK_EQ(without_leaf1(bit), kX86All & ~kCpuSse42);
  CHECK_EQ(without_leaf1(28), kCpuPopcnt | kCpuSse42);     // no AVX
  CHECK_EQ(without_leaf7_ebx(5), kCpuPopcnt | kCpuSse42);  // AVX without AVX2
  for (const int bit : {16, 17, 30, 31}) CHECK_EQ(without_leaf7_ebx(bit), kIsaAvx2);
  CHECK_EQ(without_leaf7_ecx(1), kX86All & ~kCpuAvx512Vbmi);
  CHECK_EQ(without_leaf7_ecx(8), kX86All & ~kCpuAvx512Gfni);
  CHECK_EQ(without_leaf7_ecx(14), kX86All & ~kCpuAvx512Vpopcntdq);
}

TEST_CASE(x86_system_state) {
  CHECK_EQ(without_leaf1(27), kIsaSse42);  // XCR0 cannot be read
  CHECK_EQ(with_xcr0(0), kIsaSse42);       //
  CHECK_EQ(with_xcr0(0x3), kIsaSse42);     // XMM alone
  CHECK_EQ(with_xcr0(0x5), kIsaSse42);     // YMM without XMM
  CHECK_EQ(with_xcr0(0x7), kIsaAvx2);      // AVX-512 present, not enabled
  CHECK_EQ(with_xcr0(0x27), kIsaAvx2);     // mask registers alone
  CHECK_EQ(with_xcr0(0x67), kIsaAvx2);     // without ZMM16..31
  CHECK_EQ(with_xcr0(0xa7), kIsaAvx2);     // without the upper halves of ZMM0..15
  CHECK_EQ(with_xcr0(0xe0), kIsaSse42);    // AVX-512 state without YMM
  CHECK_EQ(with_xcr0(0xe7), kX86All);
  CHECK_EQ(with_xcr0(~uint64_t{0}), kX86All);
}

TEST_CASE(x86_leaves_that_do_not_exist) {
  CHECK_EQ(with_max_leaf(0), 0u);
  CHECK_EQ(with_max_leaf(1), kIsaSse42);
  CHECK_EQ(with_max_leaf(6), kIsaSse42);
  CHECK_EQ(with_max_leaf(7), kX86All);
}

TEST_CASE(arm_capabilities) {
  CHECK_EQ(arm64_features({0, 0, 0}), 0u);
  CHECK_EQ(arm64_features({1u << 1, 0, 0}), uint32_t{kCpuNeon});
  CHECK_EQ(arm64_features({1u << 1 | 1u << 20, 0, 0}), kCpuNeon | kCpuDotProd);
  CHECK_EQ(arm64_features({1u << 1 | 1u << 22, 0, 64}), kCpuNeon | kCpuSve);
  CHECK_EQ(arm64_features({1u << 1 | 1u << 22, 0, 256}), kCpuNeon | kCpuSve);
  CHECK_EQ(arm64_features({1u << 1 | 1u << 22, 0, 32}), kCpuNeon | kCpuSve | kCpuSveShort);
  CHECK_EQ(arm64_features({1u << 1 | 1u << 22, 1u << 1, 64}), kCpuNeon | kCpuSve | kCpuSve2);
  CHECK_EQ(arm64_features({1u << 1, 1u << 1, 64}), uint32_t{kCpuNeon});  // SVE2 builds upon SVE
  CHECK_EQ(arm32_features({0, 0, 0}), 0u);
  CHECK_EQ(arm32_features({1u << 12, 0, 0}), uint32_t{kCpuNeon});
  CHECK_EQ(arm32_features({1u << 12 | 1u << 24, 0, 0}), kCpuNeon | kCpuDotProd);
}

// M-profile processors report nothing: a host sees only that the sets build upon each other and bear names.
TEST_CASE(m_profile) {
  CHECK_EQ(kIsaDsp, uint32_t{kCpuArmDsp});
  CHECK_EQ(kIsaMve, kCpuArmDsp | kCpuMve);
  CHECK_EQ(std::string(cpu_feature_name(24)), std::string("dsp"));
  CHECK_EQ(std::string(cpu_feature_name(25)), std::string("mve"));
  CHECK_EQ(arm32_features({~uint64_t{0}, ~uint64_t{0}, ~uint32_t{0}}) & kIsaMve, 0u);  // no Linux machine has them
  CHECK_EQ(arm64_features({~uint64_t{0}, ~uint64_t{0}, ~uint32_t{0}}) & kIsaMve, 0u);
}

TEST_CASE(names) {
  std::set<std::string> names;
  for (int bit = 0; bit < 32; ++bit) {
    const char* name = cpu_feature_name(bit);
    if (name != nullptr) CHECK(names.insert(name).second);
  }
  CHECK(names.count("avx2") == 1 && names.count("neon") == 1);
  CHECK(cpu_feature_name(-1) == nullptr);
  CHECK(cpu_feature_name(32) == nullptr);
  // The running machine has no feature without a name.
  for (int bit = 0; bit < 32; ++bit) {
    if ((bsm_cpu_features() >> bit & 1u) != 0) CHECK(cpu_feature_name(bit) != nullptr);
  }
}
