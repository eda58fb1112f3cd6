// model_sparse.h - a plain model of the steps that make the sparse map: left/right check, speckle filter, border
// continuation.
#ifndef BSM_TESTS_MODEL_SPARSE_H
#define BSM_TESTS_MODEL_SPARSE_H

#include <vector>

#include "bsm/bsm.h"
#include "model_sgm.h"

namespace bsm::test {

using ModelLevels = std::vector<int>;  // in 1/16 pixel, kModelNone or kModelOccluded

inline bool model_valid(int level) {
  return level >= 0;
}

// A sparse map after all three steps.
struct ModelSparse {
  ModelLevels levels;
  std::vector<bool> measured;  // false where the continuation wrote
};

// toward as in the winners: -1 for the left view, +1 for the right.
ModelLevels model_checked(const ModelLevels& levels, const ModelLevels& others, const ModelView& view, int toward,
                          const bsm_config& config);
ModelLevels model_despeckled(const ModelLevels& levels, const ModelView& view, const bsm_config& config);
ModelSparse model_continued(const ModelLevels& levels, const ModelView& view, int toward, const bsm_config& config);

}  // namespace bsm::test

#endif  // BSM_TESTS_MODEL_SPARSE_H
