// Line plots, column plots, stacked bars and matrices as SVG.
#ifndef BSM_BENCH_REPORT_SVG_PLOT_H
#define BSM_BENCH_REPORT_SVG_PLOT_H

#include <string>
#include <vector>

namespace bsm::bench {

struct Series {
  std::string name;
  std::vector<double> x, y;
  bool dashed = false;
  bool markers = true;
};

// A horizontal line with its name: a published value.
struct Reference {
  std::string name;
  double y = 0.0;
};

struct LinePlot {
  std::string title, x_label, y_label;
  bool log_x = false;  // ticks at x_ticks, or at each x of the first series where there are none
  bool log_y = false;  // base 10
  bool from_zero = false;
  std::vector<Series> series = {};
  std::vector<Reference> references = {};
  std::vector<double> x_ticks = {};  // of a logarithmic axis; those outside the data are left out
};
std::string draw_lines(const LinePlot& plot);

// Groups of columns side by side.
struct ColumnPlot {
  std::string title, x_label, y_label;
  std::vector<std::string> categories;
  std::vector<Series> series;  // y: a value for each category
  std::vector<Reference> references = {};
};
std::string draw_columns(const ColumnPlot& plot);

// Horizontal bars made of parts.
struct StackPlot {
  std::string title, x_label;
  std::vector<std::string> categories;
  std::vector<std::string> parts;
  std::vector<std::string> colors;          // of the parts
  std::vector<std::vector<double>> values;  // [category][part]
};
std::string draw_stacks(const StackPlot& plot);

// Square tables of numbers side by side, cells coloured by one common scale.
struct MatrixPanel {
  std::string title;
  std::vector<std::vector<double>> values;  // [row][column]
};
struct MatrixPlot {
  std::string title, row_label, column_label;
  std::vector<std::string> names;  // of rows and of columns
  std::vector<MatrixPanel> panels;
};
std::string draw_matrices(const MatrixPlot& plot);

}  // namespace bsm::bench

#endif  // BSM_BENCH_REPORT_SVG_PLOT_H
