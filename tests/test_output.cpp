// test_output.cpp - what the program writes: maps as PFM, PGM and PNG read back to the same values, and files that appear
// completely or not at all.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "check.h"
#include "host/colormap.h"
#include "host/disparity_file.h"
#include "host/file_output.h"
#include "host/map_write.h"
#include "host/png_write.h"
#include "host/pnm_read.h"
#include "png_decode.h"
#include "temp_folder.h"

using namespace bsm::host;
using namespace bsm::test;

namespace {

struct TestMap {
  std::vector<int16_t> values;
  MapView view;
};

TestMap random_map(Rng& rng, int width, int height, int min_disparity, int num_disparities) {
  TestMap map;
  const int16_t invalid = static_cast<int16_t>((min_disparity - 1) * 16);
  for (int i = 0; i < width * height; ++i) {
    const int last = (min_disparity + num_disparities - 1) * 16;
    map.values.push_back(rng.one_in(6) ? invalid : static_cast<int16_t>(rng.range(min_disparity * 16, last)));
  }
  map.view = {map.values.data(), width, height, invalid, min_disparity, num_disparities};
  return map;
}

std::string string_of(const std::vector<uint8_t>& bytes) {
  return std::string(bytes.begin(), bytes.end());
}

std::vector<uint8_t> encode(const TestMap& map, MapFormat format, const MapStyle& style) {
  std::vector<uint8_t> bytes;
  std::string error;
  REQUIRE(encode_map(map.view, format, style, &bytes, &error));
  return bytes;
}

void check_round_trip(const TestMap& map, const std::string& path, MapFormat format) {
  std::string error;
  REQUIRE(write_file(path, encode(map, format, MapStyle()), &error));
  DisparityMap read;
  REQUIRE(read_result(path, 0, &read, &error) == MapRead::kDone);
  CHECK_EQ(read.width, map.view.width);
  CHECK_EQ(read.height, map.view.height);
  const DisparityMap expected = disparity_map(map.view.values, map.view.width, map.view.height, map.view.invalid);
  CHECK(read.pixels == expected.pixels);
  for (size_t i = 0; i < map.values.size(); ++i) {
    const bool valid = map.values[i] != map.view.invalid;
    CHECK(valid ? read.pixels[i] * 16 == static_cast<float>(map.values[i]) : read.pixels[i] == kNoDisparity);
  }
}

}  // namespace

TEST_CASE(maps_survive_pfm_and_16_bit_pgm) {
  Rng rng(seed());
  const TempFolder folder;
  for (int i = repeats(30); i-- > 0;) {
    const TestMap map = random_map(rng, rng.range(1, 40), rng.range(1, 40), rng.range(0, 100), rng.range(1, 200));
    check_round_trip(map, folder.path("map.pfm"), MapFormat::kPfm);
    check_round_trip(map, folder.path("map.pgm"), MapFormat::kPgm);
    const TestMap negative = random_map(rng, rng.range(1, 20), rng.range(1, 20), rng.range(-2047, -1), rng.range(1, 2000));
    check_round_trip(negative, folder.path("map.pfm"), MapFormat::kPfm);
  }
  const TestMap extreme = random_map(rng, 30, 30, -2047, 4094);
  check_round_trip(extreme, folder.path("map.pfm"), MapFormat::kPfm);
}

TEST_CASE(eight_bit_maps_keep_zero_for_invalid) {
  Rng rng(seed() + 1);
  const TempFolder folder;
  for (const double scale : {0.5, 1.0, 4.0, 8.0, 300.0}) {
    const TestMap map = random_map(rng, 31, 17, 0, 64);
    MapStyle style;
    style.scale = scale;
    std::string error;
    REQUIRE(write_file(folder.path("map.pgm"), encode(map, MapFormat::kPgm, style), &error));
    SampleImage image;
    REQUIRE(read_pnm_file(folder.path("map.pgm"), &image, &error));
    CHECK_EQ(image.max_value, 255);
    const Image8 png = decode_png(string_of(encode(map, MapFormat::kPng, style)));
    CHECK_EQ(png.channels, 1);
    REQUIRE_EQ(png.pixels.size(), map.values.size());
    for (size_t i = 0; i < map.values.size(); ++i) {
      const double exact = map.values[i] / 16.0 * scale;
      const int expected =
          map.values[i] == map.view.invalid ? 0 : static_cast<int>(std::fmin(255, std::fmax(1, std::floor(exact + 0.5))));
      CHECK_EQ(image.samples[i], expected);
      CHECK_EQ(png.pixels[i], expected);
    }
  }
}

TEST_CASE(negative_disparities_are_refused_where_they_do_not_fit) {
  Rng rng(seed() + 2);
  TestMap map = random_map(rng, 9, 9, -8, 16);
  map.values[0] = -3 * 16;
  std::vector<uint8_t> bytes;
  std::string error;
  CHECK(!encode_map(map.view, MapFormat::kPgm, MapStyle(), &bytes, &error));
  CHECK(error.find(".pfm") != std::string::npos);
  MapStyle scaled;
  scaled.scale = 4;
  CHECK(!encode_map(map.view, MapFormat::kPng, scaled, &bytes, &error));
  CHECK(!check_map_style({"a.pgm", MapFormat::kPgm}, MapStyle(), -8, &error));
  CHECK(error.find(".pfm") != std::string::npos);
  CHECK(!check_map_style({"a.png", MapFormat::kPng}, scaled, -8, &error));
  CHECK(check_map_style({"a.png", MapFormat::kPng}, MapStyle(), -8, &error));
  CHECK(check_map_style({"a.pfm", MapFormat::kPfm}, MapStyle(), -8, &error));
  CHECK(check_map_style({"a.pgm", MapFormat::kPgm}, MapStyle(), 0, &error));
  CHECK(!check_map_style({"a.pfm", MapFormat::kPfm}, scaled, 0, &error));
  MapStyle color;
  color.color = true;
  CHECK(!check_map_style({"a.pgm", MapFormat::kPgm}, color, 0, &error));
}

TEST_CASE(color_png_spreads_the_range) {
  Rng rng(seed() + 3);
  const TestMap map = random_map(rng, 200, 150, -5, 70);  // more than one deflate block
  MapStyle style;
  const Image8 gray = decode_png(string_of(encode(map, MapFormat::kPng, style)));
  style.color = true;
  const Image8 color = decode_png(string_of(encode(map, MapFormat::kPng, style)));
  CHECK_EQ(color.channels, 3);
  REQUIRE_EQ(color.pixels.size(), map.values.size() * 3);
  for (size_t i = 0; i < map.values.size(); ++i) {
    const int level = gray.pixels[i];
    const bool valid = map.values[i] != map.view.invalid;
    CHECK_EQ(level == 0, !valid);
    if (valid) CHECK_LE(std::fabs(level - (1 + (map.values[i] / 16.0 + 5) * 254 / 69)), 0.5 + 1e-9);
    const Color expected = valid ? map_color(static_cast<uint8_t>(level)) : kInvalidColor;
    CHECK(color.pixels[3 * i] == expected.r && color.pixels[3 * i + 1] == expected.g &&
          color.pixels[3 * i + 2] == expected.b);
  }
}

TEST_CASE(colors_rise_in_lightness) {
  int before = -1, distinct = 0;
  for (int level = 0; level < 256; ++level) {
    const Color c = map_color(static_cast<uint8_t>(level));
    const int luma = 76 * c.r + 150 * c.g + 29 * c.b;
    CHECK(luma + 255 >= before);  // rounding of a channel may take one level
    distinct += luma > before;
    before = luma;
  }
  CHECK(distinct > 200);
}

TEST_CASE(png_of_any_size) {
  Rng rng(seed() + 4);
  // Rows whose bytes end just before, at and after the end of a deflate block.
  const int sizes[][3] = {{1, 1, 1},     {1, 1, 3},    {65534, 1, 1}, {65535, 1, 1}, {65536, 1, 1},
                          {13106, 5, 1}, {7, 9363, 1}, {300, 200, 3}, {1, 500, 3}};
  for (const auto& size : sizes) {
    Image8 image{size[0], size[1], size[2], {}};
    image.pixels.resize(image.row_bytes() * static_cast<size_t>(size[1]));
    for (uint8_t& value : image.pixels) value = rng.byte();
    const Scope scope(text_of(size[0]) + "x" + text_of(size[1]) + "x" + text_of(size[2]));
    const Image8 decoded = decode_png(string_of(encode_png(image)));
    CHECK(decoded.width == image.width && decoded.height == image.height && decoded.channels == image.channels);
    CHECK(decoded.pixels == image.pixels);
  }
}

TEST_CASE(file_names_say_the_format) {
  MapOutput output;
  std::string error;
  CHECK(parse_map_output("a/b.PFM", &output, &error) && output.format == MapFormat::kPfm);
  CHECK(parse_map_output("-", &output, &error) && output.format == MapFormat::kPgm && output.path == "-");
  CHECK(parse_map_output("png:-", &output, &error) && output.format == MapFormat::kPng && output.path == "-");
  for (const char* name : {"", "map", "map.jpg", "pgm", "a.png/b", ".pgm.txt"}) {
    const Scope scope(name);
    CHECK(!parse_map_output(name, &output, &error));
    CHECK(error.find(".png") != std::string::npos);
  }
}

TEST_CASE(files_are_written_completely_or_not_at_all) {
  const TempFolder folder;
  const std::string path = folder.path("out.pgm");
  std::string error;
  write_bytes(path, "old");
  {
    FileOutput output;  // abandoned after some bytes
    REQUIRE(output.open(path, &error));
    REQUIRE(output.write("new contents", 12, &error));
    CHECK_EQ(read_bytes(path), "old");
  }
  CHECK_EQ(read_bytes(path), "old");
  CHECK_EQ(folder.count(), 1u);
  {
    FileOutput output;
    REQUIRE(output.open(path, &error));
    REQUIRE(output.write("new", 3, &error));
    CHECK_EQ(read_bytes(path), "old");
    REQUIRE(output.commit(&error));
    CHECK_EQ(read_bytes(path), "new");
  }
  CHECK_EQ(read_bytes(path), "new");
  CHECK_EQ(folder.count(), 1u);
  REQUIRE(write_file(folder.path("other.pgm"), {1, 2, 3}, &error));
  CHECK_EQ(read_bytes(folder.path("other.pgm")), "\x01\x02\x03");
  CHECK_EQ(folder.count(), 2u);
}

TEST_CASE(output_that_cannot_be_written_says_why) {
  const TempFolder folder;
  std::string error;
  CHECK(!can_write_to(folder.path("missing/out.pgm"), &error));
  CHECK(error.find("missing") != std::string::npos);
  CHECK(!write_file(folder.path("missing/out.pgm"), {1}, &error));
  CHECK(!can_write_to(folder.path(), &error));
  CHECK(error.find("folder") != std::string::npos);
  CHECK(!write_file(folder.path(), {1}, &error));
  CHECK(can_write_to(folder.path("out.pgm"), &error));
  CHECK_EQ(folder.count(), 0u);
  if (std::filesystem::exists("/dev/full")) {
    error.clear();
    CHECK(!write_file("/dev/full", std::vector<uint8_t>(100000), &error));
    CHECK(error.find("/dev/full") != std::string::npos);
  }
}

TEST_CASE(links_keep_pointing) {
  const TempFolder folder;
  const std::string target = folder.path("target.pgm"), link = folder.path("link.pgm");
  write_bytes(target, "old");
  std::error_code failure;
  std::filesystem::create_symlink(target, link, failure);
  if (failure) SKIP("this file system has no symbolic links");
  std::string error;
  REQUIRE(write_file(link, {'n', 'e', 'w'}, &error));
  CHECK(std::filesystem::is_symlink(link));
  CHECK_EQ(read_bytes(target), "new");
  CHECK(same_file(link, target));
  CHECK(!same_file(link, folder.path("other.pgm")));
  CHECK(same_file(folder.path("x.pgm"), folder.path("./x.pgm")));
  CHECK(!same_file("-", "-"));
}
