// Line plots and column plots.
#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/report/svg_canvas.h"
#include "bench/report/svg_plot.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

constexpr double kWidth = 760.0, kPlotHeight = 300.0;
constexpr double kLeft = 66.0, kRight = 24.0, kTitle = 26.0, kBottom = 52.0;
constexpr double kMinLabelGap = 13.0, kReferenceGap = 6.0, kReferenceSize = 11.0;
constexpr double kNearZero = 0.2;  // an axis that begins below this share of its end begins at 0
constexpr const char* kGrid = "#e4e7eb";
constexpr const char* kAxis = "#9aa3ad";
constexpr const char* kReference = "#7a828c";
constexpr const char* kDashes = "6 4";

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void cover(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// Maps a value to a place on the canvas; the logarithm of both for a logarithmic axis.
struct Scale {
  double low, high, begin, end;
  bool logarithmic;
  double at(double value) const {
    const double position =
        logarithmic ? (std::log(value) - std::log(low)) / (std::log(high) - std::log(low)) : (value - low) / (high - low);
    return begin + position * (end - begin);
  }
};

std::vector<double> power_ticks(double low, double high) {
  std::vector<double> ticks;
  const double decades = std::log10(high / low);
  for (int power = static_cast<int>(std::floor(std::log10(low))); power <= std::ceil(std::log10(high)); ++power) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (decades > 2.5 && factor != 1.0) continue;
      ticks.push_back(factor * std::pow(10.0, power));
    }
  }
  // Keep one tick beyond the data on both sides.
  while (ticks.size() > 2 && ticks[1] <= low) ticks.erase(ticks.begin());
  while (ticks.size() > 2 && ticks[ticks.size() - 2] >= high) ticks.pop_back();
  return ticks;
}

void draw_y_axis(SvgCanvas* canvas, const Scale& y, double right, const std::vector<double>& ticks,
                 const std::string& label) {
  for (const double tick : ticks) {
    canvas->line(kLeft, y.at(tick), right, y.at(tick), kGrid);
    canvas->words(kLeft - 8.0, y.at(tick) + 4.0, short_number(tick), TextStyle{11.0, "end", "#555555"});
  }
  TextStyle style{12.0, "middle", "#333333"};
  style.turn = -90.0;
  canvas->words(18.0, (y.begin + y.end) / 2, label, style);
}

// Where the plot ends: names of references stand to the right of it.
double plot_right(const std::vector<Reference>& references) {
  double room = kRight;
  for (const Reference& reference : references) {
    room = std::max(room, text_width(reference.name, kReferenceSize) + 2 * kReferenceGap);
  }
  return kWidth - room;
}

// Names of close references are pushed apart.
void draw_references(SvgCanvas* canvas, const Scale& y, double right, std::vector<Reference> references) {
  std::sort(references.begin(), references.end(), [](const Reference& a, const Reference& b) { return a.y < b.y; });
  double last = std::numeric_limits<double>::infinity();
  for (const Reference& reference : references) {
    const double place = y.at(reference.y);
    canvas->line(kLeft, place, right, place, kReference, 1.0, "3 3");
    const double label = std::min(place + 4.0, last - kMinLabelGap);
    canvas->words(right + kReferenceGap, label, reference.name, TextStyle{kReferenceSize, "start", kReference});
    last = label;
  }
}

std::vector<LegendEntry> legend_of(const std::vector<Series>& series, bool lines) {
  std::vector<LegendEntry> entries;
  for (size_t i = 0; i < series.size(); ++i) {
    entries.push_back({series[i].name, series_color(i), i, lines, series[i].markers, series[i].dashed ? kDashes : ""});
  }
  return entries;
}

double legend_height(const std::vector<LegendEntry>& entries) {
  SvgCanvas scratch(kWidth, 1.0, "");
  return draw_legend(&scratch, entries, kLeft, 0.0, kWidth - kRight);
}

Range y_range(const std::vector<Series>& series, const std::vector<Reference>& references) {
  Range range;
  for (const Series& one : series) {
    for (const double value : one.y) range.cover(value);
  }
  for (const Reference& reference : references) range.cover(reference.y);
  return range;
}

}  // namespace

std::string draw_lines(const LinePlot& plot) {
  const std::vector<LegendEntry> legend = legend_of(plot.series, true);
  const double right = plot_right(plot.references);
  const double top = kTitle + 18.0 + legend_height(legend);
  const double height = top + kPlotHeight + kBottom;
  SvgCanvas canvas(kWidth, height, plot.title);
  canvas.words(kLeft, kTitle, plot.title, TextStyle{15.0, "start", "#1b1f24", true});
  draw_legend(&canvas, legend, kLeft, kTitle + 20.0, kWidth - kRight);

  Range x_values, y_values = y_range(plot.series, plot.references);
  for (const Series& one : plot.series) {
    for (const double value : one.x) x_values.cover(value);
  }
  if (plot.from_zero) y_values.cover(0.0);
  const std::vector<double> y_ticks =
      plot.log_y ? power_ticks(y_values.low, y_values.high) : round_ticks(y_values.low, y_values.high, 6);
  if (!plot.log_x && x_values.low < kNearZero * x_values.high) x_values.low = 0.0;
  std::vector<double> x_ticks = plot.x_ticks.empty() ? plot.series.front().x : plot.x_ticks;
  if (!plot.log_x) x_ticks = round_ticks(x_values.low, x_values.high, 8);
  const Scale x{x_values.low, x_values.high, kLeft + 14.0, right - 14.0, plot.log_x};
  const Scale y{y_ticks.front(), y_ticks.back(), top + kPlotHeight, top, plot.log_y};

  draw_y_axis(&canvas, y, right, y_ticks, plot.y_label);
  canvas.line(kLeft, y.begin, right, y.begin, kAxis);
  for (const double tick : x_ticks) {
    if (tick < x_values.low || tick > x_values.high * (1.0 + 1e-9)) continue;
    canvas.line(x.at(tick), y.begin, x.at(tick), y.begin + 5.0, kAxis);
    canvas.words(x.at(tick), y.begin + 19.0, short_number(tick), TextStyle{11.0, "middle", "#555555"});
  }
  canvas.words((kLeft + right) / 2, y.begin + 41.0, plot.x_label, TextStyle{12.0, "middle"});
  draw_references(&canvas, y, right, plot.references);
  for (size_t i = 0; i < plot.series.size(); ++i) {
    const Series& one = plot.series[i];
    std::vector<double> xs, ys;
    for (size_t k = 0; k < one.x.size(); ++k) {
      xs.push_back(x.at(one.x[k]));
      ys.push_back(y.at(one.y[k]));
    }
    canvas.polyline(xs, ys, series_color(i), 2.0, one.dashed ? kDashes : "");
    for (size_t k = 0; k < xs.size() && one.markers; ++k) {
      canvas.marker(xs[k], ys[k], i, series_color(i),
                    one.name + ": " + short_number(one.x[k]) + ", " + host::text("%.4g", one.y[k]));
    }
  }
  return canvas.str();
}

std::string draw_columns(const ColumnPlot& plot) {
  const std::vector<LegendEntry> legend = legend_of(plot.series, false);
  const double right = plot_right(plot.references);
  const double top = kTitle + 18.0 + legend_height(legend);
  SvgCanvas canvas(kWidth, top + kPlotHeight + kBottom, plot.title);
  canvas.words(kLeft, kTitle, plot.title, TextStyle{15.0, "start", "#1b1f24", true});
  draw_legend(&canvas, legend, kLeft, kTitle + 20.0, kWidth - kRight);

  Range values = y_range(plot.series, plot.references);
  values.cover(0.0);
  const std::vector<double> ticks = round_ticks(values.low, values.high, 6);
  const Scale y{ticks.front(), ticks.back(), top + kPlotHeight, top, false};
  draw_y_axis(&canvas, y, right, ticks, plot.y_label);

  const double room = (right - kLeft) / static_cast<double>(std::max<size_t>(1, plot.categories.size()));
  const double column = 0.78 * room / static_cast<double>(std::max<size_t>(1, plot.series.size()));
  for (size_t c = 0; c < plot.categories.size(); ++c) {
    const double begin = kLeft + room * (static_cast<double>(c) + 0.11);
    for (size_t i = 0; i < plot.series.size(); ++i) {
      const double value = plot.series[i].y[c];
      const double up = y.at(std::max(0.0, value)), down = y.at(std::min(0.0, value));
      canvas.rectangle(begin + column * static_cast<double>(i), up, std::max(1.0, column - 1.0), down - up, series_color(i),
                       plot.series[i].name + ", " + plot.categories[c] + ": " + host::text("%.4g", value));
    }
    canvas.words(begin + 0.39 * room, top + kPlotHeight + 19.0, plot.categories[c], TextStyle{11.0, "middle", "#555555"});
  }
  canvas.line(kLeft, y.at(0.0), right, y.at(0.0), kAxis);
  canvas.words((kLeft + right) / 2, y.begin + 41.0, plot.x_label, TextStyle{12.0, "middle"});
  draw_references(&canvas, y, right, plot.references);
  return canvas.str();
}

}  // namespace bsm::bench
