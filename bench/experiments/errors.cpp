// Experiment errors: where bad pixels remain, by cause, as tables and pictures.
#include <string>

#include "bench/experiments/cause_shares.h"
#include "bench/experiments/experiments.h"
#include "bench/report/svg_plot.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

PairList all_pairs(const Study& study) {
  PairList pairs = study.benchmark_list();
  for (const Pair* pair : study.scene_list()) pairs.push_back(pair);
  return pairs;
}

std::string html_color(const host::Color& color) {
  return host::text("#%02x%02x%02x", color.r, color.g, color.b);
}

int steps(const Study& study) {
  return static_cast<int>(all_pairs(study).size());
}

// Of the pixels of all pairs: how many are in each class, how many of those are bad.
Table class_table(const CauseShares& total) {
  Table table;
  table.columns = {"cause", "% of the pixels", "bad among them %", "share of the bad %"};
  for (size_t cause = 0; cause < kCauseCount; ++cause) {
    const double pixels = static_cast<double>(total.pixels_in[cause]), bad = static_cast<double>(total.bad_in[cause]);
    table.add({kCauseNames[cause], fixed(total.counted > 0 ? 100.0 * pixels / static_cast<double>(total.counted) : 0.0, 1),
               fixed(pixels > 0.0 ? 100.0 * bad / pixels : 0.0, 1), fixed(total.share_percent(cause), 1)});
  }
  return table;
}

void run(Study& study) {
  study.report().section(
      "errors", "Where errors remain",
      "Bad pixels (above 1.0, region all) of the preset balanced by cause. A pixel counts for the first that holds: border "
      "= its "
      "match lies outside the right image; occluded = hidden in the right view; discontinuity = within 4 pixels of a jump "
      "of "
      "the truth; textureless = mean squared horizontal difference of the luma below 16 in 3 x 3 pixels; repeated = another "
      "place of the row within the search range differs by at most 4 levels on average in 7 x 7 pixels; slanted = the truth "
      "changes by a tenth of a pixel per pixel or more; other = none of these.");
  const bsm_config config = preset_configuration(BSM_PRESET_BALANCED).config;
  Table table;
  table.columns = {"pair", "bad %"};
  StackPlot plot;
  plot.title = "Bad pixels by cause";
  plot.x_label = "bad pixels (% of the pixels of known truth)";
  std::vector<std::string> names, colors;
  for (size_t cause = 0; cause < kCauseCount; ++cause) {
    names.push_back(kCauseNames[cause]);
    colors.push_back(html_color(kCauseColors[cause]));
    table.columns.push_back(std::string(kCauseNames[cause]) + " %");
  }
  plot.parts = names;
  plot.colors = colors;
  const auto add_row = [&](const std::string& name, const CauseShares& shares) {
    std::vector<double> values;
    double bad = 0.0;
    for (size_t cause = 0; cause < kCauseCount; ++cause) {
      values.push_back(shares.bad_percent(cause));
      bad += values.back();
    }
    std::vector<std::string> cells = {name, fixed(bad)};
    for (size_t cause = 0; cause < kCauseCount; ++cause) cells.push_back(fixed(shares.share_percent(cause), 1));
    table.add(cells);
    plot.categories.push_back(name);
    plot.values.push_back(values);
  };
  CauseShares total;
  std::vector<Picture> pictures;
  for (const Pair* pair : all_pairs(study)) {
    const Match& match = study.match(*pair, config);
    const std::vector<uint8_t> classes = classify(*pair);
    const CauseShares shares = count_causes(*pair, classes, match.map);
    total.add(shares);
    add_row(pair->name, shares);
    double bad = 0.0;
    for (size_t cause = 0; cause < kCauseCount; ++cause) bad += shares.bad_percent(cause);
    pictures.push_back(
        {"errors_" + pair->name, draw_causes(*pair, classes, match.map), pair->name + host::text(": %.1f %% bad", bad)});
  }
  add_row("all pixels", total);
  study.report().plot("errors", draw_stacks(plot));
  study.report().table("errors", "Share of each cause in the bad pixels", table);
  study.report().table("errors_classes", "How hard each class is", class_table(total));
  study.report().legend(names, colors);
  study.report().pictures(pictures, true);
}

}  // namespace

const Experiment kErrors = {"errors", "error maps with shares by cause", steps, run};

}  // namespace bsm::bench
