// Writes files completely or not at all: the bytes go to a file beside the target that takes its name when all is well.
#ifndef BSM_HOST_FILE_OUTPUT_H
#define BSM_HOST_FILE_OUTPUT_H

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace bsm::host {

class FileOutput {
 public:
  FileOutput() = default;
  ~FileOutput();  // removes what was not committed
  FileOutput(const FileOutput&) = delete;
  FileOutput& operator=(const FileOutput&) = delete;

  // "-" is standard output. A symbolic link's target is replaced, not the link; what is no ordinary file (a pipe, a device)
  // is written in place.
  bool open(const std::string& path, std::string* error);
  bool write(const void* bytes, size_t size, std::string* error);
  // Flushes, closes and gives the file its name.
  bool commit(std::string* error);

 private:
  std::string path_;       // as the caller named it, for messages
  std::string target_;     // what is replaced
  std::string temporary_;  // empty when written in place
  std::FILE* stream_ = nullptr;
};

// A file in one go.
bool write_file(const std::string& path, const std::vector<uint8_t>& bytes, std::string* error);

// Says early what would stop FileOutput from opening path: a folder that is missing, or a folder of that name.
bool can_write_to(const std::string& path, std::string* error);

// True when both paths name the same file, existing or not. "-" is no file.
bool same_file(const std::string& a, const std::string& b);

}  // namespace bsm::host

#endif  // BSM_HOST_FILE_OUTPUT_H
