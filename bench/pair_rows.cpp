// Runs the stages on a pair and keeps their rows.
#include "bench/pair_rows.h"

#include <algorithm>

#include "bench/configurations.h"
#include "bench/frame_run.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

constexpr int32_t kSampledRows = 4;
constexpr int32_t kBefore = 32;  // values before x = 0, more than a pattern's radius
constexpr int32_t kAfter = 128;  // values after the row, more than a radius and a block

template <typename T>
void replicate_border(T* row, int32_t width) {
  std::fill(row - kBefore, row, row[0]);
  std::fill(row + width, row + width + kAfter, row[width - 1]);
}

}  // namespace

size_t PairRows::row_of(int32_t y) const {
  return static_cast<size_t>(std::clamp(y, 0, height_ - 1));
}

void PairRows::convert(const host::Image8& image, const Kernels& kernels, View* view) {
  for (int32_t y = 0; y < height_; ++y) {
    uint16_t* const luma = memory_->take<uint16_t>(static_cast<size_t>(width_ + kBefore + kAfter)) + kBefore;
    uint8_t* const lab = memory_->take<uint8_t>(static_cast<size_t>(plane_stride_ * planes_)) + kBefore;
    kernels.color_lab(ColorLabArgs{image.row(y), nullptr, planes_ == 1 ? BSM_FORMAT_GRAY8 : BSM_FORMAT_RGB24, width_, luma,
                                   lab, plane_stride_, planes_});
    replicate_border(luma, width_);
    for (int32_t plane = 0; plane < planes_; ++plane) replicate_border(lab + plane * plane_stride_, width_);
    view->luma.push_back(luma);
    view->lab.push_back(lab);
  }
}

void PairRows::window(int32_t y, int32_t radius, const View& view, Inputs& inputs, DescriptorCompareArgs* args) const {
  inputs.rows16.clear();
  for (int32_t dy = -radius; dy <= radius; ++dy) inputs.rows16.push_back(view.luma[row_of(y + dy)]);
  args->rows = inputs.rows16.data();
}

void PairRows::window(int32_t y, int32_t radius, const View& view, Inputs& inputs, MaskThresholdArgs* args) const {
  inputs.rows8.clear();
  for (int32_t dy = -radius; dy <= radius; ++dy) inputs.rows8.push_back(view.lab[row_of(y + dy)]);
  args->rows = inputs.rows8.data();
  args->plane_stride = plane_stride_;
  args->planes = planes_;
}

void PairRows::describe(const Kernels& kernels, View* view) {
  const size_t bytes = static_cast<size_t>(width_ + kBlock) * static_cast<size_t>(bits_ / 8);
  view->descriptor.resize(view->lab.size());
  view->mask.resize(view->lab.size());
  for (const int32_t y : sampled_) {
    Inputs inputs(width_, bits_, disparities_, kBlock);
    DescriptorCompareArgs compare;
    prepare(inputs, kernels.scratch[BSM_KERNEL_DESCRIPTOR], &compare);
    window(y, compare.pattern.radius, *view, inputs, &compare);
    uint8_t* const descriptor = memory_->take<uint8_t>(bytes);
    compare.out = descriptor;
    kernels.descriptor_compare(compare);
    view->descriptor[row_of(y)] = descriptor;
    MaskThresholdArgs threshold;
    prepare(inputs, kernels.scratch[BSM_KERNEL_MASK], &threshold);
    window(y, threshold.pattern.radius, *view, inputs, &threshold);
    uint8_t* const mask = memory_->take<uint8_t>(bytes);
    threshold.out = mask;
    kernels.mask_threshold(threshold);
    view->mask[row_of(y)] = mask;
  }
}

bool PairRows::match(const host::Image8& left, const host::Image8& right, int32_t smooth_passes, bsm_stage stage,
                     std::vector<const uint16_t*>* levels, std::string* error) {
  bsm_config config = preset_configuration(BSM_PRESET_BALANCED, gray()).config;
  config.width = width_;
  config.height = height_;
  config.num_disparities = disparities_;
  config.smooth_passes = smooth_passes;
  config.stage = stage;
  FrameRun frame;
  double milliseconds = 0.0;
  if (!frame.open(config, error) || !frame.match(left, right, &milliseconds, error)) return false;
  const int16_t* disparity = frame.disparity().data();
  for (int32_t y = 0; y < height_; ++y) {
    uint16_t* const row = memory_->take<uint16_t>(static_cast<size_t>(width_ + kAfter));
    for (int32_t x = 0; x < width_; ++x, ++disparity) row[x] = *disparity < 0 ? kNoLevel : static_cast<uint16_t>(*disparity);
    levels->push_back(row);
  }
  return true;
}

bool PairRows::open(const std::string& left_path, const std::string& right_path, int32_t bits, int32_t disparities,
                    std::string* error) {
  host::Image8 left, right;
  if (!read_views(left_path, right_path, &left, &right, error)) return false;
  width_ = left.width;
  height_ = left.height;
  planes_ = left.channels;
  bits_ = bits;
  disparities_ = disparities;
  plane_stride_ = width_ + kBefore + kAfter;
  for (int32_t i = 0; i < kSampledRows; ++i) sampled_.push_back(height_ * (2 * i + 1) / (2 * kSampledRows));
  memory_ = std::make_unique<Inputs>(width_, bits_, disparities_, kBlock);
  const Kernels kernels = select_kernels(cpu_features());
  convert(left, kernels, &left_);
  convert(right, kernels, &right_);
  describe(kernels, &left_);
  describe(kernels, &right_);
  return match(left, right, 0, BSM_STAGE_CHECKED, &checked_, error) &&
         match(left, right, 0, BSM_STAGE_REFINED, &dense_, error);
}

void PairRows::use_row(int32_t y, Inputs& inputs, MaskThresholdArgs* args) const {
  window(y, args->pattern.radius, left_, inputs, args);
}

void PairRows::use_row(int32_t y, Inputs&, MatchHammingArgs* args) const {
  args->left = left_.descriptor[row_of(y)];
  args->right = right_.descriptor[row_of(y)];
  args->left_mask = left_.mask[row_of(y)];
  args->right_mask = right_.mask[row_of(y)];
}

void PairRows::use_row(int32_t y, Inputs& inputs, AggregateAlongArgs* args) const {
  CostHammingArgs count;
  prepare(inputs, cost_hamming_scalar_scratch, &count);
  count.own = left_.descriptor[row_of(y)];
  count.own_mask = left_.mask[row_of(y)];
  count.other = right_.descriptor[row_of(y)];
  cost_hamming_scalar(count);
  args->cost = count.cost;
}

void PairRows::use_row(int32_t y, Inputs& inputs, MedianWeightedArgs* args) const {
  inputs.rows16.clear();
  inputs.rows8.clear();
  for (int32_t dy = -args->radius; dy <= args->radius; ++dy) {
    const bool inside = y + dy >= 0 && y + dy < height_;
    inputs.rows16.push_back(inside ? dense_[row_of(y + dy)] : nullptr);
    inputs.rows8.push_back(inside ? left_.lab[row_of(y + dy)] : nullptr);
  }
  args->levels = inputs.rows16.data();
  args->lab = inputs.rows8.data();
  args->plane_stride = plane_stride_;
  args->planes = planes_;
  args->checked = checked_[row_of(y)];
}

}  // namespace bsm::bench
