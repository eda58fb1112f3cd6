// LZ77 over hash chains, then Huffman codes made for each block.
#include "bench/report/deflate.h"

#include <algorithm>
#include <cstddef>
#include <queue>
#include <utility>

namespace bsm::bench {
namespace {

constexpr size_t kWindow = 32768;
constexpr size_t kMinMatch = 3, kMaxMatch = 258;
constexpr int kChainSteps = 48;           // earlier places that are compared at most
constexpr size_t kBlockTokens = 1 << 16;  // tokens that share one pair of codes
constexpr int kMaxCodeBits = 15, kMaxLengthCodeBits = 7;
constexpr size_t kLiteralCodes = 286, kDistanceCodes = 30, kLengthCodes = 19;
constexpr size_t kEndOfBlock = 256;

constexpr uint16_t kLengthBase[29] = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                      31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
constexpr uint8_t kLengthExtra[29] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
constexpr uint16_t kDistanceBase[30] = {1,    2,    3,    4,    5,    7,    9,    13,    17,    25,
                                        33,   49,   65,   97,   129,  193,  257,  385,   513,   769,
                                        1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
constexpr uint8_t kDistanceExtra[30] = {0, 0, 0, 0, 1, 1, 2, 2,  3,  3,  4,  4,  5,  5,  6,
                                        6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13};
constexpr uint8_t kLengthCodeOrder[kLengthCodes] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};

struct Token {
  uint16_t distance = 0;  // 0: a literal
  uint16_t length = 0;    // or the literal's byte
};

struct Code {
  std::vector<uint8_t> bits;
  std::vector<uint16_t> words;  // first bit of the code lowest
};

class BitWriter {
 public:
  void put(uint32_t value, int count) {
    hold_ |= static_cast<uint64_t>(value) << held_;
    held_ += count;
    for (; held_ >= 8; held_ -= 8, hold_ >>= 8) bytes_.push_back(static_cast<uint8_t>(hold_));
  }
  void put_symbol(const Code& code, size_t symbol) { put(code.words[symbol], code.bits[symbol]); }
  void align() {
    if (held_ > 0) put(0, 8 - held_);
  }
  std::vector<uint8_t>& bytes() { return bytes_; }

 private:
  std::vector<uint8_t> bytes_;
  uint64_t hold_ = 0;
  int held_ = 0;
};

template <size_t size, typename Value>
size_t last_not_above(const Value (&bases)[size], size_t value) {
  return static_cast<size_t>(std::upper_bound(bases, bases + size, value) - bases) - 1;
}

// Code lengths of a Huffman tree; symbols that do not occur get none.
std::vector<uint8_t> tree_depths(const std::vector<uint64_t>& counts) {
  struct Node {
    size_t left, right;
  };
  const size_t symbols = counts.size();
  std::vector<Node> inner;
  using Entry = std::pair<uint64_t, size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  for (size_t i = 0; i < symbols; ++i) {
    if (counts[i] > 0) queue.push({counts[i], i});
  }
  std::vector<uint8_t> depths(symbols, 0);
  if (queue.size() == 1) depths[queue.top().second] = 1;
  while (queue.size() > 1) {
    const Entry a = queue.top();
    queue.pop();
    const Entry b = queue.top();
    queue.pop();
    inner.push_back({a.second, b.second});
    queue.push({a.first + b.first, symbols + inner.size() - 1});
  }
  std::vector<uint8_t> inner_depths(inner.size(), 0);
  for (size_t i = inner.size(); i-- > 0;) {
    for (const size_t child : {inner[i].left, inner[i].right}) {
      const uint8_t depth = static_cast<uint8_t>(inner_depths[i] + 1);
      (child < symbols ? depths[child] : inner_depths[child - symbols]) = depth;
    }
  }
  return depths;
}

// Canonical code with at most `max_bits` bits: counts are flattened until the tree is shallow enough.
Code make_code(std::vector<uint64_t> counts, int max_bits) {
  Code code;
  for (;;) {
    code.bits = tree_depths(counts);
    if (*std::max_element(code.bits.begin(), code.bits.end()) <= max_bits) break;
    for (uint64_t& count : counts) count = (count + 1) / 2;
  }
  code.words.resize(counts.size());
  uint32_t next = 0;
  for (int bits = 1; bits <= max_bits; ++bits, next <<= 1) {
    for (size_t i = 0; i < counts.size(); ++i) {
      if (code.bits[i] != bits) continue;
      uint32_t reversed = 0;
      for (int b = 0; b < bits; ++b) reversed |= (next >> b & 1u) << (bits - 1 - b);
      code.words[i] = static_cast<uint16_t>(reversed);
      ++next;
    }
  }
  return code;
}

class Matcher {
 public:
  explicit Matcher(const std::vector<uint8_t>& bytes) : bytes_(bytes), heads_(kHashes, -1), chain_(bytes.size(), -1) {}

  Token best(size_t at) const {
    Token token{0, bytes_[at]};
    if (at + kMinMatch > bytes_.size()) return token;
    const size_t limit = std::min(kMaxMatch, bytes_.size() - at);
    size_t best_length = kMinMatch - 1;
    int64_t place = heads_[hash(at)];
    for (int step = 0; place >= 0 && at - static_cast<size_t>(place) <= kWindow && step < kChainSteps; ++step) {
      const size_t start = static_cast<size_t>(place);
      size_t length = 0;
      while (length < limit && bytes_[start + length] == bytes_[at + length]) ++length;
      if (length > best_length) {
        best_length = length;
        token = {static_cast<uint16_t>(at - start), static_cast<uint16_t>(length)};
        if (length == limit) break;
      }
      place = chain_[start];
    }
    return token;
  }

  void insert(size_t at) {
    if (at + kMinMatch > bytes_.size()) return;
    chain_[at] = heads_[hash(at)];
    heads_[hash(at)] = static_cast<int64_t>(at);
  }

 private:
  static constexpr size_t kHashes = 1 << 15;
  size_t hash(size_t at) const {
    const uint32_t three = bytes_[at] | uint32_t{bytes_[at + 1]} << 8 | uint32_t{bytes_[at + 2]} << 16;
    return (three * 2654435761u) >> 17;
  }
  const std::vector<uint8_t>& bytes_;
  std::vector<int64_t> heads_, chain_;
};

std::vector<Token> find_tokens(const std::vector<uint8_t>& bytes) {
  Matcher matcher(bytes);
  std::vector<Token> tokens;
  for (size_t at = 0; at < bytes.size();) {
    const Token token = matcher.best(at);
    tokens.push_back(token);
    const size_t covered = token.distance == 0 ? 1 : token.length;
    for (size_t i = 0; i < covered; ++i) matcher.insert(at + i);
    at += covered;
  }
  return tokens;
}

void put_code_lengths(const Code& literals, const Code& distances, BitWriter* out) {
  std::vector<uint64_t> counts(kLengthCodes, 0);
  std::vector<uint8_t> lengths(literals.bits.begin(), literals.bits.end());
  lengths.insert(lengths.end(), distances.bits.begin(), distances.bits.end());
  for (const uint8_t length : lengths) ++counts[length];
  const Code code = make_code(counts, kMaxLengthCodeBits);
  out->put(static_cast<uint32_t>(kLiteralCodes - 257), 5);
  out->put(static_cast<uint32_t>(kDistanceCodes - 1), 5);
  out->put(static_cast<uint32_t>(kLengthCodes - 4), 4);
  for (const uint8_t symbol : kLengthCodeOrder) out->put(code.bits[symbol], 3);
  for (const uint8_t length : lengths) out->put_symbol(code, length);
}

void put_block(const Token* tokens, size_t count, bool last, BitWriter* out) {
  std::vector<uint64_t> literal_counts(kLiteralCodes, 0), distance_counts(kDistanceCodes, 0);
  for (size_t i = 0; i < count; ++i) {
    const Token token = tokens[i];
    if (token.distance == 0) {
      ++literal_counts[token.length];
    } else {
      ++literal_counts[257 + last_not_above(kLengthBase, token.length)];
      ++distance_counts[last_not_above(kDistanceBase, token.distance)];
    }
  }
  literal_counts[kEndOfBlock] = 1;
  // Two distances at least: a code of one word would be incomplete.
  distance_counts[0] += 1;
  distance_counts[1] += 1;
  const Code literals = make_code(literal_counts, kMaxCodeBits), distances = make_code(distance_counts, kMaxCodeBits);
  out->put(last ? 1 : 0, 1);
  out->put(2, 2);  // codes of its own
  put_code_lengths(literals, distances, out);
  for (size_t i = 0; i < count; ++i) {
    const Token token = tokens[i];
    if (token.distance == 0) {
      out->put_symbol(literals, token.length);
      continue;
    }
    const size_t length = last_not_above(kLengthBase, token.length),
                 distance = last_not_above(kDistanceBase, token.distance);
    out->put_symbol(literals, 257 + length);
    out->put(static_cast<uint32_t>(token.length - kLengthBase[length]), kLengthExtra[length]);
    out->put_symbol(distances, distance);
    out->put(static_cast<uint32_t>(token.distance - kDistanceBase[distance]), kDistanceExtra[distance]);
  }
  out->put_symbol(literals, kEndOfBlock);
}

}  // namespace

std::vector<uint8_t> zlib_compress(const std::vector<uint8_t>& bytes) {
  BitWriter out;
  out.put(0x78, 8);
  out.put(0x9c, 8);
  const std::vector<Token> tokens = find_tokens(bytes);
  size_t at = 0;
  do {
    const size_t count = std::min(kBlockTokens, tokens.size() - at);
    put_block(tokens.data() + at, count, at + count == tokens.size(), &out);
    at += count;
  } while (at < tokens.size());
  out.align();
  uint32_t a = 1, b = 0;
  for (const uint8_t byte : bytes) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  for (const uint32_t half : {b, a}) {
    out.put(half >> 8, 8);
    out.put(half & 255u, 8);
  }
  return std::move(out.bytes());
}

}  // namespace bsm::bench
