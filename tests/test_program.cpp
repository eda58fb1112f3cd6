// test_program.cpp - what the program bsm does for its users: maps in files and pipes, reports, evaluation, the demo.
#include <algorithm>
#include <string>
#include <vector>

#include "bsm/bsm.h"
#include "check.h"
#include "host/disparity_file.h"
#include "host/pfm_read.h"
#include "host/text.h"
#include "images.h"
#include "json_check.h"
#include "matching.h"
#include "png_decode.h"
#include "program_run.h"

using namespace bsm::test;

namespace {

std::string pgm16(const std::vector<int16_t>& map, const bsm_config& config) {
  std::string bytes = "P5\n" + text_of(config.width) + " " + text_of(config.height) + "\n65535\n";
  for (const int16_t value : map) {
    const int sample = value == bsm_invalid_disparity(&config) ? 65535 : value;
    bytes.push_back(static_cast<char>(sample >> 8));
    bytes.push_back(static_cast<char>(sample & 255));
  }
  return bytes;
}

}  // namespace

TEST_CASE(help_and_version) {
  const Workplace work;
  const Run help = work.bsm("--help");
  CHECK_EQ(help.exit_code, kOk);
  for (const char* command : {"match", "evaluate", "info", "demo"}) {
    CHECK(help.out.find(command) != std::string::npos);
    const Run run = work.bsm(std::string(command) + " --help");
    CHECK_EQ(run.exit_code, kOk);
    CHECK_EQ(run.err, "");
    CHECK(run.out.find("usage: bsm " + std::string(command)) != std::string::npos);
  }
  const Run match = work.bsm("match --help");
  for (const char* option : {"-o", "--disparities", "--min-disparity", "--bits", "--method", "--stage", "--isa", "--threads",
                             "--stream", "--right-out", "--scale", "--color", "--repeat", "--json"}) {
    const Scope scope(option);
    CHECK(match.out.find(option) != std::string::npos);
  }
  const Run evaluate = work.bsm("evaluate --help");
  for (const char* option : {"--scale", "--mask", "--threshold"}) CHECK(evaluate.out.find(option) != std::string::npos);
  const Run info = work.bsm("info --help");  // a size has no default, a range has
  CHECK(info.out.find("image width in pixels\n") != std::string::npos);
  CHECK(info.out.find("searched, in pixels [64]\n") != std::string::npos);
  CHECK_EQ(work.bsm("--version").out, std::string("bsm ") + bsm_version() + "\n");
  const Run bare = work.bsm("");
  CHECK_EQ(bare.exit_code, kUsage);
  CHECK(bare.err.find("usage") != std::string::npos);
}

TEST_CASE(map_is_the_library_s) {
  const Workplace work;
  for (const bsm_stage stage : kStages) {
    const Scope scope(stage_name(stage));
    bsm_config config = work.config();
    config.stage = stage;
    config.right_map = 1;
    const Maps expected = match_frame(config, work.pair());
    check_run(work.match("-o map.pgm --right-out right.pgm --stage " + std::string(stage_name(stage))), kOk);
    CHECK(work.read("map.pgm") == pgm16(expected.left, config));
    CHECK(work.read("right.pgm") == pgm16(expected.right, config));
    check_run(work.match("-o map.pfm --stage " + std::string(stage_name(stage))), kOk);
    bsm::host::DisparityMap map;
    std::string error;
    REQUIRE(bsm::host::read_result(work.path("map.pfm"), 0, &map, &error) == bsm::host::MapRead::kDone);
    REQUIRE_EQ(map.pixels.size(), expected.left.size());
    for (size_t i = 0; i < map.pixels.size(); ++i) {
      const bool valid = expected.left[i] != bsm_invalid_disparity(&config);
      CHECK(valid ? map.pixels[i] * 16 == static_cast<float>(expected.left[i]) : map.pixels[i] == bsm::host::kNoDisparity);
    }
  }
  CHECK_EQ(work.files(), 5u);  // the pair and three maps, nothing else
}

TEST_CASE(every_option_reaches_the_library) {
  const Workplace work;
  bsm_config config = work.config();
  config.min_disparity = 2;
  config.num_disparities = 9;
  config.bits = 192;
  check_run(work.bsm("match left.ppm right.ppm -o map.pgm --preset paper --disparities 9 --min-disparity=2 --bits 192 "
                     "--method local --isa scalar"),
            kOk);
  CHECK(work.read("map.pgm") == pgm16(match_frame(config, work.pair()).left, config));
}

TEST_CASE(isa_takes_what_kernels_are_named_after) {
  const Workplace work;
  const auto kernels_of = [&work](const std::string& isa) {
    const Run run = work.match("-o map.pgm --json --isa " + isa);
    check_run(run, kOk);
    return JsonCheck(run.out).member("kernels");
  };
  CHECK_EQ(kernels_of(best_isa(BSM_ISA_ALL)), kernels_of("auto"));
  for (const uint32_t mask : isa_masks()) {
    const std::string isa = best_isa(mask);
    const Scope scope(isa);
    CHECK(kernels_of(isa).find("descriptor_compare_" + isa) != std::string::npos);
  }
}

TEST_CASE(stream_and_threads_give_the_same_bytes) {
  const Workplace work;
  for (const char* extension : {"pfm", "pgm", "png"}) {
    for (const bsm_stage stage : kStages) {
      const std::string type(extension);
      const std::string options = std::string(" --stage ") + stage_name(stage);
      check_run(work.match("-o frame." + type + " --right-out frame_right." + type + options), kOk);
      check_run(work.match("-o rows." + type + " --right-out rows_right." + type + options + " --stream"), kOk);
      check_run(work.match("-o threads." + type + " --right-out threads_right." + type + options + " --threads 3"), kOk);
      const Scope scope(type + options);
      for (const char* other : {"rows", "threads"}) {
        CHECK(work.read("frame." + type) == work.read(std::string(other) + "." + type));
        CHECK(work.read("frame_right." + type) == work.read(std::string(other) + "_right." + type));
      }
    }
  }
}

TEST_CASE(pipes) {
  const Workplace work;
  check_run(work.match("-o file.pgm"), kOk);
  const std::string expected = work.read("file.pgm");
  const std::string options = " --preset paper --disparities 12 --bits 128 ";
  Run run = work.shell("cat left.ppm right.ppm | \"$BSM\" match - - -o -" + options);
  check_run(run, kOk);
  CHECK(run.out == expected);
  run = work.shell("cat left.ppm | \"$BSM\" match - right.ppm -o piped.pgm" + options);
  check_run(run, kOk);
  CHECK(work.read("piped.pgm") == expected);
  run = work.shell("\"$BSM\" match left.ppm - -o pgm:-" + options + "< right.ppm");
  check_run(run, kOk);
  CHECK(run.out == expected);
  // An ASCII image before a binary one, with comments.
  std::string ascii = "P3 # left\n40 30 # size\n255\n";
  for (const uint8_t value : work.pair().left.bytes) ascii += text_of(value) + "\n";
  work.write("left_ascii.ppm", ascii);
  run = work.shell("cat left_ascii.ppm right.ppm | \"$BSM\" match - - -o -" + options);
  check_run(run, kOk);
  CHECK(run.out == expected);
  // 16-bit samples that are the 8-bit ones times 257.
  std::string wide = "P6\n40 30\n65535\n";
  for (const uint8_t value : work.pair().right.bytes) wide += std::string(2, static_cast<char>(value));
  work.write("right_wide.ppm", wide);
  run = work.bsm("match left.ppm right_wide.ppm -o -" + options);
  check_run(run, kOk);
  CHECK(run.out == expected);
  for (const char* type : {"pfm", "png"}) {
    check_run(work.match(std::string("-o file.") + type), kOk);
    run = work.match(std::string("-o ") + type + ":-");
    check_run(run, kOk);
    CHECK(run.out == work.read(std::string("file.") + type));
  }
  check_run(work.shell("cat left.ppm | \"$BSM\" match - - -o piped2.pgm" + options), kData);  // one image is missing
  CHECK(!work.exists("piped2.pgm"));
}

TEST_CASE(gray_pairs) {
  const Workplace work;
  std::string files[2];
  const ColorPair gray = to_gray(work.colors());
  for (int view = 0; view < 2; ++view) {
    const PixelImage image = encode(view == 0 ? gray.left : gray.right, BSM_FORMAT_GRAY8);
    files[view] = "P5\n40 30\n255\n" + std::string(image.bytes.begin(), image.bytes.end());
  }
  work.write("left.pgm", files[0]);
  work.write("right.pgm", files[1]);
  check_run(work.bsm("match left.pgm right.pgm -o map.pgm --preset paper --disparities 12 --bits 128"), kOk);
  bsm_config config = work.config();
  config.format = BSM_FORMAT_GRAY8;
  CHECK(work.read("map.pgm") == pgm16(match_frame(config, encode(gray, BSM_FORMAT_GRAY8)).left, config));
}

TEST_CASE(pictures) {
  const Workplace work;
  check_run(work.match("-o gray.png"), kOk);
  check_run(work.match("-o color.png --color --right-out right.png"), kOk);
  const Run checked = work.match("-o scaled.pgm --scale 4 --stage checked");
  check_run(checked, kOk);
  const std::string scaled = work.read("scaled.pgm").substr(13);
  REQUIRE_EQ(scaled.size(), size_t{kWidth} * kHeight);
  const auto invalid = static_cast<double>(std::count(scaled.begin(), scaled.end(), '\0'));
  const double valid = 100.0 * (static_cast<double>(scaled.size()) - invalid) / static_cast<double>(scaled.size());
  CHECK(valid > 0 && valid < 100);
  CHECK(checked.out.find("agree on " + bsm::host::text("%.1f %%", valid)) != std::string::npos);
  const bsm::host::Image8 gray = decode_png(work.read("gray.png")), color = decode_png(work.read("color.png"));
  CHECK(gray.width == kWidth && gray.height == kHeight && gray.channels == 1);
  CHECK(color.width == kWidth && color.height == kHeight && color.channels == 3);
  CHECK_EQ(decode_png(work.read("right.png")).channels, 3);
  CHECK_EQ(work.read("scaled.pgm").substr(0, 13), "P5\n40 30\n255\n");
}

TEST_CASE(json_report) {
  const Workplace work;
  const Run run = work.match("-o map.pgm --json --repeat 3");
  check_run(run, kOk);
  const JsonCheck json(run.out);
  const Scope scope(run.out);
  REQUIRE(json.valid());
  CHECK_EQ(json.number("width"), kWidth);
  CHECK_EQ(json.number("height"), kHeight);
  CHECK_EQ(json.number("bits"), 128);
  CHECK_EQ(json.number("num_disparities"), kDisparities);
  CHECK_EQ(json.member("method"), "\"local\"");
  CHECK_EQ(json.member("stage"), "\"refined\"");
  CHECK_EQ(json.number("arena_bytes"), static_cast<double>(arena_bytes(work.config())));
  CHECK(json.number("ms_min") >= 0 && json.number("ms_min") <= json.number("ms_median"));
  CHECK(json.member("kernels").find("mask_threshold") != std::string::npos);
  // Names that JSON has to escape.
  work.write("odd \"name\\.ppm", work.read("left.ppm"));
  const Run odd = work.bsm("match 'odd \"name\\.ppm' right.ppm -o map.pgm --disparities 4 --bits 64 --json");
  check_run(odd, kOk);
  CHECK(JsonCheck(odd.out).valid());
  CHECK_EQ(JsonCheck(odd.out).member("left"), "\"odd \\\"name\\\\.ppm\"");
}

TEST_CASE(json_reader_can_refuse) {
  for (const char* text : {"", "{", "{\"a\":}", "{\"a\":1,}", "{\"a\":01}", "{\"a\":nan}", "{\"a\":1}x", "{\"a\":\"\n\"}",
                           "{a:1}", "{\"a\":1,\"a\":2}", "[1]"}) {
    const Scope scope(text);
    CHECK(!JsonCheck(text).valid());
  }
  CHECK(JsonCheck("{\"a\": [1, -2.5e3, true, null, {\"b\": \"\\u00e9\\n\"}]}").valid());
}

TEST_CASE(evaluation) {
  const Workplace work;
  // Truth 2, 2, 2, unknown, 4, 4; map 2, 3, 3.5, 9, invalid, 4 pixels.
  work.write("map.pgm", std::string("P5\n6 1\n65535\n\x00\x20\x00\x30\x00\x38\x00\x90\xff\xff\x00\x40", 25));
  work.write("truth.pgm", std::string("P5\n6 1\n255\n\x08\x08\x08\x00\x10\x10", 17));
  work.write("mask.pgm", std::string("P5\n6 1\n255\n\xff\xff\xff\xff\x80\x00", 17));
  const Run run = work.bsm("evaluate map.pgm truth.pgm --scale 4 --mask mask.pgm --json");
  check_run(run, kOk);
  const JsonCheck json(run.out);
  const Scope scope(run.out);
  REQUIRE(json.valid());
  CHECK(json.member("masks").find("\"counted\": 3") != std::string::npos);
  CHECK(json.member("masks").find("\"bad\": 1,") != std::string::npos);
  const Run table = work.bsm("evaluate map.pgm truth.pgm --scale 4 --mask mask.pgm --mask mask.pgm --threshold 0.5");
  check_run(table, kOk);
  CHECK(table.out.find("66.67") != std::string::npos);
  const Run all = work.bsm("evaluate map.pgm truth.pgm --scale 4");
  check_run(all, kOk);
  CHECK(all.out.find("40.00") != std::string::npos);          // 3.5 and the invalid one of five
  check_run(work.bsm("evaluate map.pgm truth.pgm"), kUsage);  // a PGM needs --scale
  check_run(work.bsm("evaluate map.pgm truth.pgm --scale 4 --mask left.ppm"), kData);
  work.write("other.pgm", std::string("P5\n5 1\n255\n\x08\x08\x08\x00\x10", 16));
  check_run(work.bsm("evaluate map.pgm other.pgm --scale 4"), kData);
  check_run(work.bsm("evaluate map.pgm truth.pgm --scale 4 --mask other.pgm"), kData);
  work.write("nothing.pgm", std::string("P5\n6 1\n255\n\x00\x00\x00\x00\x00\x00", 17));
  check_run(work.bsm("evaluate map.pgm truth.pgm --scale 4 --mask nothing.pgm"), kData);
}

TEST_CASE(info) {
  const Workplace work;
  const Run run = work.bsm("info --width 160 --height 120 --disparities 32 --bits 256 --preset paper");
  check_run(run, kOk);
  const Scope scope(run.out);
  bsm_config config = config_for(160, 120);
  config.num_disparities = 32;
  config.bits = 256;
  CHECK(run.out.find(text_of(arena_bytes(config)) + " bytes") != std::string::npos);
  size_t scalar = 0;
  REQUIRE_EQ(bsm_memory_required_for(&config, 0, &scalar), BSM_OK);
  CHECK(run.out.find(text_of(scalar) + " bytes") != std::string::npos);
  CHECK(run.out.find("mask_threshold_") != std::string::npos);
  CHECK(run.out.find(bsm_version()) != std::string::npos);
  check_run(work.bsm("info"), kOk);
  for (const bsm_format format : kAllFormats) {
    const std::string name = format_name(format);
    const Run one = work.bsm("info --width 40 --height 30 --format " + name);
    check_run(one, kOk);
    CHECK(one.out.find(" " + name + ",") != std::string::npos);
  }
}

TEST_CASE(demo) {
  const Workplace work;
  const Run run = work.bsm("demo 'new folder' --width 120 --height 80 --disparities 16 --bits 128");
  check_run(run, kOk);
  const Scope scope(run.out);
  for (const char* name : {"left.png", "right.png", "disparity.png", "truth.png", "error.png"}) {
    const Scope file(name);
    REQUIRE(work.exists(std::string("new folder/") + name));
    const bsm::host::Image8 picture = decode_png(work.read(std::string("new folder/") + name));
    CHECK(picture.width == 120 && picture.height == 80);
  }
  for (const char* word : {"error", "time", "memory", "new folder"}) CHECK(run.out.find(word) != std::string::npos);
  // Its views are a pair for `match`, and its truth for `evaluate`.
  check_run(work.bsm("match 'new folder/left.ppm' 'new folder/right.ppm' -o map.pfm --disparities 16 --bits 128"), kOk);
  check_run(work.bsm("evaluate map.pfm 'new folder/truth.pfm'"), kOk);
  CHECK(work.read("map.pfm") == work.read("new folder/disparity.pfm"));
}
