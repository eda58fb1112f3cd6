// What the experiments share: the pairs, matching with progress and memory of what was matched, the report.
#ifndef BSM_BENCH_EXPERIMENTS_STUDY_H
#define BSM_BENCH_EXPERIMENTS_STUDY_H

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bench/configurations.h"
#include "bench/experiments/progress.h"
#include "bench/match_pair.h"
#include "bench/pair_set.h"
#include "bench/report/report.h"
#include "bench/score.h"
#include "bsm/bsm.h"

namespace bsm::bench {

struct StudyOptions {
  std::string benchmark_folder;  // the four pairs with official regions
  std::string scenes_folder;     // the scenes of the radiometric study
  std::string output_folder;
  std::string pairs_file;
  std::vector<std::string> confirmed;  // scenes that no parameter was chosen on
  bool quick = false;                  // fewer pairs, lengths and repetitions
  int32_t threads = 1;                 // where time is not what is measured
  int32_t repeat = 5;                  // of each measured time
  uint32_t isa_mask = BSM_ISA_ALL;
};

using PairList = std::vector<const Pair*>;

// Every member throws StudyError when it cannot go on.
class Study {
 public:
  Study(const StudyOptions& options, const std::string& title);

  const StudyOptions& options() const { return options_; }
  Report& report() { return report_; }
  Progress& progress() { return progress_; }
  // Names what runs, for the progress.
  void begin(const std::string& experiment) { experiment_ = experiment; }

  const std::vector<Pair>& benchmark(bool gray = false) const { return gray ? benchmark_gray_ : benchmark_; }
  const std::vector<Pair>& scenes(bool gray = false) const { return gray ? scenes_gray_ : scenes_; }
  PairList benchmark_list(bool gray = false) const;
  PairList scene_list(bool gray = false) const;
  // The scenes that parameters were chosen on, and those they are confirmed on.
  PairList scene_group(bool confirmed, bool gray = false) const;
  // The pair whose time stands for all: the benchmark's with the most pixels times disparities.
  const Pair& time_pair() const;

  // Matches and keeps the result; what was matched before comes from memory.
  const Match& match(const Pair& pair, const bsm_config& config);
  // Matches a pair that does not stay, without keeping the result.
  Match match_once(const Pair& pair, const bsm_config& config);
  // Matches in one thread, several times, for ms_min: what other programs take of the machine only adds; the number of
  // disparities is config's.
  Match time(const Pair& pair, bsm_config config, int32_t num_disparities);
  Match time(const Pair& pair, const bsm_config& config) { return time(pair, config, pair.num_disparities); }

  Score score(const Pair& pair, const bsm_config& config, const std::vector<double>& thresholds);
  Average average(const PairList& pairs, const bsm_config& config, const std::vector<double>& thresholds);

 private:
  std::string key(const Pair& pair, const bsm_config& config) const;
  StudyOptions options_;
  std::vector<Pair> benchmark_, scenes_, benchmark_gray_, scenes_gray_;
  Report report_;
  Progress progress_;
  std::string experiment_;
  std::map<std::string, Match> matches_;
};

PairList list_of(const std::vector<Pair>& pairs);

}  // namespace bsm::bench

#endif  // BSM_BENCH_EXPERIMENTS_STUDY_H
