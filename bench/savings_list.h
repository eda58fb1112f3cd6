// The savings of kernels and stages, each with its plain form, on rows of a pair.
#ifndef BSM_BENCH_SAVINGS_LIST_H
#define BSM_BENCH_SAVINGS_LIST_H

#include <functional>
#include <string>
#include <vector>

#include "bench/pair_rows.h"

namespace bsm::bench {

// One saving: all sampled rows by each form.
struct Saving {
  std::string name, where;
  std::function<void()> plain, saved;
  std::function<bool()> same;  // what both wrote
};

// Those of the kernels that may run; rows outlives them.
std::vector<Saving> all_savings(const PairRows& rows);

}  // namespace bsm::bench

#endif  // BSM_BENCH_SAVINGS_LIST_H
