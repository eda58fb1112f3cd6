// Encodes PNG files (ISO/IEC 15948) with stored deflate blocks (RFC 1950, 1951).
#include "host/png_write.h"

#include <algorithm>
#include <cstddef>

namespace bsm::host {
namespace {

constexpr size_t kBlockSize = 65535;              // largest stored deflate block; each has an IDAT chunk of its own
constexpr uint32_t kCrcPolynomial = 0xedb88320u;  // CRC-32, reflected
constexpr uint32_t kAdlerModulus = 65521;         // largest prime below 2^16
constexpr size_t kAdlerRun = 4096;                // bytes between reductions; the sums stay below 2^32

struct CrcTable {
  uint32_t entry[256];
};

constexpr CrcTable make_crc_table() {
  CrcTable table{};
  for (uint32_t i = 0; i < 256; ++i) {
    uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = (value & 1u) != 0 ? (value >> 1) ^ kCrcPolynomial : value >> 1;
    table.entry[i] = value;
  }
  return table;
}

constexpr CrcTable kCrcTable = make_crc_table();

uint32_t crc32(const uint8_t* bytes, size_t size) {
  uint32_t crc = 0xffffffffu;
  for (size_t i = 0; i < size; ++i) crc = (crc >> 8) ^ kCrcTable.entry[(crc ^ bytes[i]) & 255u];
  return crc ^ 0xffffffffu;
}

uint32_t adler32(const std::vector<uint8_t>& bytes) {
  uint32_t a = 1, b = 0;
  for (size_t begin = 0; begin < bytes.size(); begin += kAdlerRun) {
    const size_t end = std::min(bytes.size(), begin + kAdlerRun);
    for (size_t i = begin; i < end; ++i) {
      a += bytes[i];
      b += a;
    }
    a %= kAdlerModulus;
    b %= kAdlerModulus;
  }
  return b << 16 | a;
}

void put_be32(std::vector<uint8_t>* out, uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out->push_back(static_cast<uint8_t>(value >> shift));
}

void put_chunk(std::vector<uint8_t>* out, const char* type, const std::vector<uint8_t>& data) {
  put_be32(out, static_cast<uint32_t>(data.size()));
  const size_t begin = out->size();
  for (int i = 0; i < 4; ++i) out->push_back(static_cast<uint8_t>(type[i]));
  out->insert(out->end(), data.begin(), data.end());
  put_be32(out, crc32(out->data() + begin, out->size() - begin));
}

// The rows as PNG filters them: filter 0 (none) before each.
std::vector<uint8_t> filtered_rows(const Image8& image) {
  std::vector<uint8_t> rows;
  rows.reserve((image.row_bytes() + 1) * static_cast<size_t>(image.height));
  for (int32_t y = 0; y < image.height; ++y) {
    rows.push_back(0);
    rows.insert(rows.end(), image.row(y), image.row(y) + image.row_bytes());
  }
  return rows;
}

}  // namespace

std::vector<uint8_t> encode_png(const Image8& image) {
  std::vector<uint8_t> out = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  std::vector<uint8_t> chunk;
  put_be32(&chunk, static_cast<uint32_t>(image.width));
  put_be32(&chunk, static_cast<uint32_t>(image.height));
  const uint8_t color_type = image.channels == 3 ? 2 : 0;
  chunk.insert(chunk.end(), {uint8_t{8}, color_type, uint8_t{0}, uint8_t{0},
                             uint8_t{0}});  // bit depth, colour type, deflate, filter set, no interlace
  put_chunk(&out, "IHDR", chunk);

  const std::vector<uint8_t> rows = filtered_rows(image);
  for (size_t begin = 0; begin < rows.size(); begin += kBlockSize) {
    const size_t size = std::min(kBlockSize, rows.size() - begin);
    const bool last = begin + size == rows.size();
    chunk.clear();
    if (begin == 0)
      chunk.insert(chunk.end(), {uint8_t{0x78}, uint8_t{0x01}});  // zlib header: deflate, 32 KB window, no dictionary
    chunk.push_back(last ? 1 : 0);
    for (const size_t length : {size, ~size}) {
      chunk.push_back(static_cast<uint8_t>(length & 255));
      chunk.push_back(static_cast<uint8_t>(length >> 8 & 255));
    }
    chunk.insert(chunk.end(), rows.begin() + static_cast<ptrdiff_t>(begin),
                 rows.begin() + static_cast<ptrdiff_t>(begin + size));
    if (last) put_be32(&chunk, adler32(rows));
    put_chunk(&out, "IDAT", chunk);
  }
  put_chunk(&out, "IEND", {});
  return out;
}

}  // namespace bsm::host
