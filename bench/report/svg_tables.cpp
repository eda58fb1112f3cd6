// Stacked bars and matrices.
#include <algorithm>
#include <cmath>

#include "bench/report/svg_canvas.h"
#include "bench/report/svg_plot.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

using host::text;

constexpr double kWidth = 760.0, kTitle = 26.0;
constexpr double kBarLeft = 92.0, kBarRight = 24.0, kBar = 22.0, kBarStep = 30.0;
constexpr double kLeastLabel = 26.0;  // pixels that a part needs to carry its number
constexpr double kPanelStep = 238.0, kCell = 54.0, kPanelLeft = 92.0, kPanelTop = 96.0;

int channel(double value) {
  return static_cast<int>(std::lround(std::clamp(value, 0.0, 255.0)));
}

// From pale to deep blue.
std::string heat_color(double position) {
  const double p = std::clamp(position, 0.0, 1.0);
  return text("#%02x%02x%02x", channel(240.0 - 222.0 * p), channel(246.0 - 168.0 * p), channel(252.0 - 112.0 * p));
}

}  // namespace

std::string draw_stacks(const StackPlot& plot) {
  double largest = 0.0;
  for (const auto& values : plot.values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    largest = std::max(largest, sum);
  }
  std::vector<LegendEntry> legend;
  for (size_t i = 0; i < plot.parts.size(); ++i) legend.push_back({plot.parts[i], plot.colors[i], 0, false, false, ""});
  SvgCanvas scratch(kWidth, 1.0, "");
  const double top = kTitle + 20.0 + draw_legend(&scratch, legend, kBarLeft, 0.0, kWidth - kBarRight);
  const double bottom = top + kBarStep * static_cast<double>(plot.categories.size());
  SvgCanvas canvas(kWidth, bottom + 52.0, plot.title);
  canvas.words(kBarLeft, kTitle, plot.title, TextStyle{15.0, "start", "#1b1f24", true});
  draw_legend(&canvas, legend, kBarLeft, kTitle + 20.0, kWidth - kBarRight);

  const std::vector<double> ticks = round_ticks(0.0, largest, 8);
  const double unit = (kWidth - kBarRight - kBarLeft) / ticks.back();
  for (const double tick : ticks) {
    canvas.line(kBarLeft + unit * tick, top, kBarLeft + unit * tick, bottom, "#e4e7eb");
    canvas.words(kBarLeft + unit * tick, bottom + 17.0, short_number(tick), TextStyle{11.0, "middle", "#555555"});
  }
  for (size_t c = 0; c < plot.categories.size(); ++c) {
    const double y = top + kBarStep * static_cast<double>(c) + (kBarStep - kBar) / 2;
    canvas.words(kBarLeft - 8.0, y + kBar / 2 + 4.0, plot.categories[c], TextStyle{12.0, "end"});
    double x = kBarLeft;
    for (size_t i = 0; i < plot.parts.size(); ++i) {
      const double width = unit * plot.values[c][i];
      const std::string number = text("%.1f", plot.values[c][i]);
      canvas.rectangle(x, y, width, kBar, plot.colors[i], plot.categories[c] + ", " + plot.parts[i] + ": " + number);
      if (width >= kLeastLabel) {
        canvas.words(x + width / 2, y + kBar / 2 + 4.0, number, TextStyle{10.5, "middle", "#ffffff", true});
      }
      x += width;
    }
  }
  canvas.words((kBarLeft + kWidth - kBarRight) / 2, bottom + 39.0, plot.x_label, TextStyle{12.0, "middle"});
  return canvas.str();
}

std::string draw_matrices(const MatrixPlot& plot) {
  double low = plot.panels.front().values[0][0], high = low;
  for (const MatrixPanel& panel : plot.panels) {
    for (const auto& row : panel.values) {
      for (const double value : row) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
  }
  const double size = kCell * static_cast<double>(plot.names.size());
  const double width = std::max(kWidth, kPanelLeft + kPanelStep * static_cast<double>(plot.panels.size()));
  SvgCanvas canvas(width, kPanelTop + size + 56.0, plot.title);
  canvas.words(24.0, kTitle, plot.title, TextStyle{15.0, "start", "#1b1f24", true});
  for (size_t p = 0; p < plot.panels.size(); ++p) {
    const MatrixPanel& panel = plot.panels[p];
    const double left = kPanelLeft + kPanelStep * static_cast<double>(p);
    canvas.words(left + size / 2, kPanelTop - 32.0, panel.title, TextStyle{13.0, "middle", "#1b1f24", true});
    for (size_t r = 0; r < panel.values.size(); ++r) {
      const double y = kPanelTop + kCell * static_cast<double>(r);
      canvas.words(left - 8.0, y + kCell / 2 + 4.0, plot.names[r], TextStyle{11.0, "end", "#555555"});
      canvas.words(left + kCell * (static_cast<double>(r) + 0.5), kPanelTop - 8.0, plot.names[r],
                   TextStyle{11.0, "middle", "#555555"});
      for (size_t c = 0; c < panel.values[r].size(); ++c) {
        const double value = panel.values[r][c];
        const double position = high > low ? (value - low) / (high - low) : 0.0;
        const double x = left + kCell * static_cast<double>(c);
        canvas.rectangle(x + 1.0, y + 1.0, kCell - 2.0, kCell - 2.0, heat_color(position));
        canvas.words(x + kCell / 2, y + kCell / 2 + 5.0, text("%.1f", value),
                     TextStyle{14.0, "middle", position > 0.5 ? "#ffffff" : "#1b1f24", true});
      }
    }
    canvas.words(left + size / 2, kPanelTop + size + 24.0, plot.column_label, TextStyle{11.0, "middle", "#555555"});
  }
  TextStyle style{11.0, "middle", "#555555"};
  style.turn = -90.0;
  canvas.words(18.0, kPanelTop + size / 2, plot.row_label, style);
  return canvas.str();
}

}  // namespace bsm::bench
