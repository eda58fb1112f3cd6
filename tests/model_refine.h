// model_refine.h - a plain model of the whole library, stage by stage: to the winners and the sparse map it adds vote,
// holes, weighted median, 3x3 median, smoothing of the fractions and the confidence. Whole frames in std::vector, one
// function for each rule. It shares with the library only what is checked on its own: the tables of weights.
#ifndef BSM_TESTS_MODEL_REFINE_H
#define BSM_TESTS_MODEL_REFINE_H

#include <cstdint>
#include <vector>

#include "bsm/bsm.h"
#include "images.h"

namespace bsm::test {

// Both maps and the confidence of every stage, by bsm_stage, in the library's units. The aggregated stage is empty for the
// local method.
struct FullMaps {
  std::vector<int16_t> left[BSM_STAGE_REFINED + 1], right[BSM_STAGE_REFINED + 1];
  std::vector<uint8_t> confidence[BSM_STAGE_REFINED + 1];
};

// The configuration's format says only whether colour takes part; the colours come from `pair`.
FullMaps run_full_model(const bsm_config& config, const ColorPair& pair);

}  // namespace bsm::test

#endif  // BSM_TESTS_MODEL_REFINE_H
