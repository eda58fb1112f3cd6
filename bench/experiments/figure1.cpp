// Experiment figure1: the map after every stage, as pictures.
#include <string>

#include "bench/experiments/experiments.h"
#include "bench/experiments/pictures.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

struct Stage {
  const char* file;
  const char* caption;
  bool sgm;
  bsm_stage stage;
};

constexpr Stage kStages[] = {
    {"local_cost", "plain cost", false, BSM_STAGE_COST},
    {"local_masked", "masked cost", false, BSM_STAGE_MASKED},
    {"local_checked", "left/right check", false, BSM_STAGE_CHECKED},
    {"local_refined", "refined as the paper does", false, BSM_STAGE_REFINED},
    {"sgm_masked", "masked cost", true, BSM_STAGE_MASKED},
    {"sgm_aggregated", "aggregated", true, BSM_STAGE_AGGREGATED},
    {"sgm_checked", "left/right check", true, BSM_STAGE_CHECKED},
    {"sgm_refined", "refined", true, BSM_STAGE_REFINED},
};
constexpr size_t kStageCount = sizeof(kStages) / sizeof(kStages[0]);

int steps(const Study& study) {
  return static_cast<int>(kStageCount * study.benchmark().size());
}

void run(Study& study) {
  study.report().section(
      "figure1", "Figure 1: stages",
      "Violet is far, yellow is near, black has no disparity. The percentages are bad pixels in the region "
      "all; pixels without a disparity count as bad.");
  const bsm_config local = preset_configuration(BSM_PRESET_PAPER).config;
  const bsm_config sgm = preset_configuration(BSM_PRESET_BALANCED).config;
  for (const Pair& pair : study.benchmark()) {
    std::vector<Picture> pictures = {{"figure1_" + pair.name + "_left", pair.left, pair.name + ": left view"},
                                     {"figure1_" + pair.name + "_truth", draw_truth(pair), pair.name + ": ground truth"}};
    for (const Stage& stage : kStages) {
      const bsm_config config = at_stage(stage.sgm ? sgm : local, stage.stage);
      const Match& match = study.match(pair, config);
      const Score score = score_map(pair, match.map, {1.0});
      pictures.push_back({"figure1_" + pair.name + "_" + stage.file, draw_match(pair, match),
                          describe(config) + ": " + stage.caption + host::text(" (%.1f %%)", score.bad[0][kAll])});
    }
    study.report().pictures(pictures);
  }
}

}  // namespace

const Experiment kFigure1 = {"figure1", "pictures of the map after every stage", steps, run};

}  // namespace bsm::bench
