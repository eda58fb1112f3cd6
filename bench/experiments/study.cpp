// Reads the pairs and runs the library for the experiments.
#include "bench/experiments/study.h"

#include <algorithm>

#include "bench/study_error.h"
#include "host/config_options.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

bool is_in(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// What a quick run takes: two scenes that parameters were chosen on and one that confirms them.
std::vector<Pair> quick_scenes(const std::vector<Pair>& scenes, const std::vector<std::string>& confirmed) {
  size_t room[2] = {2, 1};
  std::vector<Pair> kept;
  for (const Pair& scene : scenes) {
    size_t& left = room[is_in(confirmed, scene.name) ? 1 : 0];
    if (left == 0) continue;
    --left;
    kept.push_back(scene);
  }
  return kept;
}

std::vector<Pair> gray_pairs(const std::vector<Pair>& pairs) {
  std::vector<Pair> gray = pairs;
  for (Pair& pair : gray) {
    pair.name += " (gray)";
    pair.left = to_gray(pair.left);
    pair.right = to_gray(pair.right);
  }
  return gray;
}

std::vector<Pair> load(const std::string& folder, const std::string& pairs_file) {
  PairSetOptions options;
  options.pairs_file = pairs_file;
  std::vector<Pair> pairs;
  std::string error;
  if (!load_pairs(folder, options, &pairs, &error)) throw StudyError(error);
  return pairs;
}

std::string subtitle(const StudyOptions& options) {
  return std::string("Library version ") + bsm_version() +
         ", CPU features used: " + host::feature_names(bsm_cpu_features() & options.isa_mask) +
         (options.quick ? "; a quick run over fewer pairs" : "");
}

}  // namespace

PairList list_of(const std::vector<Pair>& pairs) {
  PairList list;
  for (const Pair& pair : pairs) list.push_back(&pair);
  return list;
}

Study::Study(const StudyOptions& options, const std::string& title)
    : options_(options),
      benchmark_(load(options.benchmark_folder, options.pairs_file)),
      scenes_(load(options.scenes_folder, options.pairs_file)),
      report_(options.output_folder, title, subtitle(options)) {
  if (options.quick) scenes_ = quick_scenes(scenes_, options.confirmed);
  benchmark_gray_ = gray_pairs(benchmark_);
  scenes_gray_ = gray_pairs(scenes_);
}

PairList Study::benchmark_list(bool gray) const {
  return list_of(benchmark(gray));
}

PairList Study::scene_list(bool gray) const {
  return list_of(scenes(gray));
}

PairList Study::scene_group(bool confirmed, bool gray) const {
  PairList list;
  for (size_t i = 0; i < scenes_.size(); ++i) {
    if (is_in(options_.confirmed, scenes_[i].name) == confirmed) list.push_back(&scenes(gray)[i]);
  }
  return list;
}

const Pair& Study::time_pair() const {
  return *std::max_element(benchmark_.begin(), benchmark_.end(), [](const Pair& a, const Pair& b) {
    const auto work = [](const Pair& pair) { return int64_t{pair.left.width} * pair.left.height * pair.num_disparities; };
    return work(a) < work(b);
  });
}

std::string Study::key(const Pair& pair, const bsm_config& config) const {
  return pair.name + '\0' + std::string(reinterpret_cast<const char*>(&config), sizeof config);
}

const Match& Study::match(const Pair& pair, const bsm_config& config) {
  const std::string wanted = key(pair, config);
  const auto known = matches_.find(wanted);
  if (known != matches_.end()) {
    progress_.step(experiment_ + ": " + pair.name + " (matched before)");
    return known->second;
  }
  return matches_.emplace(wanted, match_once(pair, config)).first->second;
}

Match Study::match_once(const Pair& pair, const bsm_config& config) {
  progress_.step(experiment_ + ": " + pair.name);
  bsm_config used = config;
  used.num_disparities = pair.num_disparities;
  used.max_jobs = options_.threads;
  used.isa_mask = options_.isa_mask;
  Match match;
  std::string error;
  if (!match_pair(pair, used, 1, &match, &error)) throw StudyError(error);
  return match;
}

Match Study::time(const Pair& pair, bsm_config config, int32_t num_disparities) {
  progress_.step(experiment_ + ": time of " + pair.name);
  config.num_disparities = num_disparities;
  config.max_jobs = 1;
  config.isa_mask = options_.isa_mask;
  Match match;
  std::string error;
  if (!match_pair(pair, config, options_.quick ? 1 : options_.repeat, &match, &error)) throw StudyError(error);
  return match;
}

Score Study::score(const Pair& pair, const bsm_config& config, const std::vector<double>& thresholds) {
  return score_map(pair, match(pair, config).map, thresholds);
}

Average Study::average(const PairList& pairs, const bsm_config& config, const std::vector<double>& thresholds) {
  Average average;
  for (const Pair* pair : pairs) average.add(score(*pair, config, thresholds));
  return average;
}

}  // namespace bsm::bench
