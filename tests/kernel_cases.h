// kernel_cases.h - random arguments for every stage, run through a kernel and through scalar: one try_kernel for each
// argument struct, found by its type, so that a stage without one does not compile.
#ifndef BSM_TESTS_KERNEL_CASES_H
#define BSM_TESTS_KERNEL_CASES_H

#include <string>
#include <vector>

#include "check.h"
#include "simd/kernels.h"
#include "yard.h"

namespace bsm::test {

// What a trial draws from and where its memory lies.
struct Trial {
  Rng& rng;
  Yard& yard;  // empty
  int width;   // 1..200
  int bits;    // a multiple of 64
};

template <class Args>
struct Kernel {
  void (*run)(const Args& args);
  kernel_scratch_fn* scratch;
  int block;
};

// Checks one trial: the same bytes as scalar, and nothing written elsewhere.
void try_kernel(const Trial& trial, const Kernel<ColorLabArgs>& kernel, const Kernel<ColorLabArgs>& scalar);
void try_kernel(const Trial& trial, const Kernel<DescriptorCompareArgs>& kernel,
                const Kernel<DescriptorCompareArgs>& scalar);
void try_kernel(const Trial& trial, const Kernel<MaskThresholdArgs>& kernel, const Kernel<MaskThresholdArgs>& scalar);
void try_kernel(const Trial& trial, const Kernel<MatchHammingArgs>& kernel, const Kernel<MatchHammingArgs>& scalar);
void try_kernel(const Trial& trial, const Kernel<CostHammingArgs>& kernel, const Kernel<CostHammingArgs>& scalar);
void try_kernel(const Trial& trial, const Kernel<EdgeThresholdArgs>& kernel, const Kernel<EdgeThresholdArgs>& scalar);
void try_kernel(const Trial& trial, const Kernel<AggregateAlongArgs>& kernel, const Kernel<AggregateAlongArgs>& scalar);
void try_kernel(const Trial& trial, const Kernel<AggregateAcrossArgs>& kernel, const Kernel<AggregateAcrossArgs>& scalar);
void try_kernel(const Trial& trial, const Kernel<WinnerSumsArgs>& kernel, const Kernel<WinnerSumsArgs>& scalar);
void try_kernel(const Trial& trial, const Kernel<VoteWeighArgs>& kernel, const Kernel<VoteWeighArgs>& scalar);
void try_kernel(const Trial& trial, const Kernel<MedianWeightedArgs>& kernel, const Kernel<MedianWeightedArgs>& scalar);
void try_kernel(const Trial& trial, const Kernel<FractionSmoothArgs>& kernel, const Kernel<FractionSmoothArgs>& scalar);

// Pieces that the trials of all stages are made of.

// Contents of a row.
enum class Values { kNoise, kConstant, kFew, kExtremes, kSmooth };
template <typename T>
void fill(Rng& rng, T* values, size_t count, Values kind);
Values any_values(Rng& rng);

inline int round_up(int value, int multiple) {
  return (value + multiple - 1) / multiple * multiple;
}

// Scratch of exactly the size that the kernel asks for, with any contents.
void* take_scratch(const Trial& trial, kernel_scratch_fn* scratch, const KernelShape& shape);

// An output of a kernel and of scalar: `count` values each, the same before the run; to be equal after it.
template <typename T>
struct Output {
  T* kernel;
  std::vector<T> scalar;
};
template <typename T>
Output<T> take_output(const Trial& trial, size_t count, size_t alignment = alignof(T));
template <typename T>
void check_output(const Trial& trial, const Output<T>& output, const char* what);

}  // namespace bsm::test

#endif  // BSM_TESTS_KERNEL_CASES_H
