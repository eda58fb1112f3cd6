// Counts and averages.
#include "bench/score.h"

#include <algorithm>

#include "host/evaluate.h"

namespace bsm::bench {

double Score::mean(size_t threshold) const {
  double sum = 0.0;
  int count = 0;
  for (size_t region = 0; region < kRegionCount; ++region) {
    if (!has_region[region]) continue;
    sum += bad[threshold][region];
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

Score score_map(const Pair& pair, const host::DisparityMap& map, const std::vector<double>& thresholds) {
  Score score;
  score.thresholds = thresholds;
  score.bad.resize(thresholds.size());
  for (size_t region = 0; region < kRegionCount; ++region) {
    score.has_region[region] = pair.has_region[region];
    if (!pair.has_region[region]) continue;
    for (size_t t = 0; t < thresholds.size(); ++t) {
      score.bad[t][region] = host::evaluate(map, pair.truth, pair.masks[region], thresholds[t]).bad_percent();
    }
  }
  score.mean_error = host::evaluate(map, pair.truth, pair.masks[kAll], 1.0).mean_error();
  return score;
}

void Average::add(const Score& score) {
  sums_.resize(std::max(sums_.size(), score.bad.size()));
  ++pairs_;
  error_sum_ += score.mean_error;
  for (size_t region = 0; region < kRegionCount; ++region) {
    if (!score.has_region[region]) continue;
    ++counts_[region];
    for (size_t t = 0; t < score.bad.size(); ++t) sums_[t][region] += score.bad[t][region];
  }
}

double Average::region(size_t threshold, int region) const {
  const size_t r = static_cast<size_t>(region);
  return counts_[r] > 0 ? sums_[threshold][r] / static_cast<double>(counts_[r]) : 0.0;
}

double Average::mean(size_t threshold) const {
  double sum = 0.0;
  size_t count = 0;
  for (size_t region = 0; region < kRegionCount; ++region) {
    if (counts_[region] > 0) sum += sums_[threshold][region];
    count += counts_[region];
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

bool parse_group(const std::string& argument, Group* group, std::string* error) {
  *group = Group();
  const size_t equals = argument.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == argument.size()) {
    *error = "--group '" + argument + "': expected NAME=PAIR,PAIR,..., such as first=tsukuba,venus";
    return false;
  }
  group->name = argument.substr(0, equals);
  size_t begin = equals + 1;
  while (begin <= argument.size()) {
    const size_t end = std::min(argument.find(',', begin), argument.size());
    if (end > begin) group->pairs.push_back(argument.substr(begin, end - begin));
    begin = end + 1;
  }
  if (!group->pairs.empty()) return true;
  *error = "--group '" + argument + "': names no pair";
  return false;
}

}  // namespace bsm::bench
