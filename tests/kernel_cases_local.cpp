// kernel_cases_local.cpp - trials of the stages that the local method runs.
#include "core/pattern.h"
#include "core/weights.h"
#include "kernel_cases.h"
#include "pixel_formats.h"
#include "simd/pattern_order.h"

namespace bsm::test {
namespace {

// Rows of a window: pointers at x = 0, with values on both sides.
template <typename T>
List<const T*> take_rows(const Trial& trial, int count, int before, int row_values, Values kind) {
  List<const T*> rows(trial, count);
  for (int i = 0; i < count; ++i) {
    if (i > 0 && trial.rng.one_in(4)) {  // as at the top and bottom of an image
      rows.push_back(rows.back());
      continue;
    }
    T* const row = trial.yard.take_array<T>(static_cast<size_t>(row_values));
    fill(trial.rng, row, static_cast<size_t>(row_values), kind);
    rows.push_back(row + before);
  }
  return rows;
}

// Rows of CIELAB planes. Similar colours in some trials: SADs that need all of their bits are rare among noise.
struct LabRows {
  const uint8_t* const* rows;
  ptrdiff_t stride;
  int planes;
};

LabRows take_lab(const Trial& trial, int count, int before, int values) {
  LabRows lab;
  lab.planes = trial.rng.one_in(3) ? 1 : 3;
  lab.stride = values + (trial.rng.one_in(2) ? 0 : trial.rng.range(1, 70));
  const int bytes = static_cast<int>(lab.stride) * (lab.planes - 1) + values;
  lab.rows = take_rows<uint8_t>(trial, count, before, bytes, any_values(trial.rng)).data();
  return lab;
}

Pattern any_pattern(const Trial& trial) {
  Pattern pattern = local_pattern(trial.bits, trial.yard.take_array<PixelPair>(static_cast<size_t>(trial.bits)));
  if constexpr (kOrdersPatterns) {
    pattern.order = make_pattern_order(pattern, trial.yard.take(static_cast<size_t>(pattern_order_bytes(trial.bits)), 8));
  }
  return pattern;
}

KernelShape shape_of(const Trial& trial, int radius, int planes, int num_disparities) {
  return KernelShape{trial.width, trial.bits, radius, planes, num_disparities};
}

uint8_t* take_bits(const Trial& trial, int block, Values kind) {
  const size_t bytes = static_cast<size_t>(round_up(trial.width, block)) * static_cast<size_t>(trial.bits / 8);
  uint8_t* const bits = trial.yard.take(bytes, 64);
  fill(trial.rng, bits, bytes, kind);
  return bits;
}

int any_disparities(const Trial& trial) {
  return trial.rng.one_in(8) ? trial.rng.range(200, 300) : trial.rng.range(1, 70);
}

int any_least(const Trial& trial) {
  return trial.rng.one_in(2) ? 0 : trial.rng.range(-trial.width - 70, trial.width + 70);
}

}  // namespace

void try_kernel(const Trial& trial, const Kernel<ColorLabArgs>& kernel, const Kernel<ColorLabArgs>& scalar) {
  ColorLabArgs args{};
  const bsm_format format = any_format(trial.rng);
  args.format = format;
  args.width = trial.width;
  args.planes = args.format == BSM_FORMAT_GRAY8 ? 1 : 3;
  args.plane_stride = trial.width + trial.rng.range(0, 20);
  const auto take_pixels = [&trial](int bytes) {
    uint8_t* const pixels = trial.yard.take(static_cast<size_t>(bytes), 1);
    fill(trial.rng, pixels, static_cast<size_t>(bytes), any_values(trial.rng));
    return pixels;
  };
  args.source = take_pixels(row_bytes(format, trial.width));
  if (has_chroma_plane(format)) args.chroma = take_pixels(chroma_row_bytes(trial.width));
  Output<uint16_t> luma = take_output<uint16_t>(trial, static_cast<size_t>(trial.width));
  Output<uint8_t> lab =
      take_output<uint8_t>(trial, static_cast<size_t>(args.plane_stride * (args.planes - 1) + trial.width));
  const bool with_luma = !trial.rng.one_in(5);
  const bool with_lab = !trial.rng.one_in(5);
  args.luma = with_luma ? luma.kernel : nullptr;
  args.lab = with_lab ? lab.kernel : nullptr;
  kernel.run(args);
  args.luma = with_luma ? luma.scalar : nullptr;
  args.lab = with_lab ? lab.scalar : nullptr;
  scalar.run(args);
  const Note notes[] = {{"format", args.format}};
  check_output(trial, luma, "luma", notes);
  check_output(trial, lab, "lab", notes);
}

void try_kernel(const Trial& trial, const Kernel<DescriptorCompareArgs>& kernel,
                const Kernel<DescriptorCompareArgs>& scalar) {
  const Pattern pattern = any_pattern(trial);
  const int radius = pattern.radius;
  const KernelShape shape = shape_of(trial, radius, 3, 1);
  const List<const uint16_t*> rows = take_rows<uint16_t>(
      trial, 2 * radius + 1, radius, round_up(trial.width, kernel.block) + 2 * radius, any_values(trial.rng));
  Output<uint8_t> out = take_output<uint8_t>(trial, static_cast<size_t>(trial.width * trial.bits / 8), 64);
  kernel.run(
      DescriptorCompareArgs{rows.data(), trial.width, pattern, out.kernel, take_scratch(trial, kernel.scratch, shape)});
  scalar.run(
      DescriptorCompareArgs{rows.data(), trial.width, pattern, out.scalar, take_scratch(trial, scalar.scratch, shape)});
  check_output(trial, out, "descriptors");
}

void try_kernel(const Trial& trial, const Kernel<MaskThresholdArgs>& kernel, const Kernel<MaskThresholdArgs>& scalar) {
  const Pattern pattern = any_pattern(trial);
  const int radius = pattern.radius;
  const LabRows lab = take_lab(trial, 2 * radius + 1, radius, round_up(trial.width, kernel.block) + 2 * radius);
  const KernelShape shape = shape_of(trial, radius, lab.planes, 1);
  Output<uint8_t> out = take_output<uint8_t>(trial, static_cast<size_t>(trial.width * trial.bits / 8), 64);
  MaskThresholdArgs args{
      lab.rows, lab.stride, lab.planes, trial.width, pattern, out.kernel, take_scratch(trial, kernel.scratch, shape)};
  kernel.run(args);
  args.out = out.scalar;
  args.scratch = take_scratch(trial, scalar.scratch, shape);
  scalar.run(args);
  check_output(trial, out, "masks");
}

void try_kernel(const Trial& trial, const Kernel<MatchHammingArgs>& kernel, const Kernel<MatchHammingArgs>& scalar) {
  MatchHammingArgs args{};
  const Values kind = any_values(trial.rng);
  args.left = take_bits(trial, kernel.block, kind);
  args.right = take_bits(trial, kernel.block, kind);
  if (!trial.rng.one_in(3)) {
    const Values mask_kind = any_values(trial.rng);
    args.left_mask = take_bits(trial, kernel.block, mask_kind);
    args.right_mask = take_bits(trial, kernel.block, mask_kind);
  }
  args.width = trial.width;
  args.bits = trial.bits;
  args.num_disparities = any_disparities(trial);
  args.min_disparity = any_least(trial);
  const KernelShape shape = shape_of(trial, kMaxPatternRadius, 3, args.num_disparities);
  Output<uint16_t> left = take_output<uint16_t>(trial, static_cast<size_t>(trial.width));
  Output<uint16_t> right = take_output<uint16_t>(trial, static_cast<size_t>(trial.width));
  args.left_level = left.kernel;
  args.right_level = right.kernel;
  args.scratch = take_scratch(trial, kernel.scratch, shape);
  kernel.run(args);
  args.left_level = left.scalar;
  args.right_level = right.scalar;
  args.scratch = take_scratch(trial, scalar.scratch, shape);
  scalar.run(args);
  const Note notes[] = {{"disparities", args.num_disparities}, {"from", args.min_disparity}};
  check_output(trial, left, "left levels", notes);
  check_output(trial, right, "right levels", notes);
}

void try_kernel(const Trial& trial, const Kernel<VoteWeighArgs>& kernel, const Kernel<VoteWeighArgs>& scalar) {
  Rng& rng = trial.rng;
  VoteWeighArgs args{};
  args.step = rng.one_in(2) ? 1 : rng.range(2, 9);
  args.radius = args.step * rng.range(1, lesser(BSM_MAX_VOTE_RADIUS / args.step, rng.one_in(4) ? 32 : 6));
  const int side = 2 * args.radius + 1;
  const LabRows lab = take_lab(trial, side, 0, round_up(trial.width, kernel.block));
  args.planes = lab.planes;
  args.plane_stride = lab.stride;
  args.width = trial.width;
  args.num_disparities = any_disparities(trial);
  // Some fractions round up to the next level, but never past the last one.
  List<const uint16_t*> levels(trial, side);
  const int valid_in = rng.range(1, 9);
  for (int i = 0; i < side; ++i) {
    uint16_t* const row = trial.yard.take_array<uint16_t>(static_cast<size_t>(round_up(trial.width, kernel.block)));
    for (int x = 0; x < trial.width; ++x) {
      const int most = args.num_disparities * 16 - 9;
      const bool valid = rng.range(1, 9) > valid_in || (i != args.radius && rng.one_in(2));
      row[x] = valid ? static_cast<uint16_t>(rng.range(0, most)) : rng.one_in(2) ? kNoLevel : kOccluded;
    }
    levels.push_back(i != args.radius && rng.one_in(10) ? nullptr : row);
  }
  args.levels = levels.data();
  args.lab = lab.rows;
  List<uint16_t> cap(trial, trial.width);
  for (int x = 0; x < trial.width; ++x) cap.push_back(static_cast<uint16_t>(rng.range(0, args.num_disparities)));
  args.cap = rng.one_in(2) ? cap.data() : nullptr;
  args.color_scale = vote_color_scale(rng.range(1, 64));
  const int distance = rng.range(1, 64);
  List<uint16_t> steps(trial, (args.radius + 1) * (args.radius + 1));
  for (int dy = 0; dy <= args.radius; ++dy) {
    for (int dx = 0; dx <= args.radius; ++dx) steps.push_back(vote_distance_steps(dx, dy, distance));
  }
  args.distance_steps = steps.data();
  args.weights = kVoteWeights.weight;
  args.weights_count = VoteWeights::kCount;
  const KernelShape shape = shape_of(trial, kMaxPatternRadius, args.planes, args.num_disparities);
  Output<uint16_t> out = take_output<uint16_t>(trial, static_cast<size_t>(trial.width));
  args.out = out.kernel;
  args.scratch = take_scratch(trial, kernel.scratch, shape);
  kernel.run(args);
  args.out = out.scalar;
  args.scratch = take_scratch(trial, scalar.scratch, shape);
  scalar.run(args);
  const Note notes[] = {{"radius", args.radius}, {"step", args.step}};
  check_output(trial, out, "levels", notes);
}

void try_kernel(const Trial& trial, const Kernel<MedianWeightedArgs>& kernel, const Kernel<MedianWeightedArgs>& scalar) {
  Rng& rng = trial.rng;
  MedianWeightedArgs args{};
  args.radius = rng.range(1, kMaxMedianRadius);
  const int side = 2 * args.radius + 1;
  const LabRows lab = take_lab(trial, side, 0, trial.width);
  args.planes = lab.planes;
  args.plane_stride = lab.stride;
  args.width = trial.width;
  List<const uint16_t*> levels(trial, side);
  const int base = rng.range(0, 60000);
  const int spread = rng.one_in(3) ? rng.range(0, 3) : rng.range(3, 4000);
  for (int i = 0; i < side; ++i) {
    uint16_t* const row = trial.yard.take_array<uint16_t>(static_cast<size_t>(trial.width));
    for (int x = 0; x < trial.width; ++x) row[x] = static_cast<uint16_t>(base + rng.range(0, spread));
    levels.push_back(i != args.radius && rng.one_in(10) ? nullptr : row);
  }
  args.levels = levels.data();
  args.lab = lab.rows;
  args.color_scale = smooth_color_scale(rng.one_in(2) ? rng.range(1, 64) : rng.range(1, 8));
  const int distance = rng.range(1, 64);
  List<uint8_t> steps(trial, (args.radius + 1) * (args.radius + 1));
  for (int dy = 0; dy <= args.radius; ++dy) {
    for (int dx = 0; dx <= args.radius; ++dx) steps.push_back(smooth_distance_steps(dx, dy, distance));
  }
  args.distance_steps = steps.data();
  args.weights = kSmoothWeights.weight;
  List<uint16_t> checked(trial, trial.width);
  for (int x = 0; x < trial.width; ++x) {
    checked.push_back(rng.one_in(3) ? (rng.one_in(2) ? kNoLevel : kOccluded) : static_cast<uint16_t>(base));
  }
  args.checked = checked.data();
  args.own_bonus = static_cast<uint32_t>(rng.range(0, 512));
  const KernelShape shape = shape_of(trial, kMaxPatternRadius, args.planes, 4000);
  Output<uint16_t> out = take_output<uint16_t>(trial, static_cast<size_t>(trial.width));
  args.out = out.kernel;
  args.scratch = take_scratch(trial, kernel.scratch, shape);
  kernel.run(args);
  args.out = out.scalar;
  args.scratch = take_scratch(trial, scalar.scratch, shape);
  scalar.run(args);
  const Note notes[] = {{"radius", args.radius}};
  check_output(trial, out, "levels", notes);
}

void try_kernel(const Trial& trial, const Kernel<FractionSmoothArgs>& kernel, const Kernel<FractionSmoothArgs>& scalar) {
  Rng& rng = trial.rng;
  FractionSmoothArgs args{};
  args.width = trial.width;
  List<const uint16_t*> levels(trial, 5);
  List<const uint8_t*> weights(trial, 5);
  const int base = rng.range(0, 60000);
  const int spread = rng.range(0, 100);
  for (int i = 0; i < 5; ++i) {
    uint16_t* const row = trial.yard.take_array<uint16_t>(static_cast<size_t>(trial.width));
    uint8_t* const weight = trial.yard.take_array<uint8_t>(static_cast<size_t>(trial.width));
    for (int x = 0; x < trial.width; ++x) {
      row[x] = static_cast<uint16_t>(base + rng.range(0, spread));
      weight[x] =
          static_cast<uint8_t>(rng.one_in(3) ? (rng.one_in(2) ? 1 : kMaxFractionWeight) : rng.range(1, kMaxFractionWeight));
    }
    const bool outside = i != 2 && rng.one_in(5);
    levels.push_back(outside ? nullptr : row);
    weights.push_back(outside ? nullptr : weight);
  }
  args.levels = levels.data();
  args.weights = weights.data();
  const KernelShape shape = shape_of(trial, kMaxPatternRadius, 3, 4000);
  Output<uint16_t> out = take_output<uint16_t>(trial, static_cast<size_t>(trial.width));
  args.out = out.kernel;
  args.scratch = take_scratch(trial, kernel.scratch, shape);
  kernel.run(args);
  args.out = out.scalar;
  args.scratch = take_scratch(trial, scalar.scratch, shape);
  scalar.run(args);
  check_output(trial, out, "levels");
}

}  // namespace bsm::test
