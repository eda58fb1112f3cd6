// Scanline paths in registers: the steps that the aggregation kernels of all x86 instruction sets share.
// Include after the levels of one instruction set.
// Levels past the last one are kNoCost in the registers, and are neither read from nor written to sums and paths.
#ifndef BSM_SIMD_X86_AGGREGATE_LANES_H
#define BSM_SIMD_X86_AGGREGATE_LANES_H

#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kMaxRegisters = kLevelLanes == 32 ? 4 : 8;  // that a path takes; with more levels it lives in memory

// The levels of one pixel.
struct Levels {
  int32_t registers;
  LastLanes last;

  explicit Levels(int32_t num_disparities)
      : registers((num_disparities + kLevelLanes - 1) / kLevelLanes),
        last(num_disparities - (registers - 1) * kLevelLanes) {}

  // Register `i` of sums and paths.
  Bytes load_from(const uint16_t* from, int32_t i) const {
    return i + 1 < registers ? load(from + i * kLevelLanes) : last.load_from(from + i * kLevelLanes);
  }
  void store_to(uint16_t* to, int32_t i, Bytes value) const {
    if (i + 1 < registers) {
      store(to + i * kLevelLanes, value);
    } else {
      last.store_to(to + i * kLevelLanes, value);
    }
  }
};

// Both penalties in all lanes, without and with an edge.
struct PenaltyLanes {
  Bytes p1[2], p2[2];

  explicit PenaltyLanes(const Penalties (&penalties)[2])
      : p1{set16(penalties[0].p1), set16(penalties[1].p1)}, p2{set16(penalties[0].p2), set16(penalties[1].p2)} {}
};

// A predecessor's least cost and what the step to the next pixel takes.
struct Step {
  Bytes least, jump, p1;  // jump: the least cost and p2
};

inline Step make_step(Bytes least, const PenaltyLanes& penalties, int32_t edge) {
  return Step{least, add16_saturated(least, penalties.p2[edge]), penalties.p1[edge]};
}

// L of a register of levels. C is added last: the minimum never falls below the least cost.
inline Bytes advance(Bytes before, Bytes same, Bytes after, Bytes cost, const Step& step) {
  const Bytes nearest = min16(from_below(before, same), from_above(same, after));
  const Bytes stay = min16(same, step.jump);
  const Bytes path = min16(add16_saturated(nearest, step.p1), stay);
  return add16_saturated(sub16(path, step.least), cost);
}

// A path whose levels take kRegisters registers.
template <int32_t kRegisters>
struct Path {
  Bytes level[kRegisters];

  void begin(const uint16_t* cost) {
    BSM_UNROLL
    for (int32_t i = 0; i < kRegisters; ++i) level[i] = load(cost + i * kLevelLanes);
  }
  void load_from(const uint16_t* path, const LastLanes& last) {
    BSM_UNROLL
    for (int32_t i = 0; i + 1 < kRegisters; ++i) level[i] = load(path + i * kLevelLanes);
    level[kRegisters - 1] = last.load_from(path + (kRegisters - 1) * kLevelLanes);
  }
  Bytes least() const {
    Bytes a = level[0];
    BSM_UNROLL
    for (int32_t i = 1; i < kRegisters; ++i) a = min16(a, level[i]);
    return least_everywhere(a);
  }
  void advance_to(const uint16_t* cost, const PenaltyLanes& penalties, int32_t edge) {
    const Step step = make_step(least(), penalties, edge);
    Bytes before = ones();
    BSM_UNROLL
    for (int32_t i = 0; i < kRegisters; ++i) {
      const Bytes same = level[i];
      const Bytes after = i + 1 < kRegisters ? level[(i + 1) % kRegisters] : ones();
      level[i] = advance(before, same, after, load(cost + i * kLevelLanes), step);
      before = same;
    }
  }
  void store_to(uint16_t* to, const LastLanes& last) const {
    BSM_UNROLL
    for (int32_t i = 0; i + 1 < kRegisters; ++i) store(to + i * kLevelLanes, level[i]);
    last.store_to(to + (kRegisters - 1) * kLevelLanes, level[kRegisters - 1]);
  }
  void add_to(uint16_t* sum, const LastLanes& last) const {
    BSM_UNROLL
    for (int32_t i = 0; i + 1 < kRegisters; ++i) {
      uint16_t* at = sum + i * kLevelLanes;
      store(at, add16_saturated(load(at), level[i]));
    }
    uint16_t* at = sum + (kRegisters - 1) * kLevelLanes;
    last.store_to(at, add16_saturated(last.load_from(at), level[kRegisters - 1]));
  }
};

// The same for any number of levels, with the path in memory.

inline Bytes least_in_memory(const uint16_t* path, const Levels& levels) {
  Bytes a = ones();
  for (int32_t i = 0; i < levels.registers; ++i) a = min16(a, levels.load_from(path, i));
  return least_everywhere(a);
}

// current may be previous.
inline void advance_in_memory(const uint16_t* previous, const uint16_t* cost, const PenaltyLanes& penalties, int32_t edge,
                              const Levels& levels, uint16_t* current) {
  const Step step = make_step(least_in_memory(previous, levels), penalties, edge);
  Bytes before = ones();
  Bytes same = levels.load_from(previous, 0);
  for (int32_t i = 0; i < levels.registers; ++i) {
    const Bytes after = i + 1 < levels.registers ? levels.load_from(previous, i + 1) : ones();
    levels.store_to(current, i, advance(before, same, after, load(cost + i * kLevelLanes), step));
    before = same;
    same = after;
  }
}

inline void copy_in_memory(const uint16_t* from, const Levels& levels, uint16_t* to) {
  for (int32_t i = 0; i < levels.registers; ++i) levels.store_to(to, i, levels.load_from(from, i));
}

inline void add_in_memory(const uint16_t* path, const Levels& levels, uint16_t* sum) {
  for (int32_t i = 0; i < levels.registers; ++i) {
    levels.store_to(sum, i, add16_saturated(levels.load_from(sum, i), levels.load_from(path, i)));
  }
}

// Runs Row::run<n> for the n registers of a pixel, Row::run_in_memory when they are too many.
template <class Row, int32_t kRegisters = 1, class Args>
inline void run_row(const Args& args, const Levels& levels) {
  if constexpr (kRegisters > kMaxRegisters) {
    Row::run_in_memory(args, levels);
  } else {
    if (levels.registers == kRegisters) return Row::template run<kRegisters>(args, levels);
    run_row<Row, kRegisters + 1>(args, levels);
  }
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_AGGREGATE_LANES_H
