// Gives results to every reader at once: text on standard output, CSV, SVG and PNG files in a folder, one HTML page.
#ifndef BSM_BENCH_REPORT_REPORT_H
#define BSM_BENCH_REPORT_REPORT_H

#include <string>
#include <vector>

#include "bench/report/html_page.h"
#include "bench/table.h"
#include "host/image.h"

namespace bsm::bench {

struct Picture {
  std::string name;  // of the file, without extension
  host::Image8 image;
  std::string caption;
};

// Every function throws StudyError when a file cannot be written.
class Report {
 public:
  // Makes the folder when it is missing.
  Report(const std::string& folder, const std::string& title, const std::string& subtitle);

  void headline(const Headline& headline) { page_.headline(headline); }
  void section(const std::string& id, const std::string& title, const std::string& words);
  void note(const std::string& words);
  // NAME.csv; `muted`: rows that are not measured here.
  void table(const std::string& name, const std::string& title, const Table& table,
             const std::vector<std::string>& muted = {});
  // NAME.csv alone, for tables too long to read.
  void data(const std::string& name, const Table& table);
  // NAME.svg.
  void plot(const std::string& name, const std::string& svg);
  // NAME.png each.
  void pictures(const std::vector<Picture>& pictures, bool large = false);
  void legend(const std::vector<std::string>& names, const std::vector<std::string>& colors) { page_.legend(names, colors); }
  // Writes the page; returns its path.
  std::string finish();

 private:
  void write(const std::string& name, const std::string& bytes);
  std::string folder_;
  HtmlPage page_;
};

}  // namespace bsm::bench

#endif  // BSM_BENCH_REPORT_REPORT_H
