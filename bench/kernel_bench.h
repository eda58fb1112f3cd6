// Times every kernel of simd/kernels.def that this machine can run, beside the scalar kernel of its stage.
#ifndef BSM_BENCH_KERNEL_BENCH_H
#define BSM_BENCH_KERNEL_BENCH_H

#include <cstdint>
#include <string>
#include <vector>

namespace bsm::bench {

struct KernelBench {
  std::string isa = "all";  // kernels of this instruction set alone
  std::string filter;       // kernels whose name holds this
  int32_t width = 450;
  int32_t bits = 256;
  int32_t disparities = 64;
  int32_t repeat = 31;
  bool csv = false;
};

// Names of the instruction sets that this machine has kernels for, scalar first.
std::vector<std::string> kernel_isas();

// False with a sentence when no kernel is asked for.
bool check_kernel_bench(const KernelBench& bench, std::string* error);

// Measures and prints.
void run_kernel_bench(const KernelBench& bench);

}  // namespace bsm::bench

#endif  // BSM_BENCH_KERNEL_BENCH_H
