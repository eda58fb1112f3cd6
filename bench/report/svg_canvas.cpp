// Writes SVG elements.
#include "bench/report/svg_canvas.h"

#include <algorithm>
#include <cmath>

#include "host/text.h"

namespace bsm::bench {
namespace {

using host::text;

constexpr const char* kSeriesColors[] = {"#0f6cbd", "#d1491a", "#0b8a63", "#a23b8f",
                                         "#c98a00", "#4aa3c7", "#6b5b95", "#555555"};
constexpr size_t kSeriesColorCount = sizeof(kSeriesColors) / sizeof(kSeriesColors[0]);
constexpr double kMarkerRadius = 3.6;
constexpr double kLegendSize = 12.0, kLegendRow = 20.0, kLegendSwatch = 22.0;

std::string dash_attribute(const std::string& dashes) {
  return dashes.empty() ? "" : " stroke-dasharray=\"" + dashes + "\"";
}

std::string hint_element(const std::string& hint) {
  return hint.empty() ? "" : "<title>" + escape_markup(hint) + "</title>";
}

// A polygon around (x, y) with corners at the given angles, in degrees from the right.
std::string polygon(double x, double y, double radius, const std::vector<double>& angles) {
  constexpr double kRadian = 3.14159265358979 / 180.0;
  std::string points;
  for (const double angle : angles) {
    points += text("%.1f,%.1f ", x + radius * std::cos(angle * kRadian), y + radius * std::sin(angle * kRadian));
  }
  return points;
}

}  // namespace

SvgCanvas::SvgCanvas(double width, double height, const std::string& title)
    : width_(width), height_(height), title_(title) {}

void SvgCanvas::line(double x1, double y1, double x2, double y2, const std::string& color, double width,
                     const std::string& dashes) {
  add(text("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke-width=\"%g\" stroke=\"", x1, y1, x2, y2, width) +
      color + "\"" + dash_attribute(dashes) + "/>");
}

void SvgCanvas::rectangle(double x, double y, double width, double height, const std::string& fill,
                          const std::string& hint) {
  add(text("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"", x, y, width, height) + fill + "\">" +
      hint_element(hint) + "</rect>");
}

void SvgCanvas::polyline(const std::vector<double>& x, const std::vector<double>& y, const std::string& color, double width,
                         const std::string& dashes) {
  std::string points;
  for (size_t i = 0; i < x.size(); ++i) points += text("%.1f,%.1f ", x[i], y[i]);
  add("<polyline fill=\"none\" stroke-linejoin=\"round\" points=\"" + points + "\" stroke=\"" + color +
      text("\" stroke-width=\"%g\"", width) + dash_attribute(dashes) + "/>");
}

void SvgCanvas::marker(double x, double y, size_t shape, const std::string& color, const std::string& hint) {
  const std::string style = " fill=\"" + color + "\" stroke=\"#ffffff\" stroke-width=\"1\">" + hint_element(hint);
  switch (shape % 4) {
    case 0:
      add(text("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\"", x, y, kMarkerRadius) + style + "</circle>");
      break;
    case 1:
      add("<polygon points=\"" + polygon(x, y, 1.3 * kMarkerRadius, {45, 135, 225, 315}) + "\"" + style + "</polygon>");
      break;
    case 2:
      add("<polygon points=\"" + polygon(x, y, 1.4 * kMarkerRadius, {-90, 30, 150}) + "\"" + style + "</polygon>");
      break;
    default:
      add("<polygon points=\"" + polygon(x, y, 1.4 * kMarkerRadius, {0, 90, 180, 270}) + "\"" + style + "</polygon>");
  }
}

void SvgCanvas::words(double x, double y, const std::string& string, const TextStyle& style) {
  std::string element = text("<text x=\"%.1f\" y=\"%.1f\" font-size=\"%g\" text-anchor=\"%s\" fill=\"%s\"", x, y, style.size,
                             style.anchor, style.color);
  if (style.bold) element += " font-weight=\"600\"";
  if (style.turn != 0.0) element += text(" transform=\"rotate(%g %.1f %.1f)\"", style.turn, x, y);
  add(element + ">" + escape_markup(string) + "</text>");
}

std::string SvgCanvas::str() const {
  return text("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" width=\"%g\" height=\"%g\" role=\"img\" ",
              width_, height_, width_, height_) +
         "font-family=\"system-ui, 'Segoe UI', Roboto, 'DejaVu Sans', Helvetica, Arial, sans-serif\">\n<title>" +
         escape_markup(title_) + text("</title>\n<rect width=\"%g\" height=\"%g\" fill=\"#ffffff\"/>\n", width_, height_) +
         body_ + "</svg>\n";
}

const char* series_color(size_t index) {
  return kSeriesColors[index % kSeriesColorCount];
}

std::string escape_markup(const std::string& words) {
  std::string result;
  for (const char letter : words) {
    switch (letter) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += letter;
    }
  }
  return result;
}

double text_width(const std::string& words, double size) {
  double width = 0.0;
  for (const char letter : words) {
    const unsigned char byte = static_cast<unsigned char>(letter);
    if ((byte & 0xc0) == 0x80) continue;  // inside a UTF-8 sequence
    const bool narrow = letter == 'i' || letter == 'l' || letter == 'j' || letter == '.' || letter == ',' || letter == ' ' ||
                        letter == 't' || letter == 'f' || letter == 'r' || letter == '\'' || letter == '(' || letter == ')';
    const bool wide = letter == 'm' || letter == 'w' || letter == 'W' || letter == 'M' || letter == '%';
    width += narrow ? 0.36 : wide ? 0.9 : 0.6;
  }
  return width * size;
}

std::vector<double> round_ticks(double low, double high, int count) {
  if (!(high > low)) high = low + 1.0;
  const double raw = (high - low) / std::max(1, count);
  const double magnitude = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10.0 * magnitude;
  for (const double factor : {1.0, 2.0, 2.5, 5.0}) {
    if (factor * magnitude >= raw * 0.999) {
      step = factor * magnitude;
      break;
    }
  }
  std::vector<double> ticks;
  const double first = std::floor(low / step + 1e-9);
  for (double i = first;; i += 1.0) {
    ticks.push_back(i * step);
    if (ticks.back() >= high - 1e-9 * step) break;
  }
  return ticks;
}

std::string short_number(double value) {
  if (std::fabs(value) < 1e-12) return "0";
  return text("%g", std::round(value * 1e6) / 1e6);
}

double draw_legend(SvgCanvas* canvas, const std::vector<LegendEntry>& entries, double left, double top, double right) {
  double x = left, y = top;
  for (const LegendEntry& entry : entries) {
    const double width = kLegendSwatch + 6.0 + text_width(entry.name, kLegendSize) + 18.0;
    if (x > left && x + width > right) {
      x = left;
      y += kLegendRow;
    }
    if (entry.line) {
      canvas->line(x, y, x + kLegendSwatch, y, entry.color, 2.0, entry.dashes);
      if (entry.marker) canvas->marker(x + kLegendSwatch / 2, y, entry.shape, entry.color);
    } else {
      canvas->rectangle(x + 6.0, y - 6.0, 12.0, 12.0, entry.color);
    }
    canvas->words(x + kLegendSwatch + 6.0, y + 4.0, entry.name, TextStyle{kLegendSize});
    x += width;
  }
  return y + kLegendRow;
}

}  // namespace bsm::bench
