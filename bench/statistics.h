// The middle of repeated measurements.
#ifndef BSM_BENCH_STATISTICS_H
#define BSM_BENCH_STATISTICS_H

#include <algorithm>
#include <cstddef>
#include <vector>

namespace bsm::bench {

// Of at least one value.
inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

}  // namespace bsm::bench

#endif  // BSM_BENCH_STATISTICS_H
