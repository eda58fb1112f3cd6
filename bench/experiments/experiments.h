// The list of experiments; each prints one section of the report.
#ifndef BSM_BENCH_EXPERIMENTS_EXPERIMENTS_H
#define BSM_BENCH_EXPERIMENTS_EXPERIMENTS_H

#include "bench/experiments/study.h"

namespace bsm::bench {

struct Experiment {
  const char* name;     // of --only
  const char* summary;  // one line of --help
  int (*steps)(const Study& study);
  void (*run)(Study& study);
};

extern const Experiment kTable1, kTable2, kFigure1, kFigure3, kFigure4, kDisparities, kThresholds, kGray, kPresets,
    kFractions, kRefinement, kConfidence, kErrors;

}  // namespace bsm::bench

#endif  // BSM_BENCH_EXPERIMENTS_EXPERIMENTS_H
