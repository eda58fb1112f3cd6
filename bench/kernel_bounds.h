// The least core cycles that a call of a kernel can take on a core of its instruction set's common width: for each argument
// struct one function, found by its type, so that a stage without one does not compile.
//
// A bound counts the operations that the stage needs with the instructions of the set, all of them perfectly overlapped and
// all data in the first-level cache. What a kernel does beyond that (latency of chains, ends of rows, loops, slower caches)
// is what keeps it below 100 %. A wider core, or a method that needs fewer operations than those counted, can exceed it.
#ifndef BSM_BENCH_KERNEL_BOUNDS_H
#define BSM_BENCH_KERNEL_BOUNDS_H

#include <string>

#include "simd/kernels.h"

namespace bsm::bench {

// What a core issues in a cycle.
struct Core {
  const char* isa;
  int32_t bytes;  // of a vector; scalar kernels work on one pixel or on words of 8 bytes
  double alus;    // operations on vectors, for scalar on words
  double loads, stores;
  double distance;  // operations of |a - b| in bytes
};

// nullptr: nothing is known of this instruction set.
const Core* core_of(const std::string& isa);

double bound_cycles(const Core& core, const ColorLabArgs& args);
double bound_cycles(const Core& core, const DescriptorCompareArgs& args);
double bound_cycles(const Core& core, const MaskThresholdArgs& args);
double bound_cycles(const Core& core, const MatchHammingArgs& args);
double bound_cycles(const Core& core, const CostHammingArgs& args);
double bound_cycles(const Core& core, const EdgeThresholdArgs& args);
double bound_cycles(const Core& core, const AggregateAlongArgs& args);
double bound_cycles(const Core& core, const AggregateAcrossArgs& args);
double bound_cycles(const Core& core, const WinnerSumsArgs& args);
double bound_cycles(const Core& core, const VoteWeighArgs& args);
double bound_cycles(const Core& core, const MedianWeightedArgs& args);
double bound_cycles(const Core& core, const FractionSmoothArgs& args);

}  // namespace bsm::bench

#endif  // BSM_BENCH_KERNEL_BOUNDS_H
