// Prints tables.
#include "bench/table.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "host/text.h"

namespace bsm::bench {
namespace {

// Letters of a UTF-8 string, for alignment.
size_t letters(const std::string& word) {
  return static_cast<size_t>(
      std::count_if(word.begin(), word.end(), [](char byte) { return (static_cast<unsigned char>(byte) & 0xc0) != 0x80; }));
}

std::string csv_cell(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char letter : cell) {
    if (letter == '"') quoted += '"';
    quoted += letter;
  }
  return quoted + "\"";
}

}  // namespace

void Table::add(std::vector<std::string> cells) {
  if (cells.size() != columns.size()) throw std::logic_error("a row of " + cells.front() + " does not fit its table");
  rows.push_back(std::move(cells));
}

std::string to_text(const Table& table) {
  std::vector<std::vector<std::string>> lines = {table.columns};
  lines.insert(lines.end(), table.rows.begin(), table.rows.end());
  std::vector<size_t> widths(table.columns.size(), 0);
  for (const auto& line : lines) {
    for (size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], letters(line[i]));
  }
  std::string result;
  for (const auto& line : lines) {
    std::string row;
    for (size_t i = 0; i < line.size(); ++i) {
      const std::string padding(widths[i] - letters(line[i]), ' ');
      row += i == 0 ? line[i] + padding : "  " + padding + line[i];
    }
    row.erase(row.find_last_not_of(' ') + 1);
    result += row + "\n";
  }
  return result;
}

std::string to_csv(const Table& table) {
  std::string result;
  const auto add_line = [&result](const std::vector<std::string>& cells) {
    for (size_t i = 0; i < cells.size(); ++i) result += (i == 0 ? "" : ",") + csv_cell(cells[i]);
    result += "\n";
  };
  add_line(table.columns);
  for (const auto& row : table.rows) add_line(row);
  return result;
}

std::string fixed(double value, int digits) {
  return host::text("%.*f", digits, value);
}

}  // namespace bsm::bench
