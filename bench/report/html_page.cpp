// Writes the page.
#include "bench/report/html_page.h"

#include <algorithm>
#include <cctype>

#include "bench/report/svg_canvas.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

constexpr char kStyle[] = R"css(
:root { --ink: #1b1f24; --soft: #5b6570; --line: #e1e5ea; --back: #f5f7f9; --card: #ffffff; --accent: #0f6cbd; }
* { box-sizing: border-box; }
html { scroll-behavior: smooth; }
body { margin: 0; background: var(--back); color: var(--ink); line-height: 1.5;
  font: 15px/1.5 system-ui, "Segoe UI", Roboto, "DejaVu Sans", Helvetica, Arial, sans-serif; }
header { background: #12324f; color: #ffffff; padding: 34px 0 28px; }
header > div, main { max-width: 1200px; margin: 0 auto; padding: 0 24px; }
header h1 { margin: 0 0 6px; font-size: 28px; font-weight: 650; letter-spacing: -0.01em; }
header p { margin: 0; color: #c6d5e3; }
nav { position: sticky; top: 0; z-index: 1; background: var(--card); border-bottom: 1px solid var(--line); }
nav div { max-width: 1200px; margin: 0 auto; padding: 8px 24px; display: flex; flex-wrap: wrap; gap: 4px 18px; }
nav a { color: var(--accent); text-decoration: none; font-size: 13.5px; }
nav a:hover { text-decoration: underline; }
main { padding-top: 20px; padding-bottom: 60px; }
.headlines { display: grid; grid-template-columns: repeat(auto-fit, minmax(170px, 1fr)); gap: 14px; margin: 6px 0 8px; }
.headlines div { background: var(--card); border: 1px solid var(--line); border-radius: 8px; padding: 14px 16px; }
.headlines b { display: block; font-size: 25px; font-weight: 650; line-height: 1.2; font-variant-numeric: tabular-nums; }
.headlines span { display: block; font-size: 13px; }
.headlines small { color: var(--soft); }
section { background: var(--card); border: 1px solid var(--line); border-radius: 8px; padding: 8px 24px 22px; margin: 20px 0;
  scroll-margin-top: 60px; }
h2 { font-size: 20px; margin: 14px 0 6px; font-weight: 650; }
section p { margin: 8px 0 12px; color: #39424c; max-width: 92ch; }
.scroll { overflow-x: auto; margin: 10px 0 16px; }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 600; padding: 4px 0 6px; white-space: nowrap; }
th, td { padding: 4px 6px; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--line); }
th { color: var(--soft); font-weight: 600; border-bottom: 2px solid #cfd6dd; vertical-align: bottom; white-space: normal; }
th:first-child, td:first-child { text-align: left; padding-left: 2px; }
.words { text-align: left; }
tbody tr:hover { background: #f2f7fc; }
tr.muted td { color: var(--soft); font-style: italic; }
svg { max-width: 100%; height: auto; display: block; margin: 10px 0; border: 1px solid var(--line); border-radius: 6px; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(196px, 1fr)); gap: 14px; margin: 12px 0; }
.large { grid-template-columns: repeat(auto-fill, minmax(320px, 1fr)); }
figure { margin: 0; }
figure img { width: 100%; display: block; border-radius: 4px; background: #000; }
figcaption { font-size: 12.5px; color: var(--soft); padding-top: 4px; }
.legend { display: flex; flex-wrap: wrap; gap: 4px 18px; font-size: 13px; margin: 8px 0; }
.legend i { display: inline-block; width: 12px; height: 12px; border-radius: 2px; margin-right: 6px; vertical-align: -1px; }
@media print { nav { display: none; } section { break-inside: avoid; } }
)css";

// Whether the column holds words: a cell that begins with a letter.
bool holds_words(const Table& table, size_t column) {
  return std::any_of(table.rows.begin(), table.rows.end(), [column](const std::vector<std::string>& row) {
    return !row[column].empty() && std::isalpha(static_cast<unsigned char>(row[column][0])) != 0;
  });
}

// The markup of a caption, with no line break before a percent sign.
std::string caption_markup(const std::string& caption) {
  std::string markup = escape_markup(caption);
  for (size_t i = markup.find(" %"); i != std::string::npos; i = markup.find(" %", i)) markup.replace(i, 1, "&nbsp;");
  return markup;
}

}  // namespace

void HtmlPage::section(const std::string& id, const std::string& title) {
  sections_.push_back({id, title, ""});
}

void HtmlPage::paragraph(const std::string& words) {
  body() += "<p>" + escape_markup(words) + "</p>\n";
}

void HtmlPage::table(const std::string& title, const Table& table, const std::vector<std::string>& muted) {
  std::string html = "<div class=\"scroll\"><table>";
  if (!title.empty()) html += "<caption>" + escape_markup(title) + "</caption>";
  html += "<thead><tr>";
  std::vector<std::string> attributes;
  for (size_t column = 0; column < table.columns.size(); ++column) {
    attributes.push_back(holds_words(table, column) ? " class=\"words\"" : "");
    html += "<th" + attributes.back() + ">" + escape_markup(table.columns[column]) + "</th>";
  }
  html += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    const bool pale = std::find(muted.begin(), muted.end(), row[0]) != muted.end();
    html += pale ? "<tr class=\"muted\">" : "<tr>";
    for (size_t column = 0; column < row.size(); ++column) {
      html += "<td" + attributes[column] + ">" + escape_markup(row[column]) + "</td>";
    }
    html += "</tr>\n";
  }
  body() += html + "</tbody></table></div>\n";
}

void HtmlPage::svg(const std::string& svg) {
  body() += svg;
}

void HtmlPage::pictures(const std::vector<PagePicture>& pictures, bool large) {
  body() += large ? "<div class=\"pictures large\">\n" : "<div class=\"pictures\">\n";
  for (const PagePicture& picture : pictures) {
    const std::string caption = caption_markup(picture.caption);
    body() += "<figure><img alt=\"" + caption + host::text("\" width=\"%d\" src=\"data:image/png;base64,", picture.width) +
              base64(picture.png) + "\"><figcaption>" + caption + "</figcaption></figure>\n";
  }
  body() += "</div>\n";
}

void HtmlPage::legend(const std::vector<std::string>& names, const std::vector<std::string>& colors) {
  body() += "<div class=\"legend\">";
  for (size_t i = 0; i < names.size(); ++i) {
    body() += "<span><i style=\"background:" + colors[i] + "\"></i>" + escape_markup(names[i]) + "</span>";
  }
  body() += "</div>\n";
}

std::string HtmlPage::str() const {
  const std::string title = escape_markup(title_);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      title + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n<header><div><h1>" + title + "</h1><p>" +
      escape_markup(subtitle_) + "</p></div></header>\n<nav><div>";
  for (const Section& section : sections_)
    html += "<a href=\"#" + section.id + "\">" + escape_markup(section.title) + "</a>";
  html += "</div></nav>\n<main>\n";
  if (!headlines_.empty()) {
    html += "<div class=\"headlines\">\n";
    for (const Headline& headline : headlines_) {
      html += "<div><b>" + escape_markup(headline.value) + "</b><span>" + escape_markup(headline.label) + "</span><small>" +
              escape_markup(headline.note) + "</small></div>\n";
    }
    html += "</div>\n";
  }
  for (const Section& section : sections_) {
    html += "<section id=\"" + section.id + "\">\n<h2>" + escape_markup(section.title) + "</h2>\n" + section.body +
            "</section>\n";
  }
  return html + "</main>\n</body>\n</html>\n";
}

std::string base64(const std::vector<uint8_t>& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t three = 0;
    for (size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k) {
      out += i + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63u] : '=';
    }
  }
  return out;
}

}  // namespace bsm::bench
