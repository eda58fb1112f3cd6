// png_decode.cpp - chunks, zlib wrapper, stored blocks and rows, each checked.
#include "png_decode.h"

#include "check.h"

namespace bsm::test {
namespace {

uint32_t big_endian(const std::string& bytes, size_t at) {
  uint32_t value = 0;
  for (size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<uint8_t>(bytes[i]);
  return value;
}

uint32_t crc32(const std::string& bytes) {  // bit by bit, as the specification writes it
  uint32_t crc = 0xffffffffu;
  for (const char c : bytes) {
    crc ^= static_cast<uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
  }
  return ~crc;
}

uint32_t adler32(const std::string& bytes) {
  uint32_t a = 1, b = 0;
  for (const char c : bytes) {
    a = (a + static_cast<uint8_t>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

// The raw bytes of a zlib stream of stored blocks.
std::string inflate_stored(const std::string& stream) {
  REQUIRE(stream.size() >= 6);
  const uint32_t cmf = static_cast<uint8_t>(stream[0]), flags = static_cast<uint8_t>(stream[1]);
  CHECK_EQ(cmf & 15, 8u);
  CHECK_EQ((cmf * 256 + flags) % 31, 0u);
  CHECK_EQ(flags & 32, 0u);
  std::string raw;
  size_t at = 2;
  for (bool last = false; !last;) {
    REQUIRE(at + 5 <= stream.size());
    const uint32_t head = static_cast<uint8_t>(stream[at]);
    REQUIRE_EQ(head & 0xfeu, 0u);  // stored
    last = head & 1;
    const uint32_t length =
        static_cast<uint8_t>(stream[at + 1]) | static_cast<uint32_t>(static_cast<uint8_t>(stream[at + 2])) << 8;
    const uint32_t inverse =
        static_cast<uint8_t>(stream[at + 3]) | static_cast<uint32_t>(static_cast<uint8_t>(stream[at + 4])) << 8;
    CHECK_EQ(length ^ inverse, 0xffffu);
    REQUIRE(at + 5 + length <= stream.size());
    raw += stream.substr(at + 5, length);
    at += 5 + length;
  }
  REQUIRE_EQ(at + 4, stream.size());
  CHECK_EQ(big_endian(stream, at), adler32(raw));
  return raw;
}

}  // namespace

host::Image8 decode_png(const std::string& bytes) {
  REQUIRE(bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n");
  host::Image8 image;
  std::string stream;
  bool ended = false;
  for (size_t at = 8; at < bytes.size();) {
    REQUIRE(!ended && at + 12 <= bytes.size());
    const size_t size = big_endian(bytes, at);
    REQUIRE(at + 12 + size <= bytes.size());
    const std::string type = bytes.substr(at + 4, 4), data = bytes.substr(at + 8, size);
    CHECK_EQ(big_endian(bytes, at + 8 + size), crc32(type + data));
    CHECK_EQ(at == 8, type == "IHDR");
    if (type == "IHDR") {
      REQUIRE_EQ(size, 13u);
      image.width = static_cast<int32_t>(big_endian(data, 0));
      image.height = static_cast<int32_t>(big_endian(data, 4));
      CHECK_EQ(data[8], 8);
      REQUIRE(data[9] == 0 || data[9] == 2);
      image.channels = data[9] == 2 ? 3 : 1;
      CHECK(data.substr(10) == std::string(3, '\0'));
    } else if (type == "IDAT") {
      stream += data;
    } else {
      REQUIRE(type == "IEND");
      CHECK_EQ(size, 0u);
      ended = true;
    }
    at += 12 + size;
  }
  REQUIRE(ended);
  const std::string raw = inflate_stored(stream);
  REQUIRE_EQ(raw.size(), (image.row_bytes() + 1) * static_cast<size_t>(image.height));
  for (size_t y = 0; y < static_cast<size_t>(image.height); ++y) {
    const size_t row = y * (image.row_bytes() + 1);
    REQUIRE_EQ(raw[row], 0);
    image.pixels.insert(image.pixels.end(), raw.begin() + static_cast<ptrdiff_t>(row + 1),
                        raw.begin() + static_cast<ptrdiff_t>(row + 1 + image.row_bytes()));
  }
  return image;
}

}  // namespace bsm::test
