// Builds one HTML page that needs no other file: sections with tables, inline SVG and pictures.
#ifndef BSM_BENCH_REPORT_HTML_PAGE_H
#define BSM_BENCH_REPORT_HTML_PAGE_H

#include <cstdint>
#include <string>
#include <vector>

#include "bench/table.h"

namespace bsm::bench {

// A picture with the words under it.
struct PagePicture {
  std::vector<uint8_t> png;
  std::string caption;
  int32_t width = 0;
};

// A number that stands at the head of the page.
struct Headline {
  std::string value, label, note;
};

class HtmlPage {
 public:
  HtmlPage(const std::string& title, const std::string& subtitle) : title_(title), subtitle_(subtitle) {}

  void headline(const Headline& headline) { headlines_.push_back(headline); }
  // `id` names the section in links.
  void section(const std::string& id, const std::string& title);
  void paragraph(const std::string& words);
  // Rows whose first cell is in `muted` are pale: they are not measured here.
  void table(const std::string& title, const Table& table, const std::vector<std::string>& muted = {});
  void svg(const std::string& svg);
  // Pictures side by side as the width allows; a caption is escaped text.
  void pictures(const std::vector<PagePicture>& pictures, bool large = false);
  // Coloured boxes with names: what colours in pictures mean.
  void legend(const std::vector<std::string>& names, const std::vector<std::string>& colors);

  std::string str() const;

 private:
  struct Section {
    std::string id, title, body;
  };
  std::string& body() { return sections_.back().body; }
  std::string title_, subtitle_;
  std::vector<Headline> headlines_;
  std::vector<Section> sections_;
};

std::string base64(const std::vector<uint8_t>& bytes);

}  // namespace bsm::bench

#endif  // BSM_BENCH_REPORT_HTML_PAGE_H
