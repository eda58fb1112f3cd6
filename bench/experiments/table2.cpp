// Experiment table2: time and memory on one core, beside the paper's.
#include <cstring>
#include <string>

#include "bench/experiments/experiments.h"
#include "bench/experiments/paper_values.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

std::vector<Configuration> timed() {
  std::vector<Configuration> list = {preset_configuration(BSM_PRESET_PAPER), local_configuration(BSM_MAX_BITS),
                                     local_configuration(256)};
  list[0].name = describe(list[0].config) + ", the paper's refinement (paper)";
  for (const bsm_preset preset : {BSM_PRESET_FAST, BSM_PRESET_BALANCED, BSM_PRESET_BEST}) {
    list.push_back(preset_configuration(preset));
    list.back().name = describe(list.back().config) + " (" + list.back().name + ")";
  }
  return list;
}

std::string seconds(double ms) {
  return ms >= 10000.0 ? fixed(ms / 1000.0, 1) : fixed(ms / 1000.0, 3);
}

int steps(const Study&) {
  return static_cast<int>(timed().size());
}

void run(Study& study) {
  const Pair& pair = study.time_pair();
  study.report().section(
      "table2", "Table 2: time",
      "Matching " + pair.name +
          host::text(
              " (%d x %d pixels, %d disparities) from two images in memory to a dense map, one thread, the fastest of %d. "
              "Published times come from the machines of their day.",
              static_cast<int>(pair.left.width), static_cast<int>(pair.left.height), static_cast<int>(pair.num_disparities),
              static_cast<int>(study.options().quick ? 1 : study.options().repeat)));
  Table table;
  table.columns = {"method", "machine", "seconds", "arena KB", "times faster than the paper"};
  const Configuration headline = preset_configuration(BSM_PRESET_BALANCED);
  for (const Configuration& configuration : timed()) {
    const Match match = study.time(pair, configuration.config);
    table.add({configuration.name, "this one", seconds(match.ms_min),
               fixed(static_cast<double>(match.arena_bytes) / 1024.0, 0),
               fixed(1000.0 * kPublishedTimes[0].seconds / match.ms_min, 0)});
    if (std::memcmp(&configuration.config, &headline.config, sizeof headline.config) == 0) {
      study.report().headline(
          {fixed(match.ms_min, 1) + " ms", describe(configuration.config) + ", " + pair.name, "one thread"});
      study.report().headline({fixed(static_cast<double>(match.arena_bytes) / 1024.0, 0) + " KB",
                               describe(configuration.config) + ", " + pair.name, "working memory"});
    }
  }
  std::vector<std::string> published;
  for (const PublishedTime& time : kPublishedTimes) {
    table.add({time.name, time.machine, fixed(time.seconds, 0), "", fixed(kPublishedTimes[0].seconds / time.seconds, 1)});
    published.push_back(time.name);
  }
  study.report().table("table2", "", table, published);
}

}  // namespace

const Experiment kTable2 = {"table2", "time and memory of every preset, beside the paper's times", steps, run};

}  // namespace bsm::bench
