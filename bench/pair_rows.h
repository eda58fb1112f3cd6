// Rows of a real pair as kernels take them: what a kernel skips depends on its input, and made-up rows may flatter it.
#ifndef BSM_BENCH_PAIR_ROWS_H
#define BSM_BENCH_PAIR_ROWS_H

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bench/kernel_inputs.h"
#include "host/image.h"
#include "simd/kernels.h"

namespace bsm::bench {

// Arguments and the memory they point to.
template <class Args>
struct Call {
  std::unique_ptr<Inputs> inputs;
  Args args;
};

class PairRows {
 public:
  // Reads the pair and computes, with the best kernels, what the stages hand to each other. False with a sentence.
  bool open(const std::string& left_path, const std::string& right_path, int32_t bits, int32_t disparities,
            std::string* error);

  int32_t width() const { return width_; }
  int32_t height() const { return height_; }
  int32_t bits() const { return bits_; }
  int32_t disparities() const { return disparities_; }
  bool gray() const { return planes_ == 1; }
  // The rows that are measured, spread over the image.
  const std::vector<int32_t>& sampled() const { return sampled_; }

  // A kernel's arguments on row y, with outputs and scratch of their own.
  template <class Args>
  Call<Args> call(int32_t y, kernel_scratch_fn* scratch) const {
    Call<Args> made{std::make_unique<Inputs>(width_, bits_, disparities_, kBlock), {}};
    prepare(*made.inputs, scratch, &made.args);
    use_row(y, *made.inputs, &made.args);
    return made;
  }

 private:
  static constexpr int32_t kBlock = 64;  // of the widest kernel

  struct View {
    std::vector<const uint16_t*> luma;  // by row; x = 0 at the pointer
    std::vector<const uint8_t*> lab;
    std::vector<const uint8_t*> descriptor, mask;  // by row, of the sampled rows alone
  };

  void convert(const host::Image8& image, const Kernels& kernels, View* view);
  void describe(const Kernels& kernels, View* view);
  bool match(const host::Image8& left, const host::Image8& right, int32_t smooth_passes, bsm_stage stage,
             std::vector<const uint16_t*>* levels, std::string* error);
  size_t row_of(int32_t y) const;

  void window(int32_t y, int32_t radius, const View& view, Inputs& inputs, DescriptorCompareArgs* args) const;
  void window(int32_t y, int32_t radius, const View& view, Inputs& inputs, MaskThresholdArgs* args) const;
  void use_row(int32_t y, Inputs& inputs, MaskThresholdArgs* args) const;
  void use_row(int32_t y, Inputs& inputs, MatchHammingArgs* args) const;
  void use_row(int32_t y, Inputs& inputs, AggregateAlongArgs* args) const;
  void use_row(int32_t y, Inputs& inputs, MedianWeightedArgs* args) const;

  int32_t width_ = 0, height_ = 0, planes_ = 0, bits_ = 0, disparities_ = 0;
  ptrdiff_t plane_stride_ = 0;
  std::vector<int32_t> sampled_;
  View left_, right_;
  std::vector<const uint16_t*> checked_, dense_;  // maps: after the check, and without holes before smoothing
  std::unique_ptr<Inputs> memory_;
};

}  // namespace bsm::bench

#endif  // BSM_BENCH_PAIR_ROWS_H
