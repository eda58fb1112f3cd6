// Runs the stages on a pair and keeps their rows.
#include "bench/pair_rows.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "bench/configurations.h"
#include "core/context.h"
#include "core/speckle.h"
#include "core/weights.h"

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

// The eighth of a circle in which a point lies.
int32_t direction_of(int32_t dx, int32_t dy) {
  const int32_t steep = std::abs(dy) > std::abs(dx) ? 1 : 0;
  return (dx < 0 ? 4 : 0) + (dy < 0 ? 2 : 0) + steep;
}

// The pattern's bits, those first whose points lie in the first directions.
std::vector<int32_t> coherent_order(const Pattern& pattern) {
  const auto key = [&pattern](int32_t bit) {
    const PixelPair& pair = pattern.pairs[bit];
    return 8 * direction_of(pair.px, pair.py) + direction_of(pair.qx, pair.qy);
  };
  std::vector<int32_t> order(static_cast<size_t>(pattern.bits));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&key](int32_t a, int32_t b) { return key(a) < key(b); });
  return order;
}

// The same bits of each pixel in another order.
const uint8_t* reorder(const uint8_t* bits, int32_t width, const std::vector<int32_t>& order, Inputs& inputs) {
  const size_t bytes = order.size() / 8;
  uint8_t* const out = inputs.take<uint8_t>(static_cast<size_t>(width) * bytes);
  for (size_t first = 0; first < static_cast<size_t>(width) * bytes; first += bytes) {
    for (size_t i = 0; i < order.size(); ++i) {
      const int32_t from = order[i];
      const uint32_t bit = static_cast<uint32_t>(bits[first + static_cast<size_t>(from / 8)]) >> from % 8 & 1u;
      out[first + i / 8] = static_cast<uint8_t>(out[first + i / 8] | bit << i % 8);
    }
  }
  return out;
}

}  // namespace

void prepare(Inputs& inputs, kernel_scratch_fn* scratch, TwoOrdersArgs* args) {
  prepare(inputs, scratch, &args->given);
  prepare(inputs, scratch, &args->coherent);
}

size_t PairRows::row_of(int32_t y) const {
  return static_cast<size_t>(std::clamp(y, 0, height() - 1));
}

uint32_t PairRows::features() const {
  return cpu_features() & config_.isa_mask;
}

void PairRows::convert(const host::Image8& image, const Kernels& kernels, View* view) {
  for (int32_t y = 0; y < height(); ++y) {
    uint16_t* const luma = memory_->take<uint16_t>(static_cast<size_t>(width() + kBefore + kAfter)) + kBefore;
    uint8_t* const lab = memory_->take<uint8_t>(static_cast<size_t>(plane_stride_ * planes_)) + kBefore;
    kernels.color_lab(ColorLabArgs{image.row(y), nullptr, config_.format, width(), luma, lab, plane_stride_, planes_});
    replicate_border(luma, width());
    for (int32_t plane = 0; plane < planes_; ++plane) replicate_border(lab + plane * plane_stride_, width());
    view->luma.push_back(luma);
    view->lab.push_back(lab);
  }
}

void PairRows::use_view(int32_t y, const View& view, Inputs& inputs, DescriptorCompareArgs* args) const {
  inputs.rows16.clear();
  for (int32_t dy = -pattern_.radius; dy <= pattern_.radius; ++dy) inputs.rows16.push_back(view.luma[row_of(y + dy)]);
  args->rows = inputs.rows16.data();
  args->pattern = pattern_;
}

void PairRows::use_view(int32_t y, const View& view, Inputs& inputs, MaskThresholdArgs* args) const {
  inputs.rows8.clear();
  for (int32_t dy = -pattern_.radius; dy <= pattern_.radius; ++dy) inputs.rows8.push_back(view.lab[row_of(y + dy)]);
  args->rows = inputs.rows8.data();
  args->plane_stride = plane_stride_;
  args->planes = planes_;
  args->pattern = pattern_;
}

void PairRows::describe(const Kernels& kernels, View* view) {
  const size_t bytes = static_cast<size_t>(width() + kBlock) * static_cast<size_t>(config_.bits / 8);
  view->descriptor.resize(view->lab.size());
  view->mask.resize(view->lab.size());
  for (const int32_t y : sampled_) {
    Inputs inputs(width(), config_.bits, config_.num_disparities, kBlock);
    DescriptorCompareArgs compare;
    prepare(inputs, kernels.scratch[BSM_KERNEL_DESCRIPTOR], &compare);
    use_view(y, *view, inputs, &compare);
    uint8_t* const descriptor = memory_->take<uint8_t>(bytes);
    compare.out = descriptor;
    kernels.descriptor_compare(compare);
    view->descriptor[row_of(y)] = descriptor;
    MaskThresholdArgs threshold;
    prepare(inputs, kernels.scratch[BSM_KERNEL_MASK], &threshold);
    use_view(y, *view, inputs, &threshold);
    uint8_t* const mask = memory_->take<uint8_t>(bytes);
    threshold.out = mask;
    kernels.mask_threshold(threshold);
    view->mask[row_of(y)] = mask;
  }
}

// The left map of a configuration, as levels.
bool PairRows::match(const host::Image8& left, const host::Image8& right, const bsm_config& config,
                     std::vector<const uint16_t*>* levels, std::string* error) {
  double milliseconds = 0.0;
  if (!frame_.open(config, error) || !frame_.match(left, right, &milliseconds, error)) return false;
  const int16_t* disparity = frame_.disparity().data();
  const int32_t least = config.min_disparity * BSM_DISPARITY_SCALE;
  for (int32_t y = 0; y < height(); ++y) {
    uint16_t* const row = memory_->take<uint16_t>(static_cast<size_t>(width() + kAfter));
    for (int32_t x = 0; x < width(); ++x, ++disparity) {
      row[x] = *disparity < least ? kNoLevel : static_cast<uint16_t>(*disparity - least);
    }
    levels->push_back(row);
  }
  return true;
}

bool PairRows::open(const host::Image8& left, const host::Image8& right, const bsm_config& config, bool maps,
                    std::string* error) {
  config_ = config;
  planes_ = left.channels;
  plane_stride_ = width() + kBefore + kAfter;
  for (int32_t i = 0; i < kSampledRows; ++i) sampled_.push_back(height() * (2 * i + 1) / (2 * kSampledRows));
  memory_ = std::make_unique<Inputs>(width(), config_.bits, config_.num_disparities, kBlock);
  bsm_config dense = config_;
  dense.smooth_passes = 0;
  if (maps && !match(left, right, at_stage(config_, BSM_STAGE_CHECKED), &checked_, error)) return false;
  if (maps && !match(left, right, at_stage(dense, BSM_STAGE_REFINED), &dense_, error)) return false;
  if (!maps && !frame_.open(config_, error)) return false;
  pattern_ = frame_.context()->pattern;
  const Kernels& kernels = frame_.context()->kernels;
  convert(left, kernels, &left_);
  convert(right, kernels, &right_);
  describe(kernels, &left_);
  describe(kernels, &right_);
  return true;
}

void PairRows::use_row(int32_t y, Inputs& inputs, DescriptorCompareArgs* args) const {
  use_view(y, left_, inputs, args);
}

void PairRows::use_row(int32_t y, Inputs& inputs, MaskThresholdArgs* args) const {
  use_view(y, left_, inputs, args);
}

void PairRows::use_row(int32_t y, Inputs&, MatchHammingArgs* args) const {
  args->left = left_.descriptor[row_of(y)];
  args->right = right_.descriptor[row_of(y)];
  args->left_mask = left_.mask[row_of(y)];
  args->right_mask = right_.mask[row_of(y)];
  args->min_disparity = config_.min_disparity;
}

void PairRows::use_row(int32_t y, Inputs& inputs, TwoOrdersArgs* args) const {
  use_row(y, inputs, &args->given);
  use_row(y, inputs, &args->coherent);
  const std::vector<int32_t> order = coherent_order(pattern_);
  for (const uint8_t** bits :
       {&args->coherent.left, &args->coherent.right, &args->coherent.left_mask, &args->coherent.right_mask}) {
    *bits = reorder(*bits, width(), order, inputs);
  }
}

void PairRows::use_row(int32_t y, Inputs& inputs, AggregateAlongArgs* args) const {
  CostHammingArgs count;
  prepare(inputs, cost_hamming_scalar_scratch, &count);
  count.own = left_.descriptor[row_of(y)];
  count.own_mask = left_.mask[row_of(y)];
  count.other = right_.descriptor[row_of(y)];
  count.min_disparity = config_.min_disparity;
  cost_hamming_scalar(count);
  args->cost = count.cost;
}

// Rows y - radius .. y + radius of a map, nullptr for those outside the image.
std::vector<const uint16_t*> PairRows::rows_inside(const std::vector<const uint16_t*>& map, int32_t y,
                                                   int32_t radius) const {
  std::vector<const uint16_t*> rows;
  for (int32_t i = y - radius; i <= y + radius; ++i) rows.push_back(0 <= i && i < height() ? map[row_of(i)] : nullptr);
  return rows;
}

void PairRows::use_row(int32_t y, Inputs& inputs, VoteWeighArgs* args) const {
  args->radius = config_.vote_radius;
  args->step = config_.vote_step;
  inputs.rows16 = rows_inside(checked_, y, args->radius);
  inputs.rows8.clear();
  for (int32_t dy = -args->radius; dy <= args->radius; ++dy) inputs.rows8.push_back(left_.lab[row_of(y + dy)]);
  args->levels = inputs.rows16.data();
  args->lab = inputs.rows8.data();
  args->plane_stride = plane_stride_;
  args->planes = planes_;
  args->color_scale = vote_color_scale(config_.vote_color);
  const bsm_context& context = *frame_.context();
  args->distance_steps = reinterpret_cast<const uint16_t*>(context.arena + context.plan.vote_steps);
}

void PairRows::use_row(int32_t y, Inputs& inputs, MedianWeightedArgs* args) const {
  inputs.rows16 = rows_inside(dense_, y, args->radius);
  inputs.rows8.clear();
  for (int32_t dy = -args->radius; dy <= args->radius; ++dy) inputs.rows8.push_back(left_.lab[row_of(y + dy)]);
  args->levels = inputs.rows16.data();
  args->lab = inputs.rows8.data();
  args->plane_stride = plane_stride_;
  args->planes = planes_;
  args->checked = checked_[row_of(y)];
}

void PairRows::use_row(int32_t y, Inputs& inputs, RemoveSpecklesArgs* args) const {
  inputs.rows16 = rows_inside(checked_, y, kSpeckleRadius);
  constexpr int32_t kPercent = 15;  // of the preset balanced
  *args = RemoveSpecklesArgs{inputs.rows16.data(), width(), config_.speckle != 0 ? config_.speckle : kPercent,
                             inputs.take<uint16_t>(static_cast<size_t>(width()))};
}

// As if no pixel had got a vote: few holes are left after it, and images with nothing to match have more.
void PairRows::use_row(int32_t y, Inputs& inputs, FillHolesArgs* args) const {
  *args = FillHolesArgs{checked_[row_of(y)], y > 0 ? dense_[row_of(y - 1)] : nullptr, checked_[row_of(y)], width(),
                        inputs.take<uint16_t>(static_cast<size_t>(width()))};
}

void PairRows::use_row(int32_t y, Inputs& inputs, MedianArgs* args) const {
  *args = MedianArgs{{dense_[row_of(y - 1)], dense_[row_of(y)], dense_[row_of(y + 1)]},
                     width(),
                     inputs.take<uint16_t>(static_cast<size_t>(width()))};
}

}  // namespace bsm::bench
