// Rows of a real pair as kernels take them: what a kernel skips depends on its input, and made-up rows may flatter it.
#ifndef BSM_BENCH_PAIR_ROWS_H
#define BSM_BENCH_PAIR_ROWS_H

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bench/frame_run.h"
#include "bench/kernel_inputs.h"
#include "bench/plain_forms.h"
#include "bench/plain_stages.h"
#include "host/image.h"
#include "simd/kernels.h"

namespace bsm::bench {

void prepare(Inputs& inputs, kernel_scratch_fn* scratch, TwoOrdersArgs* args);
// Rows are all that a stage of core/ takes.
inline void prepare(Inputs&, kernel_scratch_fn*, RemoveSpecklesArgs*) {}
inline void prepare(Inputs&, kernel_scratch_fn*, FillHolesArgs*) {}
inline void prepare(Inputs&, kernel_scratch_fn*, MedianArgs*) {}

// Arguments and the memory they point to.
template <class Args>
struct Call {
  std::unique_ptr<Inputs> inputs;
  Args args;
};

class PairRows {
 public:
  // Computes, with the kernels that the configuration allows, what the stages hand to each other for a pair of its size and
  // format; without maps what needs no whole frame. False with a sentence.
  bool open(const host::Image8& left, const host::Image8& right, const bsm_config& config, bool maps, std::string* error);
  bool has_maps() const { return !dense_.empty(); }

  int32_t width() const { return config_.width; }
  int32_t height() const { return config_.height; }
  const bsm_config& config() const { return config_; }
  // What the kernels may use.
  uint32_t features() const;
  // The rows that are measured, spread over the image.
  const std::vector<int32_t>& sampled() const { return sampled_; }

  // A kernel's arguments on row y, with outputs and scratch of their own.
  template <class Args>
  Call<Args> call(int32_t y, kernel_scratch_fn* scratch) const {
    Call<Args> made{std::make_unique<Inputs>(config_.width, config_.bits, config_.num_disparities, kBlock), {}};
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
  bool match(const host::Image8& left, const host::Image8& right, const bsm_config& config,
             std::vector<const uint16_t*>* levels, std::string* error);
  size_t row_of(int32_t y) const;
  std::vector<const uint16_t*> rows_inside(const std::vector<const uint16_t*>& map, int32_t y, int32_t radius) const;

  void use_view(int32_t y, const View& view, Inputs& inputs, DescriptorCompareArgs* args) const;
  void use_view(int32_t y, const View& view, Inputs& inputs, MaskThresholdArgs* args) const;
  void use_row(int32_t y, Inputs& inputs, DescriptorCompareArgs* args) const;
  void use_row(int32_t y, Inputs& inputs, MaskThresholdArgs* args) const;
  void use_row(int32_t y, Inputs& inputs, MatchHammingArgs* args) const;
  void use_row(int32_t y, Inputs& inputs, TwoOrdersArgs* args) const;
  void use_row(int32_t y, Inputs& inputs, AggregateAlongArgs* args) const;
  void use_row(int32_t y, Inputs& inputs, VoteWeighArgs* args) const;
  void use_row(int32_t y, Inputs& inputs, MedianWeightedArgs* args) const;
  void use_row(int32_t y, Inputs& inputs, RemoveSpecklesArgs* args) const;
  void use_row(int32_t y, Inputs& inputs, FillHolesArgs* args) const;
  void use_row(int32_t y, Inputs& inputs, MedianArgs* args) const;

  bsm_config config_{};
  FrameRun frame_;  // whose context holds the pattern
  Pattern pattern_{};
  int32_t planes_ = 0;
  ptrdiff_t plane_stride_ = 0;
  std::vector<int32_t> sampled_;
  View left_, right_;
  std::vector<const uint16_t*> checked_, dense_;  // maps: after the check, and without holes before smoothing
  std::unique_ptr<Inputs> memory_;
};

}  // namespace bsm::bench

#endif  // BSM_BENCH_PAIR_ROWS_H
