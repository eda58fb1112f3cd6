// Draws into SVG text: shapes and words with few attributes, and what plots share: colours, round ticks, legends.
#ifndef BSM_BENCH_REPORT_SVG_CANVAS_H
#define BSM_BENCH_REPORT_SVG_CANVAS_H

#include <string>
#include <vector>

namespace bsm::bench {

struct TextStyle {
  double size = 12.0;
  const char* anchor = "start";  // start, middle, end
  const char* color = "#333333";
  bool bold = false;
  double turn = 0.0;  // degrees
};

class SvgCanvas {
 public:
  // `title` is what screen readers say.
  SvgCanvas(double width, double height, const std::string& title);

  void line(double x1, double y1, double x2, double y2, const std::string& color, double width = 1.0,
            const std::string& dashes = "");
  void rectangle(double x, double y, double width, double height, const std::string& fill, const std::string& hint = "");
  void polyline(const std::vector<double>& x, const std::vector<double>& y, const std::string& color, double width,
                const std::string& dashes = "");
  // One of several shapes, so that series differ without colour too.
  void marker(double x, double y, size_t shape, const std::string& color, const std::string& hint = "");
  void words(double x, double y, const std::string& string, const TextStyle& style = TextStyle());

  // The whole file.
  std::string str() const;

 private:
  void add(const std::string& element) { body_ += element + "\n"; }
  double width_, height_;
  std::string title_, body_;
};

// Colours that differ for the colour-blind too; they repeat after the last.
const char* series_color(size_t index);

// The text with <, >, & and quotes made harmless in XML and HTML.
std::string escape_markup(const std::string& words);

// About how wide a text is drawn, in pixels.
double text_width(const std::string& words, double size);

// Round numbers from at most `low` to at least `high`, about `count` of them.
std::vector<double> round_ticks(double low, double high, int count);

// A number without needless decimals.
std::string short_number(double value);

struct LegendEntry {
  std::string name;
  std::string color;
  size_t shape = 0;
  bool line = false;   // a line instead of a box
  bool marker = true;  // on the line
  std::string dashes;
};

// Draws the entries from left to right, wrapped at `right`; returns y below the last row.
double draw_legend(SvgCanvas* canvas, const std::vector<LegendEntry>& entries, double left, double top, double right);

}  // namespace bsm::bench

#endif  // BSM_BENCH_REPORT_SVG_CANVAS_H
