// kernel_cases_sgm.cpp - trials of the stages of semi-global aggregation.
#include "kernel_cases.h"
#include "platform/compiler.h"

namespace bsm::test {
namespace {

// Levels of a pixel: stride is a multiple of the kernel's block, sometimes a larger one than needed.
struct Volume {
  int num_disparities, stride;
};

template <class Args>
Volume any_volume(const Trial& trial, const Kernel<Args>& kernel) {
  Volume volume{trial.rng.one_in(6) ? trial.rng.range(100, 300) : trial.rng.range(1, 70), 0};
  volume.stride = round_up(volume.num_disparities, kernel.block) + (trial.rng.one_in(3) ? kernel.block : 0);
  return volume;
}

size_t values_of(const Trial& trial, const Volume& volume) {
  return static_cast<size_t>(trial.width) * static_cast<size_t>(volume.stride);
}

// Costs with pixels and levels that are no candidates, up to `most`.
void fill_costs(const Trial& trial, const Volume& volume, int most, uint16_t* costs) {
  Rng& rng = trial.rng;
  const int spread = rng.one_in(4) ? rng.range(0, 2) : most;
  const int least = rng.range(0, most - lesser(most, spread));
  const int missing_in = rng.range(2, 12);
  for (int x = 0; x < trial.width; ++x) {
    const int begin = rng.one_in(missing_in) ? rng.range(0, volume.num_disparities) : 0;
    const int end = rng.one_in(missing_in) ? rng.range(0, volume.num_disparities) : volume.num_disparities;
    for (int d = 0; d < volume.stride; ++d) {
      const int cost = least + rng.range(0, lesser(spread, most - least));
      *costs++ = begin <= d && d < end ? static_cast<uint16_t>(cost) : kNoCost;
    }
  }
}

uint16_t* take_costs(const Trial& trial, const Volume& volume, int most) {
  uint16_t* const costs = trial.yard.take_array<uint16_t>(values_of(trial, volume), 64);
  fill_costs(trial, volume, most, costs);
  return costs;
}

const uint8_t* take_edges(const Trial& trial) {
  uint8_t* const edges = trial.yard.take(static_cast<size_t>(trial.width), 1);
  for (int x = 0; x < trial.width; ++x) edges[x] = trial.rng.one_in(3) ? 1 : 0;
  return edges;
}

void any_penalties(Rng& rng, int most, Penalties (&penalties)[2]) {
  for (Penalties& penalty : penalties) {
    penalty.p2 = static_cast<uint16_t>(rng.one_in(8) ? rng.range(0, 65535) : rng.range(0, most));
    penalty.p1 = static_cast<uint16_t>(rng.range(0, penalty.p2));
  }
}

KernelShape shape_of(const Trial& trial, const Volume& volume) {
  return KernelShape{trial.width, trial.bits, kMaxPatternRadius, 3, volume.num_disparities};
}

}  // namespace

void try_kernel(const Trial& trial, const Kernel<CostHammingArgs>& kernel, const Kernel<CostHammingArgs>& scalar) {
  Rng& rng = trial.rng;
  const Volume volume = any_volume(trial, kernel);
  const auto take_bits = [&](Values kind) {
    const size_t bytes = static_cast<size_t>(trial.width) * static_cast<size_t>(trial.bits / 8);
    uint8_t* const bits = trial.yard.take(bytes, 64);
    fill(rng, bits, bytes, kind);
    return bits;
  };
  CostHammingArgs args{};
  args.own = take_bits(any_values(rng));
  args.other = take_bits(any_values(rng));
  args.own_mask = rng.one_in(3) ? nullptr : take_bits(any_values(rng));
  args.view = rng.range(0, 1);
  args.width = trial.width;
  args.bits = trial.bits;
  args.min_disparity = rng.one_in(2) ? 0 : rng.range(-trial.width - 70, trial.width + 70);
  args.num_disparities = volume.num_disparities;
  args.stride = volume.stride;
  Output<uint16_t> cost = take_output<uint16_t>(trial, values_of(trial, volume), 64);
  args.cost = cost.kernel;
  args.scratch = take_scratch(trial, kernel.scratch, shape_of(trial, volume));
  kernel.run(args);
  args.cost = cost.scalar;
  args.scratch = take_scratch(trial, scalar.scratch, shape_of(trial, volume));
  scalar.run(args);
  const Note notes[] = {{"view", args.view}, {"disparities", args.num_disparities}, {"from", args.min_disparity}};
  check_output(trial, cost, "costs", notes);
}

void try_kernel(const Trial& trial, const Kernel<EdgeThresholdArgs>& kernel, const Kernel<EdgeThresholdArgs>& scalar) {
  Rng& rng = trial.rng;
  EdgeThresholdArgs args{};
  args.planes = rng.one_in(3) ? 1 : 3;
  args.plane_stride = trial.width + rng.range(0, 70);
  const size_t bytes = static_cast<size_t>(args.plane_stride * (args.planes - 1) + trial.width);
  uint8_t* const lab = trial.yard.take(bytes, 1);
  uint8_t* const previous = trial.yard.take(bytes, 1);
  const Values kind = any_values(rng);
  fill(rng, lab, bytes, kind);
  fill(rng, previous, bytes, kind);
  args.lab = lab;
  args.previous = previous;
  args.width = trial.width;
  args.threshold = rng.range(0, rng.one_in(2) ? kMaxSad : 30);
  const KernelShape shape{trial.width, trial.bits, kMaxPatternRadius, args.planes, 1};
  Output<uint8_t> edge = take_output<uint8_t>(trial, static_cast<size_t>(trial.width));
  args.edge = edge.kernel;
  args.scratch = take_scratch(trial, kernel.scratch, shape);
  kernel.run(args);
  args.edge = edge.scalar;
  args.scratch = take_scratch(trial, scalar.scratch, shape);
  scalar.run(args);
  check_output(trial, edge, "edges");
}

void try_kernel(const Trial& trial, const Kernel<AggregateAlongArgs>& kernel, const Kernel<AggregateAlongArgs>& scalar) {
  const Volume volume = any_volume(trial, kernel);
  // Costs and penalties of short descriptors fit kernels that work in bytes.
  AggregateAlongArgs args{};
  args.most_cost = trial.rng.one_in(2) ? BSM_MAX_BITS : trial.rng.range(1, 254);
  args.cost = take_costs(trial, volume, args.most_cost);
  args.edge = take_edges(trial);
  any_penalties(trial.rng, args.most_cost < 255 ? (255 - args.most_cost + 1) / 2 : 3000, args.penalties);
  args.width = trial.width;
  args.num_disparities = volume.num_disparities;
  args.stride = volume.stride;
  Output<uint16_t> sum = take_output<uint16_t>(trial, values_of(trial, volume), 64);
  args.sum = sum.kernel;
  args.scratch = take_scratch(trial, kernel.scratch, shape_of(trial, volume));
  kernel.run(args);
  args.sum = sum.scalar;
  args.scratch = take_scratch(trial, scalar.scratch, shape_of(trial, volume));
  scalar.run(args);
  const Note notes[] = {{"disparities", volume.num_disparities}, {"stride", volume.stride}};
  check_output(trial, sum, "sums", notes);
}

void try_kernel(const Trial& trial, const Kernel<AggregateAcrossArgs>& kernel, const Kernel<AggregateAcrossArgs>& scalar) {
  Rng& rng = trial.rng;
  const Volume volume = any_volume(trial, kernel);
  AggregateAcrossArgs args{};
  args.cost = take_costs(trial, volume, BSM_MAX_BITS);
  args.edge = take_edges(trial);
  any_penalties(rng, 3000, args.penalties);
  args.dx = rng.range(-1, 1);
  args.begin = rng.one_in(2) ? 0 : rng.range(0, trial.width);
  args.end = rng.one_in(2) ? trial.width : rng.range(args.begin, trial.width);
  args.width = trial.width;
  args.num_disparities = volume.num_disparities;
  args.stride = volume.stride;
  Output<uint16_t> current = take_output<uint16_t>(trial, values_of(trial, volume), 64);
  Output<uint16_t> sum = take_output<uint16_t>(trial, values_of(trial, volume), 64);
  fill_costs(trial, volume, 60000, sum.kernel);
  BSM_MEMCPY(sum.scalar, sum.kernel, sum.count * sizeof(uint16_t));
  const bool begins = rng.one_in(8);
  const bool in_place = args.dx == 0 && rng.one_in(2);
  const uint16_t* previous = begins ? nullptr : take_costs(trial, volume, rng.one_in(2) ? 60000 : 5000);
  if (in_place && !begins) {
    BSM_MEMCPY(current.kernel, previous, sum.count * sizeof(uint16_t));
    BSM_MEMCPY(current.scalar, previous, sum.count * sizeof(uint16_t));
  }
  args.current = current.kernel;
  args.previous = in_place && !begins ? current.kernel : previous;
  args.sum = sum.kernel;
  args.scratch = take_scratch(trial, kernel.scratch, shape_of(trial, volume));
  kernel.run(args);
  args.current = current.scalar;
  args.previous = in_place && !begins ? current.scalar : previous;
  args.sum = sum.scalar;
  args.scratch = take_scratch(trial, scalar.scratch, shape_of(trial, volume));
  scalar.run(args);
  const Note notes[] = {{"disparities", volume.num_disparities}, {"stride", volume.stride}, {"dx", args.dx}};
  check_output(trial, current, "paths", notes);
  check_output(trial, sum, "sums", notes);
}

void try_kernel(const Trial& trial, const Kernel<WinnerSumsArgs>& kernel, const Kernel<WinnerSumsArgs>& scalar) {
  const Volume volume = any_volume(trial, kernel);
  WinnerSumsArgs args{};
  args.sum = take_costs(trial, volume, trial.rng.one_in(2) ? 60000 : 50);
  args.width = trial.width;
  args.num_disparities = volume.num_disparities;
  args.stride = volume.stride;
  args.subpixel = trial.rng.range(0, 1);
  Output<uint16_t> level = take_output<uint16_t>(trial, static_cast<size_t>(trial.width));
  args.level = level.kernel;
  args.scratch = take_scratch(trial, kernel.scratch, shape_of(trial, volume));
  kernel.run(args);
  args.level = level.scalar;
  args.scratch = take_scratch(trial, scalar.scratch, shape_of(trial, volume));
  scalar.run(args);
  const Note notes[] = {{"disparities", volume.num_disparities}, {"subpixel", args.subpixel}};
  check_output(trial, level, "levels", notes);
}

}  // namespace bsm::test
