// test_program_errors.cpp - what the program bsm refuses: exit codes, messages that name the cause, and what is left behind.
#include <filesystem>
#include <string>

#include "check.h"
#include "program_run.h"

using namespace bsm::test;

TEST_CASE(mistakes_in_the_command_line) {
  const Workplace work;
  struct Mistake {
    const char* arguments;
    const char* message;  // part of what the user reads
  };
  const Mistake mistakes[] = {
      {"mtch left.ppm right.ppm -o a.pgm", "match"},
      {"match left.ppm right.ppm", "-o"},
      {"match left.ppm -o a.pgm", "RIGHT"},
      {"match -o a.pgm", "LEFT"},
      {"match left.ppm right.ppm extra.ppm -o a.pgm", "extra.ppm"},
      {"match left.ppm right.ppm -o", "-o"},
      {"match left.ppm right.ppm -o a.pgm --bit 64", "--bits"},
      {"match left.ppm right.ppm -o a.pgm --bits 100", "--bits"},
      {"match left.ppm right.ppm -o a.pgm --bits 0", "--bits"},
      {"match left.ppm right.ppm -o a.pgm --bits 4160", "--bits"},
      {"match left.ppm right.ppm -o a.pgm --bits", "--bits"},
      {"match left.ppm right.ppm -o a.pgm --bits 64x", "--bits"},
      {"match left.ppm right.ppm -o a.pgm --bits 99999999999999999999", "--bits"},
      {"match left.ppm right.ppm -o a.pgm --disparities 0", "--disparities"},
      {"match left.ppm right.ppm -o a.pgm --disparities -4", "--disparities"},
      {"match left.ppm right.ppm -o a.pgm --disparities 4000", "--disparities"},
      {"match left.ppm right.ppm -o a.pfm --min-disparity -3000", "--min-disparity"},
      {"match left.ppm right.ppm -o a.pgm --min-disparity -1", ".pfm"},
      {"match left.ppm right.ppm -o a.png --scale 4 --min-disparity -1", ".pfm"},
      {"match left.ppm right.ppm -o a.pgm --method global", "--method"},
      {"match left.ppm right.ppm -o a.pgm --stage raw", "--stage"},
      {"match left.ppm right.ppm -o a.pgm --isa sse9", "--isa"},
      {"match left.ppm right.ppm -o a.pgm --threads 0", "--threads"},
      {"match left.ppm right.ppm -o a.pgm --threads 1000", "--threads"},
      {"match left.ppm right.ppm -o a.pgm --repeat 0", "--repeat"},
      {"match left.ppm right.ppm -o a.pgm --scale 0", "--scale"},
      {"match left.ppm right.ppm -o a.pgm --scale -2", "--scale"},
      {"match left.ppm right.ppm -o a.pgm --scale nan", "--scale"},
      {"match left.ppm right.ppm -o a.pfm --scale 4", "--scale"},
      {"match left.ppm right.ppm -o a.pgm --color", "--color"},
      {"match left.ppm right.ppm -o a.jpg", ".png"},
      {"match left.ppm right.ppm -o a", ".png"},
      {"match left.ppm right.ppm -o a.pgm --right-out b.tiff", "--right-out"},
      {"match left.ppm right.ppm -o a.pgm --right-out a.pgm", "same file"},
      {"match left.ppm right.ppm -o a.pgm --right-out ./a.pgm", "same file"},
      {"match left.ppm right.ppm -o - --json", "standard output"},
      {"match left.ppm right.ppm -o a.pgm --stream=yes", "--stream"},
      {"match left.ppm right.ppm -o a.pgm --stream --preset best", "--stream"},
      {"evaluate", "DISPARITY"},
      {"evaluate a.pfm b.pfm --threshold -1", "--threshold"},
      {"evaluate a.pfm b.pfm --what", "--what"},
      {"info --width 100", "--height"},
      {"info --width 0 --height 5", "--width"},
      {"info --width 20000 --height 5", "--width"},
      {"info extra", "extra"},
      {"demo", "DIR"},
      {"demo out --bits 7", "--bits"},
      {"--nonsense", "--help"},
  };
  for (const Mistake& mistake : mistakes) {
    const Scope scope(mistake.arguments);
    const Run run = work.bsm(mistake.arguments);
    check_run(run, kUsage);
    const Scope message("stderr '" + run.err + "'");
    CHECK(run.err.find(mistake.message) != std::string::npos);
  }
  CHECK_EQ(work.files(), 2u);  // nothing was written
}

TEST_CASE(files_that_stand_in_the_way) {
  const Workplace work;
  const std::string left = work.read("left.ppm");
  work.write("short.ppm", left.substr(0, left.size() - 1));
  work.write("small.ppm", "P6\n1 1\n255\nabc");
  work.write("picture.png", "\x89PNG\r\n\x1a\n....");
  work.write("photo.jpg", "\xff\xd8\xff\xe0....");
  work.write("text.ppm", "hello");
  std::filesystem::create_directory(work.path("folder"));
  const size_t files = work.files();
  struct Problem {
    const char* arguments;
    const char* name;     // the file that the message names
    const char* message;  // and what it says
  };
  const Problem problems[] = {
      {"match missing.ppm right.ppm -o a.pgm", "missing.ppm", ""},
      {"match left.ppm missing.ppm -o a.pgm", "missing.ppm", ""},
      {"match short.ppm right.ppm -o a.pgm", "short.ppm", "truncated"},
      {"match left.ppm small.ppm -o a.pgm", "small.ppm", "same size"},
      {"match picture.png right.ppm -o a.pgm", "picture.png", "convert picture.png picture.ppm"},
      {"match left.ppm photo.jpg -o a.pgm", "photo.jpg", "convert photo.jpg photo.ppm"},
      {"match picture.png photo.jpg -o a.pgm", "picture.png", "convert photo.jpg photo.ppm"},
      {"match photo.jpg missing.ppm -o a.pgm", "missing.ppm", "convert photo.jpg photo.ppm"},
      {"match left.ppm text.ppm -o a.pgm", "text.ppm", "neither a PGM nor a PPM"},
      {"match left.ppm folder -o a.pgm", "folder", ""},
      {"match left.ppm right.ppm -o nowhere/a.pgm", "nowhere", "folder"},
      {"match left.ppm right.ppm -o folder/../missing/a.pgm", "missing", ""},
      {"evaluate missing.pfm left.ppm --scale 4", "missing.pfm", ""},
      {"evaluate left.ppm left.ppm --scale 4", "left.ppm", "colour"},
      {"evaluate picture.png left.ppm --scale 4", "picture.png", "convert picture.png picture.pgm"},
      {"demo left.ppm", "left.ppm", "folder"},
  };
  for (const Problem& problem : problems) {
    const Scope scope(problem.arguments);
    const Run run =
        work.bsm(std::string(problem.arguments) + (problem.arguments[0] == 'm' ? " --bits 64 --disparities 4" : ""));
    check_run(run, kData);
    const Scope message("stderr '" + run.err + "'");
    CHECK(run.err.find(problem.name) != std::string::npos);
    CHECK(run.err.find(problem.message) != std::string::npos);
    CHECK_EQ(work.files(), files);
  }
  for (const char* arguments :
       {"match left.ppm right.ppm -o left.ppm", "match left.ppm right.ppm -o left.pgm --right-out ./right.ppm",
        "match left.ppm right.ppm -o folder/../left.ppm"}) {
    const Scope scope(arguments);
    CHECK(work.bsm(arguments).exit_code != kOk);
    CHECK(work.read("left.ppm") == left);
  }
}

TEST_CASE(a_failure_keeps_the_old_output) {
  const Workplace work;
  work.write("small.ppm", "P6\n1 1\n255\nabc");
  work.write("map.pgm", "old");
  check_run(work.bsm("match left.ppm small.ppm -o map.pgm"), kData);
  CHECK_EQ(work.read("map.pgm"), "old");
  // The second output cannot be written: the first is not there either.
  check_run(work.match("-o map.pgm --right-out nowhere/right.pgm"), kData);
  CHECK_EQ(work.read("map.pgm"), "old");
  check_run(work.match("-o map.pgm"), kOk);
  CHECK(work.read("map.pgm") != "old");
  CHECK_EQ(work.files(), 4u);
  if (!std::filesystem::exists("/dev/full")) return;
  const Run full = work.match("-o - > /dev/full");
  check_run(full, kData);
  CHECK(full.err.find("standard output") != std::string::npos);
  check_run(work.match("-o map.pgm --json > /dev/full"), kData);
  check_run(work.bsm("info > /dev/full"), kData);
}
