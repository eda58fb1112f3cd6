// Experiment refinement: the gain and the cost of each step, by switching it off or changing it alone.
#include <cstring>
#include <string>
#include <vector>

#include "bench/experiments/experiments.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

struct Variant {
  const char* name;
  void (*change)(bsm_config* config);
};

constexpr Variant kVariants[] = {
    {"preset balanced", [](bsm_config*) {}},
    {"without the speckle filter", [](bsm_config* config) { config->speckle = 0; }},
    {"without the border band", [](bsm_config* config) { config->border = 0; }},
    {"without the occlusion cap of votes", [](bsm_config* config) { config->vote_cap = 0; }},
    {"every pixel of the window votes", [](bsm_config* config) { config->vote_step = 1; }},
    {"without the weighted median", [](bsm_config* config) { config->smooth_passes = 0; }},
    {"one pass of the weighted median", [](bsm_config* config) { config->smooth_passes = 1; }},
    {"without the 3x3 median", [](bsm_config* config) { config->median = 0; }},
    {"without sub-pixel fractions", [](bsm_config* config) { config->subpixel = 0; }},
    {"left/right tolerance 0", [](bsm_config* config) { config->lr_tolerance = 0; }},
    {"right map from the left view's sums", [](bsm_config* config) { config->right_costs = BSM_RIGHT_COSTS_LEFT; }},
    {"3 paths", [](bsm_config* config) { config->paths = 3; }},
    {"4 paths", [](bsm_config* config) { config->paths = 4; }},
    {"5 paths", [](bsm_config* config) { config->paths = 5; }},
    {"8 paths", [](bsm_config* config) { config->paths = 8; }},
    {"no refinement: checked map", [](bsm_config* config) { config->stage = BSM_STAGE_CHECKED; }},
};

struct Setting {
  const char* name;
  bsm_config config;
};

// The preset itself first; changes that change nothing are left out.
std::vector<Setting> settings() {
  const bsm_config base = preset_configuration(BSM_PRESET_BALANCED).config;
  std::vector<Setting> list;
  for (const Variant& variant : kVariants) {
    Setting setting{variant.name, base};
    variant.change(&setting.config);
    if (list.empty() || std::memcmp(&setting.config, &base, sizeof base) != 0) list.push_back(setting);
  }
  return list;
}

struct Result {
  Average benchmark, chosen, confirmed;
  double ms = 0.0;
};

std::string signed_number(double value, int digits) {
  return host::text("%+.*f", digits, value);
}

int steps(const Study& study) {
  return static_cast<int>(settings().size() * (study.benchmark().size() + study.scenes().size() + 1));
}

void run(Study& study) {
  study.report().section(
      "refinement", "Each step alone",
      "One setting of the preset balanced is changed at a time. Errors at threshold 1.0, mean of the regions "
      "with the change against the preset: positive means that the preset is better; time in one thread on " +
          study.time_pair().name + ", and its change: negative is what the step costs.");
  const std::vector<double> thresholds = {0.5, 1.0};
  Table table;
  table.columns = {"setting", "benchmark",       "change", "chosen scenes", "change", "confirming scenes",
                   "change",  "benchmark > 0.5", "change", "mean error px", "ms",     "change"};
  Result base;
  const std::vector<Setting> list = settings();
  for (size_t i = 0; i < list.size(); ++i) {
    const bsm_config& config = list[i].config;
    Result result;
    result.benchmark = study.average(study.benchmark_list(), config, thresholds);
    result.chosen = study.average(study.scene_group(false), config, thresholds);
    result.confirmed = study.average(study.scene_group(true), config, thresholds);
    result.ms = study.time(study.time_pair(), config).ms_min;
    if (i == 0) base = result;
    const auto change = [&](double value, double before, int digits) {
      return i == 0 ? std::string() : signed_number(value - before, digits);
    };
    table.add({list[i].name, fixed(result.benchmark.mean(1)), change(result.benchmark.mean(1), base.benchmark.mean(1), 2),
               fixed(result.chosen.mean(1)), change(result.chosen.mean(1), base.chosen.mean(1), 2),
               fixed(result.confirmed.mean(1)), change(result.confirmed.mean(1), base.confirmed.mean(1), 2),
               fixed(result.benchmark.mean(0)), change(result.benchmark.mean(0), base.benchmark.mean(0), 2),
               fixed(result.benchmark.mean_error(), 3), fixed(result.ms, 1), change(result.ms, base.ms, 1)});
  }
  study.report().table("refinement", "", table);
}

}  // namespace

const Experiment kRefinement = {"refinement", "gain and cost of each step, switched off alone", steps, run};

}  // namespace bsm::bench
