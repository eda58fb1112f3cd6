// temp_folder.h - a folder of a test's own, removed at the end, and whole files as byte strings.
#ifndef BSM_TESTS_TEMP_FOLDER_H
#define BSM_TESTS_TEMP_FOLDER_H

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "check.h"

namespace bsm::test {

class TempFolder {
 public:
  TempFolder() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
    Rng rng(static_cast<uint64_t>(now) ^ reinterpret_cast<uintptr_t>(this));
    do {
      path_ = std::filesystem::temp_directory_path() / ("bsm_test_" + std::to_string(rng.next()));
    } while (!std::filesystem::create_directory(path_));
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::string path(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }
  // Names of the files in it, so that leftovers show.
  size_t count() const {
    return static_cast<size_t>(
        std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator()));
  }

 private:
  std::filesystem::path path_;
};

inline std::string read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  REQUIRE(file.good());
  return std::string(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

inline void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  REQUIRE(file.good());
}

}  // namespace bsm::test

#endif  // BSM_TESTS_TEMP_FOLDER_H
