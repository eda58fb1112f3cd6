// model.h - a plain model of the paper: equations 1-10 and the decisions of the documentation, pixel by pixel, written for
// reading and not for speed. It shares with the library only what is checked on its own: the pattern, the stored CIELAB
// colours and the weights of the vote.
#ifndef BSM_TESTS_MODEL_H
#define BSM_TESTS_MODEL_H

#include <cstdint>
#include <vector>

#include "bsm/bsm.h"
#include "images.h"

namespace bsm::test {

// The maps of every stage, by bsm_stage, in the library's units.
struct ModelMaps {
  std::vector<int16_t> left[BSM_STAGE_REFINED + 1], right[BSM_STAGE_REFINED + 1];
};

// The configuration's format says only whether colour takes part; the colours come from `pair`.
ModelMaps run_model(const bsm_config& config, const ColorPair& pair);

}  // namespace bsm::test

#endif  // BSM_TESTS_MODEL_H
