// PNG chunks around filtered rows.
#include "bench/report/compact_png.h"

#include <cstdlib>
#include <string>

#include "bench/report/deflate.h"

namespace bsm::bench {
namespace {

constexpr int kFilters = 5;

uint32_t crc32(const uint8_t* bytes, size_t size) {
  uint32_t crc = 0xffffffffu;
  for (size_t i = 0; i < size; ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

void add_number(std::vector<uint8_t>* out, uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out->push_back(static_cast<uint8_t>(value >> shift));
}

void add_chunk(std::vector<uint8_t>* out, const std::string& type, const std::vector<uint8_t>& data) {
  add_number(out, static_cast<uint32_t>(data.size()));
  const size_t begin = out->size();
  out->insert(out->end(), type.begin(), type.end());
  out->insert(out->end(), data.begin(), data.end());
  add_number(out, crc32(out->data() + begin, out->size() - begin));
}

// Prediction of a byte from its left, upper and upper left neighbour.
uint8_t predict(int filter, int left, int up, int corner) {
  switch (filter) {
    case 1:
      return static_cast<uint8_t>(left);
    case 2:
      return static_cast<uint8_t>(up);
    case 3:
      return static_cast<uint8_t>((left + up) / 2);
    case 4: {
      const int estimate = left + up - corner;
      const int from_left = std::abs(estimate - left), from_up = std::abs(estimate - up);
      const int from_corner = std::abs(estimate - corner);
      if (from_left <= from_up && from_left <= from_corner) return static_cast<uint8_t>(left);
      return static_cast<uint8_t>(from_up <= from_corner ? up : corner);
    }
    default:
      return 0;
  }
}

std::vector<uint8_t> filter_row(const host::Image8& image, int32_t y, int filter) {
  const size_t size = image.row_bytes(), step = static_cast<size_t>(image.channels);
  const uint8_t* row = image.row(y);
  const uint8_t* above = y > 0 ? image.row(y - 1) : nullptr;
  std::vector<uint8_t> filtered = {static_cast<uint8_t>(filter)};
  filtered.reserve(size + 1);
  for (size_t i = 0; i < size; ++i) {
    const int left = i >= step ? row[i - step] : 0, up = above != nullptr ? above[i] : 0;
    const int corner = i >= step && above != nullptr ? above[i - step] : 0;
    filtered.push_back(static_cast<uint8_t>(row[i] - predict(filter, left, up, corner)));
  }
  return filtered;
}

// Each row takes the filter that leaves the smallest residuals, as the PNG specification suggests.
std::vector<uint8_t> filter_rows(const host::Image8& image) {
  std::vector<uint8_t> rows;
  for (int32_t y = 0; y < image.height; ++y) {
    std::vector<uint8_t> best;
    int64_t best_sum = 0;
    for (int filter = 0; filter < kFilters; ++filter) {
      std::vector<uint8_t> filtered = filter_row(image, y, filter);
      int64_t sum = 0;
      for (const uint8_t byte : filtered) sum += byte < 128 ? byte : 256 - byte;
      if (!best.empty() && sum >= best_sum) continue;
      best_sum = sum;
      best = std::move(filtered);
    }
    rows.insert(rows.end(), best.begin(), best.end());
  }
  return rows;
}

}  // namespace

std::vector<uint8_t> encode_compact_png(const host::Image8& image) {
  std::vector<uint8_t> out = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  std::vector<uint8_t> header;
  add_number(&header, static_cast<uint32_t>(image.width));
  add_number(&header, static_cast<uint32_t>(image.height));
  const uint8_t color_type = image.channels == 3 ? 2 : 0;
  header.insert(header.end(), {8, color_type, 0, 0, 0});
  add_chunk(&out, "IHDR", header);
  add_chunk(&out, "IDAT", zlib_compress(filter_rows(image)));
  add_chunk(&out, "IEND", {});
  return out;
}

}  // namespace bsm::bench
