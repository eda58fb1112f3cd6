// The instruction sets that kernels are written for: which CPU features a kernel file may use. core/CMakeLists.txt gives the
// file exactly these by its flags, simd/kernels.def asks the machine for exactly these.
#ifndef BSM_SIMD_ISA_H
#define BSM_SIMD_ISA_H

#include <stdint.h>

#include "platform/cpu.h"

namespace bsm {

constexpr uint32_t kIsaScalar = 0;
constexpr uint32_t kIsaSse42 = kCpuPopcnt | kCpuSse42;
constexpr uint32_t kIsaAvx2 = kIsaSse42 | kCpuAvx2;
constexpr uint32_t kIsaAvx512 = kIsaAvx2 | kCpuAvx512 | kCpuAvx512Vbmi | kCpuAvx512Gfni | kCpuAvx512Vpopcntdq;
constexpr uint32_t kIsaNeon = kCpuNeon;
constexpr uint32_t kIsaDsp = kCpuArmDsp;
constexpr uint32_t kIsaMve = kCpuArmDsp | kCpuMve;
constexpr uint32_t kIsaSimd128 = kCpuSimd128;
constexpr uint32_t kIsaSve = kIsaNeon | kCpuSve;

}  // namespace bsm

#endif  // BSM_SIMD_ISA_H
