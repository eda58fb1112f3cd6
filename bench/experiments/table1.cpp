// Experiment table1: the 12 numbers of the benchmark for each stage of both methods, beside published rows.
#include <string>

#include "bench/experiments/experiments.h"
#include "bench/experiments/paper_values.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

struct Row {
  std::string name;
  bsm_config config;
};

std::vector<Row> measured_rows() {
  std::vector<Row> rows;
  const bsm_config paper = preset_configuration(BSM_PRESET_PAPER).config;
  const bsm_config local = local_configuration(BSM_MAX_BITS).config;
  const bsm_config sgm = preset_configuration(BSM_PRESET_BALANCED).config;
  const std::string local_name = describe(local), sgm_name = describe(sgm);
  rows.push_back({local_name + ", plain cost", at_stage(paper, BSM_STAGE_COST)});
  rows.push_back({local_name + ", masked cost", at_stage(paper, BSM_STAGE_MASKED)});
  rows.push_back({local_name + ", the paper's refinement", paper});
  rows.push_back({local_name + ", refined", local});
  rows.push_back({sgm_name + ", plain cost", at_stage(sgm, BSM_STAGE_COST)});
  rows.push_back({sgm_name + ", masked cost", at_stage(sgm, BSM_STAGE_MASKED)});
  rows.push_back({sgm_name + ", aggregated", at_stage(sgm, BSM_STAGE_AGGREGATED)});
  rows.push_back({sgm_name + ", refined", sgm});
  return rows;
}

constexpr size_t kPaperRow = 2, kLocalRow = 3, kSgmRow = 7;

std::vector<std::string> published_cells(const PublishedRow& row, const std::vector<Pair>& pairs) {
  std::vector<std::string> cells = {row.name};
  for (const Pair& pair : pairs) {
    const PublishedPair* found = nullptr;
    for (const PublishedPair& published : row.pairs) {
      if (published.pair != nullptr && pair.name == published.pair) found = &published;
    }
    for (int region = 0; region < kRegionCount; ++region) cells.push_back(found != nullptr ? fixed(found->bad[region]) : "");
  }
  cells.push_back(fixed(row.average));
  return cells;
}

// Plain against masked cost on the disc regions, where the mask removes the fattening of edges.
Table fattening(const std::vector<Row>& rows, const std::vector<Average>& averages) {
  Table table;
  table.columns = {"winner-takes-all", "nonocc", "all", "disc"};
  for (const size_t i : {size_t{0}, size_t{1}, size_t{4}, size_t{5}}) {
    std::vector<std::string> cells = {rows[i].name};
    for (int region = 0; region < kRegionCount; ++region) cells.push_back(fixed(averages[i].region(0, region)));
    table.add(cells);
  }
  return table;
}

int steps(const Study& study) {
  return static_cast<int>(measured_rows().size() * study.benchmark().size());
}

void run(Study& study) {
  study.report().section(
      "table1", "Table 1: benchmark errors",
      "Bad pixels in percent, error above 1.0, in the three regions of each pair; the average is the mean of "
      "all numbers. Italic rows are published values.");
  Table table;
  table.columns = {"method"};
  for (const Pair& pair : study.benchmark()) {
    for (const char* region : kRegionNames) table.columns.push_back(pair.name + " " + region);
  }
  table.columns.push_back("average");
  const std::vector<Row> rows = measured_rows();
  std::vector<Average> averages;
  for (const Row& row : rows) {
    std::vector<std::string> cells = {row.name};
    averages.emplace_back();
    for (const Pair& pair : study.benchmark()) {
      const Score score = study.score(pair, row.config, {1.0});
      averages.back().add(score);
      for (size_t region = 0; region < kRegionCount; ++region) {
        cells.push_back(score.has_region[region] ? fixed(score.bad[0][region]) : "");
      }
    }
    cells.push_back(fixed(averages.back().mean(0)));
    table.add(cells);
  }
  std::vector<std::string> published;
  for (const PublishedRow& row : kPublishedRows) {
    table.add(published_cells(row, study.benchmark()));
    published.push_back(row.name);
  }
  study.report().table("table1", "", table, published);
  study.report().table("table1_mask",
                       "What the mask removes: errors averaged over the pairs before any aggregation or check",
                       fattening(rows, averages));
  study.report().headline(
      {fixed(averages[kSgmRow].mean(0)) + " %", describe(rows[kSgmRow].config), "benchmark average; the paper: 5.42"});
  study.report().headline(
      {fixed(averages[kLocalRow].mean(0)) + " %", describe(rows[kLocalRow].config), "this library's refinement"});
  study.report().headline(
      {fixed(averages[kPaperRow].mean(0)) + " %", describe(rows[kPaperRow].config), "the paper's own steps"});
}

}  // namespace

const Experiment kTable1 = {"table1", "12 benchmark errors of cost, masked, aggregated and refined maps, both methods",
                            steps, run};

}  // namespace bsm::bench
