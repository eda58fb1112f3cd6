// Tables of results: rows of words, printed as aligned text or as CSV.
#ifndef BSM_BENCH_TABLE_H
#define BSM_BENCH_TABLE_H

#include <string>
#include <vector>

namespace bsm::bench {

struct Table {
  std::vector<std::string> columns;            // the first is the rows' name
  std::vector<std::vector<std::string>> rows;  // as many cells as columns; an empty cell has no value

  // Throws std::logic_error unless there is a cell for each column.
  void add(std::vector<std::string> cells);
};

// Aligned text: the first column to the left, the others to the right.
std::string to_text(const Table& table);

// Comma-separated, with quotes where a cell needs them.
std::string to_csv(const Table& table);

// A number with `digits` decimals.
std::string fixed(double value, int digits = 2);

}  // namespace bsm::bench

#endif  // BSM_BENCH_TABLE_H
