// Inputs of the measured kernels: for each argument struct one prepare, found by its type, so that a stage without one does
// not compile. Contents are the same for every kernel of a stage and resemble a scene's: the cost of a kernel that skips
// work depends on them.
#ifndef BSM_BENCH_KERNEL_INPUTS_H
#define BSM_BENCH_KERNEL_INPUTS_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "simd/kernels.h"

namespace bsm::bench {

// Uniform numbers, the same for the same seed everywhere.
class Rng {
 public:
  uint64_t next();
  int32_t range(int32_t least, int32_t most);  // both included
  bool one_in(int32_t n) { return range(1, n) == 1; }

 private:
  uint64_t state_ = 1;
};

// Sizes of a measurement and everything that its arguments point to.
class Inputs {
 public:
  Inputs(int32_t row_width, int32_t row_bits, int32_t levels, int32_t kernel_block)
      : width(row_width), bits(row_bits), disparities(levels), block(kernel_block) {}
  Inputs(const Inputs&) = delete;
  Inputs& operator=(const Inputs&) = delete;

  const int32_t width, bits, disparities;
  const int32_t block;  // of the kernel, along its stage's axis
  Rng rng;
  std::vector<const uint16_t*> rows16;
  std::vector<const uint8_t*> rows8;

  // Zeroed values at a cache line's start that may be read well beyond both ends.
  template <typename T>
  T* take(size_t count) {
    return static_cast<T*>(take_bytes(count * sizeof(T)));
  }
  void* take_scratch(kernel_scratch_fn* scratch, int32_t radius);
  int32_t level_stride() const { return (disparities + block - 1) / block * block; }

 private:
  void* take_bytes(size_t bytes);

  std::vector<std::unique_ptr<uint8_t[]>> memory_;
};

void prepare(Inputs& inputs, kernel_scratch_fn* scratch, ColorLabArgs* args);
void prepare(Inputs& inputs, kernel_scratch_fn* scratch, DescriptorCompareArgs* args);
void prepare(Inputs& inputs, kernel_scratch_fn* scratch, MaskThresholdArgs* args);
void prepare(Inputs& inputs, kernel_scratch_fn* scratch, MatchHammingArgs* args);
void prepare(Inputs& inputs, kernel_scratch_fn* scratch, CostHammingArgs* args);
void prepare(Inputs& inputs, kernel_scratch_fn* scratch, EdgeThresholdArgs* args);
void prepare(Inputs& inputs, kernel_scratch_fn* scratch, AggregateAlongArgs* args);
void prepare(Inputs& inputs, kernel_scratch_fn* scratch, AggregateAcrossArgs* args);
void prepare(Inputs& inputs, kernel_scratch_fn* scratch, WinnerSumsArgs* args);
void prepare(Inputs& inputs, kernel_scratch_fn* scratch, VoteWeighArgs* args);
void prepare(Inputs& inputs, kernel_scratch_fn* scratch, MedianWeightedArgs* args);
void prepare(Inputs& inputs, kernel_scratch_fn* scratch, FractionSmoothArgs* args);

}  // namespace bsm::bench

#endif  // BSM_BENCH_KERNEL_INPUTS_H
