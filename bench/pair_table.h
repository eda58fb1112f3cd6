// Search range and ground-truth scale of pairs by name, from text files such as pairs.txt.
#ifndef BSM_BENCH_PAIR_TABLE_H
#define BSM_BENCH_PAIR_TABLE_H

#include <cstdint>
#include <string>
#include <vector>

namespace bsm::bench {

struct PairEntry {
  std::string name;             // in lower case
  int32_t num_disparities = 0;  // searched from 0 up
  double scale = 0.0;           // true disparity = value / scale
};

class PairTable {
 public:
  // Adds the entries of a text: one per line, "name disparities scale", # begins a comment. Names that are there already
  // keep their entry. `source` is what messages call the text.
  bool add_text(const std::string& text, const std::string& source, std::string* error);
  bool add_file(const std::string& path, std::string* error);
  // The table that the programs carry.
  bool add_standard(std::string* error);

  // Null when the name, in any case of letters, is not listed.
  const PairEntry* find(const std::string& name) const;
  // Place of the name in the table; the size of the table when it is not listed.
  size_t position(const std::string& name) const;

 private:
  std::vector<PairEntry> entries_;
};

}  // namespace bsm::bench

#endif  // BSM_BENCH_PAIR_TABLE_H
