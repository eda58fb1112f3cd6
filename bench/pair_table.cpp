// Reads tables of pairs.
#include "bench/pair_table.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "bench/standard_pairs.h"
#include "bsm/bsm.h"
#include "host/byte_source.h"
#include "host/options.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

using host::text;

constexpr size_t kMaxTableBytes = 1 << 20;
constexpr double kMaxScale = 65535.0;

std::string lower(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return word;
}

bool parse_scale(const std::string& word, double* scale) {
  char* end = nullptr;
  *scale = std::strtod(word.c_str(), &end);
  return !word.empty() && *end == '\0' && std::isfinite(*scale) && *scale > 0.0 && *scale <= kMaxScale;
}

}  // namespace

bool PairTable::add_text(const std::string& table, const std::string& source, std::string* error) {
  std::istringstream lines(table);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string name, disparities, scale, rest;
    if (!(words >> name)) continue;
    PairEntry entry;
    entry.name = lower(name);
    if (!(words >> disparities >> scale) || (words >> rest) ||
        !host::parse_integer(disparities, 1, BSM_MAX_DISPARITY + 1, &entry.num_disparities) ||
        !parse_scale(scale, &entry.scale)) {
      *error = source + text(":%d: expected 'name disparities scale', such as 'teddy 60 4'", number);
      return false;
    }
    if (find(entry.name) == nullptr) entries_.push_back(entry);
  }
  return true;
}

bool PairTable::add_file(const std::string& path, std::string* error) {
  host::InputFile file;
  if (!file.open(path, error)) return false;
  host::ByteSource source(file.stream());
  std::string table(kMaxTableBytes, '\0');
  table.resize(source.read(reinterpret_cast<uint8_t*>(&table[0]), table.size()));
  if (!source.error().empty()) {
    *error = path + ": " + source.error();
    return false;
  }
  if (table.size() == kMaxTableBytes) {
    *error = path + ": too long for a table of pairs";
    return false;
  }
  return add_text(table, path, error);
}

bool PairTable::add_standard(std::string* error) {
  return add_text(kStandardPairs, "pairs.txt", error);
}

size_t PairTable::position(const std::string& name) const {
  const std::string wanted = lower(name);
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const PairEntry& entry) { return entry.name == wanted; });
  return static_cast<size_t>(found - entries_.begin());
}

const PairEntry* PairTable::find(const std::string& name) const {
  const size_t at = position(name);
  return at < entries_.size() ? &entries_[at] : nullptr;
}

}  // namespace bsm::bench
