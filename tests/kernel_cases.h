// kernel_cases.h - random arguments for every stage, run through a kernel and through scalar: one try_kernel for each
// argument struct, found by its type, so that a stage without one does not compile. Freestanding: the same trials run in a
// test program and in an image for a microcontroller.
#ifndef BSM_TESTS_KERNEL_CASES_H
#define BSM_TESTS_KERNEL_CASES_H

#include <stddef.h>
#include <stdint.h>

#include "rng.h"
#include "simd/kernels.h"
#include "yard.h"

namespace bsm::test {

// A setting of a trial, for messages.
struct Note {
  const char* name;
  int value;
};

// What is wrong with an output.
struct Difference {
  const char* what;
  size_t element;
  uint32_t kernel, scalar;  // equal: something was written around the memory
  const Note* notes;
  size_t notes_count;
};

// What a trial draws from and where its memory lies.
struct Trial {
  Rng& rng;
  Yard& yard;  // empty
  int width;   // 1..200
  int bits;    // a multiple of 64
  void (*report)(const Difference& difference);
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
  T* scalar;
  size_t count;
};
template <typename T>
Output<T> take_output(const Trial& trial, size_t count, size_t alignment = alignof(T));
template <typename T>
void check_output(const Trial& trial, const Output<T>& output, const char* what, const Note* notes, size_t notes_count);
template <typename T>
void check_output(const Trial& trial, const Output<T>& output, const char* what) {
  check_output(trial, output, what, nullptr, 0);
}
template <typename T, size_t kNotes>
void check_output(const Trial& trial, const Output<T>& output, const char* what, const Note (&notes)[kNotes]) {
  check_output(trial, output, what, notes, kNotes);
}

// Up to `most` values of a trial, in its yard.
template <typename T>
class List {
 public:
  List(const Trial& trial, int most) : data_(trial.yard.take_array<T>(static_cast<size_t>(most))) {}
  void push_back(T value) { data_[count_++] = value; }
  T back() const { return data_[count_ - 1]; }
  T* data() const { return data_; }

 private:
  T* data_;
  int count_ = 0;
};

inline int lesser(int a, int b) {
  return a < b ? a : b;
}

}  // namespace bsm::test

#endif  // BSM_TESTS_KERNEL_CASES_H
