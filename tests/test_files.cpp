// test_files.cpp - the readers of PGM, PPM and PFM against good, odd, damaged and hostile files. A file is either read as it
// stands or refused with a message; the same loop of mutations runs on every machine, without a fuzzer.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "check.h"
#include "host/byte_source.h"
#include "host/disparity_file.h"
#include "host/image.h"
#include "host/pfm_read.h"
#include "host/pnm_read.h"
#include "temp_folder.h"

using namespace bsm::host;
using namespace bsm::test;

namespace {

ByteSource source_of(const std::string& bytes) {
  return ByteSource(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
}

bool read_image(const std::string& bytes, SampleImage* image, std::string* error) {
  ByteSource source = source_of(bytes);
  return read_pnm(source, "test.ppm", image, error);
}

struct GoodFile {
  std::string bytes;
  int width, height, channels, max_value;
  std::vector<uint16_t> samples;
};

using namespace std::string_literals;

std::vector<GoodFile> good_files() {
  return {
      {"P5\n2 2\n255\n\x01\x02\x03\xff"s, 2, 2, 1, 255, {1, 2, 3, 255}},
      {"P6\n1 2\n255\nabcdef"s, 1, 2, 3, 255, {'a', 'b', 'c', 'd', 'e', 'f'}},
      {"P5 3 1 255 \n\r\t"s, 3, 1, 1, 255, {'\n', '\r', '\t'}},  // one white-space character ends the header
      {"P5\n1 1\n255\n#"s, 1, 1, 1, 255, {'#'}},                 // a sample is no comment
      {"P5\n# comment\n2 # another\n1\n#\n255\n\x07\x08"s, 2, 1, 1, 255, {7, 8}},
      {"P5 # P6 9 9 9\r\n\r\n 2\t\v\f1 \n255\n\x07\x08"s, 2, 1, 1, 255, {7, 8}},
      {"P5\n2 1\n65535\n\x01\x02\xff\xfe"s, 2, 1, 1, 65535, {0x0102, 0xfffe}},  // big-endian
      {"P5\n2 1\n256\n\x01\x00\x00\xff"s, 2, 1, 1, 256, {256, 255}},
      {"P6\n1 1\n1000\n\x00\x01\x03\xe8\x00\x00"s, 1, 1, 3, 1000, {1, 1000, 0}},
      {"P5\n2 1\n1\n\x00\x01"s, 2, 1, 1, 1, {0, 1}},
      {"P2\n3 2\n15\n0 1 2\n13 14 15\n"s, 3, 2, 1, 15, {0, 1, 2, 13, 14, 15}},
      {"P2 2 1 65535 # a\n 65535 # b\n00012"s, 2, 1, 1, 65535, {65535, 12}},  // no line end after the last sample
      {"P3\n1 1\n255\n1 2 3"s, 1, 1, 3, 255, {1, 2, 3}},
      {"\n \nP2 1 1 9 7"s, 1, 1, 1, 9, {7}},  // line ends of an image that came before on the stream
      {"P5\n000002 1\n0255\n\x07\x08"s, 2, 1, 1, 255, {7, 8}},
  };
}

struct BadFile {
  std::string bytes;
  const char* message;  // part of what the user reads
};

std::vector<BadFile> bad_files() {
  return {
      {""s, "no image"},
      {"P"s, "PGM"},
      {"P5"s, "truncated"},
      {"P5\n"s, "truncated"},
      {"P5\n2"s, "truncated"},
      {"P5\n2 2\n255\nabc"s, "row 2 of 2"},
      {"P6\n2 2\n255\n"s, "row 1 of 2"},
      {"P5\n1 1\n65535\nx"s, "truncated"},
      {"P2\n2 1\n255\n7"s, "truncated"},
      {"P2\n2 1\n255\n7 256"s, "above 255"},
      {"P2\n2 1\n255\n7 -1"s, "not a number"},
      {"P2\n2 1\n255\n7x 8"s, "not a number"},
      {"P2\n2 1\n255\n99999999999999999999 1"s, "above 255"},
      {"P5\n1 1\n100\n\x65"s, "above the maximum 100"},
      {"P5\n1 1\n300\n\xff\xff"s, "above the maximum 300"},
      {"P5\n0 2\n255\n"s, "is 0"},
      {"P5\n2 0\n255\n"s, "is 0"},
      {"P5\n2 2\n0\nabcd"s, "is 0"},
      {"P5\n-2 2\n255\nabcd"s, "width is not a number"},
      {"P5\n2 +2\n255\nabcd"s, "height is not a number"},
      {"P5\n2 2\n65536\nabcd"s, "above 65535"},
      {"P5\n16385 1\n255\n"s, "width is above 16384"},
      {"P5\n1 16385\n255\n"s, "height is above 16384"},
      {"P5\n4294967297 1\n255\nx"s, "width is above 16384"},
      {"P5\n99999999999999999999999999 1\n255\nx"s, "width is above 16384"},
      {"P5\n1 18446744073709551617\n255\nx"s, "height is above 16384"},
      {"P5\n2 2 255abcd"s, "white space"},
      {"P5\n2.0 2\n255\nabcd"s, "white space"},
      {"P5\n2,2\n255\nabcd"s, "white space"},
      {"P1\n2 2\n0 1 1 0"s, "P1"},
      {"P4\n8 1\n\x55"s, "P4"},
      {"P7\nWIDTH 1\n"s, "P7"},
      {"Pf\n1 1\n-1\nabcd"s, "PFM"},
      {"PF\n1 1\n-1\nabcd"s, "PFM"},
      {"p5\n1 1\n255\nx"s, "neither a PGM nor a PPM"},
      {"\xef\xbb\xbfP5\n1 1\n255\nx"s, "neither a PGM nor a PPM"},
      {"\x89PNG\r\n\x1a\n"s, "convert"},
      {"\xff\xd8\xff\xe0"s, "convert"},
      {"GIF89a"s, "convert"},
      {"BM...."s, "convert"},
      {"II*\0"s, "convert"},
      {std::string(1, '\0'), "neither a PGM nor a PPM"},
      {"<html>"s, "neither a PGM nor a PPM"},
  };
}

bool consistent(const SampleImage& image) {
  return image.width >= 1 && image.width <= 16384 && image.height >= 1 && image.height <= 16384 &&
         (image.channels == 1 || image.channels == 3) && image.max_value >= 1 && image.max_value <= 65535 &&
         image.samples.size() ==
             static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * static_cast<size_t>(image.channels) &&
         std::all_of(image.samples.begin(), image.samples.end(), [&](uint16_t s) { return s <= image.max_value; });
}

std::string pfm_bytes(int width, int height, const char* scale, const std::vector<float>& bottom_up, bool little) {
  std::string bytes = "Pf\n" + std::to_string(width) + " " + std::to_string(height) + "\n" + scale + "\n";
  for (const float value : bottom_up) {
    uint32_t bits = 0;
    std::memcpy(&bits, &value, 4);
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(bits >> (little ? 8 * i : 24 - 8 * i) & 255));
  }
  return bytes;
}

// One random change of a file: bits, bytes, numbers, length.
std::string mutate(Rng& rng, std::string bytes) {
  const char* numbers[] = {"0", "-1", "16384", "16385", "65535", "65536", "2147483648", "4294967296", "99999999999999999999",
                           "#", " "};
  for (int changes = rng.range(1, 4); changes-- > 0;) {
    const size_t size = bytes.size();
    const size_t at = size == 0 ? 0 : static_cast<size_t>(rng.range(0, static_cast<int>(std::min<size_t>(size, 64)) - 1));
    switch (rng.range(0, 6)) {
      case 0:
        if (size > 0) bytes[at] = static_cast<char>(bytes[at] ^ (1 << rng.range(0, 7)));
        break;
      case 1:
        if (size > 0) bytes[at] = static_cast<char>(rng.byte());
        break;
      case 2:
        bytes.insert(at, 1, static_cast<char>(rng.byte()));
        break;
      case 3:
        if (size > 0) bytes.erase(at, static_cast<size_t>(rng.range(1, 3)));
        break;
      case 4:
        bytes.insert(at, numbers[rng.range(0, 10)]);
        break;
      case 5:
        bytes.resize(static_cast<size_t>(rng.range(0, static_cast<int>(size))));
        break;
      default:
        bytes += bytes.substr(at);
        break;
    }
  }
  return bytes;
}

}  // namespace

TEST_CASE(good_images_are_read_as_they_stand) {
  for (const GoodFile& file : good_files()) {
    const Scope scope("'" + file.bytes + "'");
    SampleImage image;
    std::string error;
    if (!CHECK(read_image(file.bytes, &image, &error))) {
      std::printf("      %s\n", error.c_str());
      continue;
    }
    CHECK_EQ(image.width, file.width);
    CHECK_EQ(image.height, file.height);
    CHECK_EQ(image.channels, file.channels);
    CHECK_EQ(image.max_value, file.max_value);
    CHECK(image.samples == file.samples);
  }
}

TEST_CASE(bad_images_are_refused_with_a_reason) {
  for (const BadFile& file : bad_files()) {
    const Scope scope("'" + file.bytes + "'");
    SampleImage image;
    std::string error;
    CHECK(!read_image(file.bytes, &image, &error));
    const Scope message("message '" + error + "'");
    CHECK(error.find("test.ppm") != std::string::npos);
    CHECK(error.find(file.message) != std::string::npos);
  }
}

TEST_CASE(every_truncation_is_refused) {
  for (const GoodFile& file : good_files()) {
    for (size_t size = 0; size < file.bytes.size(); ++size) {
      const std::string bytes = file.bytes.substr(0, size);
      const Scope scope("'" + bytes + "'");
      SampleImage image;
      std::string error;
      if (read_image(bytes, &image, &error)) {
        // Only a number that lost digits, the last of an ASCII file, or the line end after it is left to notice.
        CHECK((file.bytes[1] == '2' || file.bytes[1] == '3') && consistent(image) && image.width == file.width);
      } else {
        CHECK(!error.empty());
      }
    }
  }
}

TEST_CASE(memory_grows_with_the_bytes_that_arrive) {
  for (const char* header : {"P5\n16384 16384\n255\n", "P6\n16384 16384\n65535\n", "P3\n16384 16384\n65535\n"}) {
    SampleImage image;
    std::string error;
    CHECK(!read_image(header + "12 "s, &image, &error));
    CHECK_LE(image.samples.capacity(), size_t{1} << 16);
  }
  FloatImage floats;
  std::string error;
  const std::string pfm = "Pf\n16384 16384\n-1\nabcd";
  ByteSource source = source_of(pfm);
  CHECK(!read_pfm(source, "test.pfm", &floats, &error));
  CHECK_LE(floats.pixels.capacity(), size_t{1} << 16);
}

TEST_CASE(endless_headers_end) {
  for (const std::string& filler :
       {"#"s + std::string(1 << 20, 'x'), std::string(1 << 20, ' '), std::string(1 << 20, '0')}) {
    SampleImage image;
    std::string error;
    CHECK(!read_image("P5\n" + filler, &image, &error));
    CHECK(error.find("longer than") != std::string::npos);
  }
  FloatImage floats;
  for (const std::string& filler : {std::string(1 << 20, ' '), std::string(1 << 20, '1')}) {
    const std::string bytes = "Pf\n" + filler + " 1\n-1\nabcd";
    ByteSource source = source_of(bytes);
    std::string error;
    CHECK(!read_pfm(source, "test.pfm", &floats, &error));
  }
}

TEST_CASE(two_images_on_one_stream) {
  const std::string images[] = {"P5\n2 1\n255\nab", "P2\n1 1\n9\n7\n", "P6\n1 1\n255\nxyz", "P3 1 1 255 1 2 3 ",
                                "P2 1 1 9 7"};  // the next one may follow at once
  for (const std::string& first : images) {
    for (const std::string& second : images) {
      const Scope scope("'" + first + second + "'");
      const std::string bytes = first + second;
      ByteSource source = source_of(bytes);
      SampleImage a, b, c;
      std::string error;
      CHECK(read_pnm(source, "-", &a, &error));
      CHECK(read_pnm(source, "-", &b, &error));
      CHECK(!read_pnm(source, "-", &c, &error));
      SampleImage alone;
      CHECK(read_image(second, &alone, &error));
      CHECK(b.samples == alone.samples && b.width == alone.width);
    }
  }
}

TEST_CASE(mutated_images_are_read_or_refused) {
  Rng rng(seed());
  std::vector<std::string> corpus;
  for (const GoodFile& file : good_files()) corpus.push_back(file.bytes);
  for (const BadFile& file : bad_files()) corpus.push_back(file.bytes);
  int read = 0;
  const int rounds = repeats(40000);
  for (int i = 0; i < rounds; ++i) {
    const std::string bytes = mutate(rng, corpus[static_cast<size_t>(rng.range(0, static_cast<int>(corpus.size()) - 1))]);
    SampleImage image;
    std::string error;
    if (read_image(bytes, &image, &error)) {
      ++read;
      CHECK(consistent(image));
      const Image8 converted = to_image8(image);
      CHECK_EQ(converted.pixels.size(), image.samples.size());
    } else {
      CHECK(!error.empty());
    }
  }
  CHECK(read > rounds / 50 && read < rounds);  // both answers occur
}

TEST_CASE(mutated_pfm_files_are_read_or_refused) {
  Rng rng(seed() + 1);
  const std::string base = pfm_bytes(3, 2, "-1.0", {1, 2, 3, 4, 5, 6}, true);
  int read = 0;
  const int rounds = repeats(20000);
  for (int i = 0; i < rounds; ++i) {
    const std::string bytes = mutate(rng, base);
    ByteSource source = source_of(bytes);
    FloatImage image;
    std::string error;
    if (read_pfm(source, "test.pfm", &image, &error)) {
      ++read;
      CHECK_EQ(image.pixels.size(), static_cast<size_t>(image.width) * static_cast<size_t>(image.height));
    } else {
      CHECK(!error.empty());
    }
  }
  CHECK(read > rounds / 50 && read < rounds);
}

TEST_CASE(samples_become_8_bit_by_rounding) {
  for (const int max_value : {1, 2, 100, 255, 256, 1000, 4095, 65535}) {
    SampleImage image{max_value + 1, 1, 1, max_value, {}};
    for (int s = 0; s <= max_value; ++s) image.samples.push_back(static_cast<uint16_t>(s));
    const Image8 converted = to_image8(image);
    REQUIRE_EQ(converted.pixels.size(), image.samples.size());
    for (int s = 0; s <= max_value; ++s) {
      const Scope scope(text_of(s) + " of " + text_of(max_value));
      CHECK_LE(std::fabs(converted.pixels[static_cast<size_t>(s)] - s * 255.0 / max_value), 0.5);
    }
  }
}

TEST_CASE(pfm_in_both_byte_orders) {
  const float inf = std::numeric_limits<float>::infinity();
  for (const bool little : {true, false}) {
    const std::string bytes = pfm_bytes(2, 3, little ? "-1.0" : "1", {5, 6, 3, 4, inf, -2.5f}, little);
    ByteSource source = source_of(bytes);
    FloatImage image;
    std::string error;
    REQUIRE(read_pfm(source, "test.pfm", &image, &error));
    CHECK_EQ(image.width, 2);
    CHECK_EQ(image.height, 3);
    CHECK(image.pixels == std::vector<float>({inf, -2.5f, 3, 4, 5, 6}));  // from the top down
  }
}

TEST_CASE(bad_pfm_files_are_refused) {
  for (const std::string& bytes :
       {""s, "P"s, "Pf"s, "Pf\n1 1\n"s, "Pf\n1 1\n0\nabcd"s, "Pf\n1 1\nnan\nabcd"s, "Pf\n0 1\n-1\nabcd"s,
        "Pf\n-1 1\n-1\nabcd"s, "Pf\n1 16385\n-1\nabcd"s, "Pf\n99999999999 1\n-1\nabcd"s, "Pf\n1 1\n-1\nabc"s,
        "PF\n1 1\n-1\nabcdabcdabcd"s, "P5\n1 1\n255\na"s, "Pf\n1x 1\n-1\nabcd"s, "Pf\n1 1\n-1x\nabcd"s}) {
    const Scope scope("'" + bytes + "'");
    ByteSource source = source_of(bytes);
    FloatImage image;
    std::string error;
    CHECK(!read_pfm(source, "test.pfm", &image, &error));
    CHECK(error.find("test.pfm") != std::string::npos);
  }
}

TEST_CASE(results_and_truths_by_file_type) {
  const TempFolder folder;
  DisparityMap map;
  std::string error;
  write_bytes(folder.path("wide.pgm"), "P5\n3 1\n65535\n\x00\x18\xff\xff\x00\x00"s);
  REQUIRE(read_result(folder.path("wide.pgm"), 0, &map, &error) == MapRead::kDone);
  CHECK(map.pixels == std::vector<float>({1.5f, kNoDisparity, 0}));
  CHECK(read_result(folder.path("wide.pgm"), 4, &map, &error) == MapRead::kBadScale);
  write_bytes(folder.path("narrow.pgm"), "P5\n3 1\n255\n\x08\x00\x01"s);
  CHECK(read_result(folder.path("narrow.pgm"), 0, &map, &error) == MapRead::kBadScale);
  REQUIRE(read_result(folder.path("narrow.pgm"), 4, &map, &error) == MapRead::kDone);
  CHECK(map.pixels == std::vector<float>({2, kNoDisparity, 0.25f}));
  REQUIRE(read_truth(folder.path("narrow.pgm"), 8, &map, &error) == MapRead::kDone);
  CHECK(map.pixels == std::vector<float>({1, kNoDisparity, 0.125f}));
  CHECK(read_truth(folder.path("narrow.pgm"), 0, &map, &error) == MapRead::kBadScale);
  write_bytes(folder.path("color.ppm"), "P6\n1 1\n255\nabc");
  CHECK(read_result(folder.path("color.ppm"), 4, &map, &error) == MapRead::kBadFile);
  CHECK(read_result(folder.path("missing.pgm"), 4, &map, &error) == MapRead::kBadFile);
  CHECK(error.find("missing.pgm") != std::string::npos);
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  write_bytes(folder.path("map.pfm"), pfm_bytes(4, 1, "-1", {inf, -inf, nan, -3.25f}, true));
  REQUIRE(read_truth(folder.path("map.pfm"), 0, &map, &error) == MapRead::kDone);
  CHECK(map.pixels == std::vector<float>({kNoDisparity, kNoDisparity, kNoDisparity, -3.25f}));
  CHECK(read_truth(folder.path("map.pfm"), 4, &map, &error) == MapRead::kBadScale);
}
