// Measures frames of made-up views, each in turn with the given pair.
#include "bench/worst_bench.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <vector>

#include "bench/configurations.h"
#include "bench/frame_run.h"
#include "bench/kernel_inputs.h"
#include "bench/statistics.h"
#include "bench/table.h"
#include "host/config_options.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

using host::Image8;

// Views of the given pair's size and channels.
struct Views {
  std::string name;
  Image8 left, right;
};

// `value` of each sample: a function of its pixel and channel.
Image8 made(const Image8& like, const std::function<int32_t(int32_t x, int32_t y, int32_t channel)>& value) {
  Image8 image = like;
  uint8_t* sample = image.pixels.data();
  for (int32_t y = 0; y < image.height; ++y) {
    for (int32_t x = 0; x < image.width; ++x) {
      for (int32_t channel = 0; channel < image.channels; ++channel) {
        *sample++ = static_cast<uint8_t>(value(x, y, channel));
      }
    }
  }
  return image;
}

Image8 flat(const Image8& like, int32_t level) {
  return made(like, [level](int32_t, int32_t, int32_t) { return level; });
}

Image8 noise(const Image8& like, Rng* rng, int32_t most) {
  return made(like, [=](int32_t, int32_t, int32_t) { return rng->range(0, most); });
}

Image8 stripes(const Image8& like, int32_t period) {
  return made(like, [period](int32_t x, int32_t, int32_t) { return x % period < period / 2 ? 40 : 210; });
}

Image8 upside_down(const Image8& image) {
  Image8 turned = image;
  for (int32_t y = 0; y < image.height; ++y) {
    std::copy_n(image.row(image.height - 1 - y), image.row_bytes(),
                turned.pixels.data() + static_cast<size_t>(y) * image.row_bytes());
  }
  return turned;
}

// The given pair first.
std::vector<Views> all_views(const Image8& left, const Image8& right) {
  constexpr int32_t kDark = 2;  // levels of a sensor behind a covered lens
  constexpr int32_t kPeriod = 8;
  Rng rng;
  const Image8 same = noise(left, &rng, 255);
  std::vector<Views> views = {{"the given pair", left, right},
                              {"black", flat(left, 0), flat(left, 0)},
                              {"white", flat(left, 255), flat(left, 255)},
                              {"stripes of period 8", stripes(left, kPeriod), stripes(left, kPeriod)},
                              {"noise, the same in both", same, same}};
  views.push_back({"noise, each its own", noise(left, &rng, 255), noise(left, &rng, 255)});
  views.push_back({"unrelated: right upside down", left, upside_down(right)});
  views.push_back({"covered lenses: dark noise", noise(left, &rng, kDark), noise(left, &rng, kDark)});
  views.push_back({"covered left lens", noise(left, &rng, kDark), right});
  views.push_back({"covered right lens", left, noise(left, &rng, kDark)});
  return views;
}

// Times and outcome of one configuration on one pair of views.
struct Cell {
  std::vector<double> milliseconds;
  double milliseconds_median() const { return median(milliseconds); }
};

// Median of the rounds' ratios to the given pair: both runs of a round meet the same machine.
double ratio(const Cell& cell, const Cell& given) {
  std::vector<double> ratios;
  for (size_t i = 0; i < cell.milliseconds.size(); ++i) ratios.push_back(cell.milliseconds[i] / given.milliseconds[i]);
  return median(ratios);
}

std::vector<Configuration> configurations(bool gray) {
  return {preset_configuration(BSM_PRESET_FAST, gray), preset_configuration(BSM_PRESET_BALANCED, gray),
          local_configuration(256, gray), local_configuration(BSM_MAX_BITS, gray)};
}

bool measure(const WorstBench& bench, const Configuration& configuration, const std::vector<Views>& views,
             std::vector<Cell>* cells, std::string* error) {
  bsm_config config = configuration.config;
  config.width = views.front().left.width;
  config.height = views.front().left.height;
  config.num_disparities = bench.disparities;
  config.isa_mask = bench.isa_mask;
  FrameRun frames;
  if (!frames.open(config, error)) return false;
  cells->resize(views.size());
  for (int32_t round = -1; round < bench.repeat; ++round) {  // the round before the first is not kept
    for (size_t i = 0; i < views.size(); ++i) {
      double milliseconds = 0.0;
      if (!frames.match(views[i].left, views[i].right, &milliseconds, error)) return false;
      if (round >= 0) (*cells)[i].milliseconds.push_back(milliseconds);
    }
  }
  return true;
}

}  // namespace

bool run_worst_bench(const WorstBench& bench, std::string* error) {
  Image8 left, right;
  if (!read_views(bench.left, bench.right, &left, &right, error)) return false;
  const std::vector<Views> views = all_views(left, right);
  const std::vector<Configuration> list = configurations(left.channels == 1);
  Table table;
  table.columns = {"views"};
  for (const Views& one : views) table.rows.push_back({one.name});
  table.rows.push_back({"most"});
  for (const Configuration& configuration : list) {
    std::vector<Cell> cells;
    if (!measure(bench, configuration, views, &cells, error)) return false;
    table.columns.push_back(configuration.name + " ms");
    table.columns.push_back("x");
    double most = 0.0;
    for (size_t i = 0; i < views.size(); ++i) {
      const double times = ratio(cells[i], cells.front());
      most = std::max(most, times);
      table.rows[i].push_back(fixed(cells[i].milliseconds_median()));
      table.rows[i].push_back(fixed(times));
    }
    table.rows.back().push_back("");
    table.rows.back().push_back(fixed(most));
  }
  if (bench.csv) {
    std::fputs(to_csv(table).c_str(), stdout);
    return true;
  }
  std::printf(
      "%d x %d pixels, %s, disparities 0..%d, refined map, one thread, --isa %s; medians of %d runs, the views in turn.\n"
      "x: times the given pair's time, the median of the rounds' ratios.\n\n",
      static_cast<int>(left.width), static_cast<int>(left.height), left.channels == 1 ? "gray" : "colour",
      static_cast<int>(bench.disparities - 1), bench.isa.c_str(), static_cast<int>(bench.repeat));
  std::fputs(to_text(table).c_str(), stdout);
  return true;
}

}  // namespace bsm::bench
