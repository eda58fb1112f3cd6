// program_run.h - the program bsm, run in a folder with a small pair, and what every run of it has to keep.
#ifndef BSM_TESTS_PROGRAM_RUN_H
#define BSM_TESTS_PROGRAM_RUN_H

#include <cstdlib>
#include <filesystem>
#include <string>

#if !defined(_WIN32)
#include <sys/wait.h>
#endif

#include "bsm/bsm.h"
#include "check.h"
#include "images.h"
#include "matching.h"
#include "temp_folder.h"

namespace bsm::test {

inline constexpr int kWidth = 40, kHeight = 30, kDisparities = 12;
inline constexpr int kOk = 0, kData = 1, kUsage = 2;

struct Run {
  int exit_code;
  std::string out, err;
};

// A folder with a small pair in several formats, and the program run inside it.
class Workplace {
 public:
  Workplace() {
    Rng rng(seed());
    colors_ = make_pair(rng, Content::kShifted, kWidth, kHeight, 4);
    pair_ = encode(colors_, BSM_FORMAT_RGB24);
    write("left.ppm", ppm(pair_.left));
    write("right.ppm", ppm(pair_.right));
  }

  // Runs `bsm arguments` in the folder through the shell, which may hold redirections and pipes; $BSM is the program.
  Run shell(const std::string& command) const {
    const std::string full =
        "cd '" + folder_.path() + "' && BSM='" BSM_TEST_PROGRAM "' && { " + command + "; } > .out 2> .err";
    const int status = std::system(full.c_str());
    Run run{-1, read(".out"), read(".err")};
#if defined(_WIN32)
    run.exit_code = status;
#else
    if (WIFEXITED(status)) run.exit_code = WEXITSTATUS(status);
#endif
    std::filesystem::remove(folder_.path(".out"));
    std::filesystem::remove(folder_.path(".err"));
    return run;
  }
  Run bsm(const std::string& arguments) const {
    return shell("\"$BSM\" " + arguments);
  }
  // The options that keep these tests quick.
  Run match(const std::string& arguments) const {
    return bsm("match left.ppm right.ppm --preset paper --disparities " + text_of(kDisparities) + " --bits 128 " +
               arguments);
  }

  std::string read(const std::string& name) const {
    return read_bytes(folder_.path(name));
  }
  void write(const std::string& name, const std::string& bytes) const {
    write_bytes(folder_.path(name), bytes);
  }
  bool exists(const std::string& name) const {
    return std::filesystem::exists(folder_.path(name));
  }
  std::string path(const std::string& name) const {
    return folder_.path(name);
  }
  size_t files() const {
    return folder_.count();
  }

  static std::string ppm(const PixelImage& image) {
    return "P6\n" + text_of(image.width) + " " + text_of(image.height) + "\n255\n" +
           std::string(image.bytes.begin(), image.bytes.end());
  }

  bsm_config config() const {
    bsm_config c = config_for(kWidth, kHeight);
    c.num_disparities = kDisparities;
    c.bits = 128;
    return c;
  }
  const EncodedPair& pair() const {
    return pair_;
  }
  const ColorPair& colors() const {
    return colors_;
  }

 private:
  TempFolder folder_;
  ColorPair colors_;
  EncodedPair pair_;
};

inline void check_run(const Run& run, int exit_code) {
  const Scope scope("stderr '" + run.err + "'");
  CHECK_EQ(run.exit_code, exit_code);
  if (exit_code == kOk) return;
  // An error is for stderr, begins with the program's name, and nothing goes to stdout.
  CHECK_EQ(run.err.substr(0, 5), "bsm: ");
  CHECK_EQ(run.out, "");
}

}  // namespace bsm::test

#endif  // BSM_TESTS_PROGRAM_RUN_H
