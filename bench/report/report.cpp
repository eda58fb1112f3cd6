// Writes results everywhere.
#include "bench/report/report.h"

#include <cstdio>
#include <filesystem>
#include <system_error>

#include "bench/report/compact_png.h"
#include "bench/study_error.h"
#include "host/file_output.h"

namespace bsm::bench {
namespace {

constexpr size_t kTextWidth = 110;

// The words in lines of at most kTextWidth letters.
std::string wrapped(const std::string& words) {
  std::string result;
  size_t column = 0;
  for (size_t at = 0; at < words.size();) {
    const size_t end = std::min(words.find(' ', at), words.size());
    if (column > 0 && column + 1 + end - at > kTextWidth) {
      result += '\n';
      column = 0;
    }
    if (column > 0) result += ' ', ++column;
    result += words.substr(at, end - at);
    column += end - at;
    at = end + 1;
  }
  return result;
}

}  // namespace

Report::Report(const std::string& folder, const std::string& title, const std::string& subtitle)
    : folder_(folder), page_(title, subtitle) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (!std::filesystem::is_directory(folder, failure)) throw StudyError(folder + ": cannot make this folder");
  std::printf("%s\n%s\n", title.c_str(), wrapped(subtitle).c_str());
}

void Report::write(const std::string& name, const std::string& bytes) {
  std::string error;
  if (!host::write_file((std::filesystem::path(folder_) / name).string(), std::vector<uint8_t>(bytes.begin(), bytes.end()),
                        &error)) {
    throw StudyError(error);
  }
}

void Report::section(const std::string& id, const std::string& title, const std::string& words) {
  page_.section(id, title);
  std::printf("\n\n== %s ==\n", title.c_str());
  note(words);
}

void Report::note(const std::string& words) {
  page_.paragraph(words);
  std::printf("\n%s\n", wrapped(words).c_str());
}

void Report::table(const std::string& name, const std::string& title, const Table& table,
                   const std::vector<std::string>& muted) {
  page_.table(title, table, muted);
  if (!title.empty()) std::printf("\n%s\n", title.c_str());
  std::printf("\n%s", to_text(table).c_str());
  std::fflush(stdout);
  data(name, table);
}

void Report::data(const std::string& name, const Table& table) {
  write(name + ".csv", to_csv(table));
}

void Report::plot(const std::string& name, const std::string& svg) {
  page_.svg(svg);
  write(name + ".svg", svg);
}

void Report::pictures(const std::vector<Picture>& pictures, bool large) {
  std::vector<PagePicture> shown;
  for (const Picture& picture : pictures) {
    shown.push_back({encode_compact_png(picture.image), picture.caption, picture.image.width});
    const std::vector<uint8_t>& png = shown.back().png;
    write(picture.name + ".png", std::string(png.begin(), png.end()));
  }
  page_.pictures(shown, large);
}

std::string Report::finish() {
  write("index.html", page_.str());
  return (std::filesystem::path(folder_) / "index.html").string();
}

}  // namespace bsm::bench
