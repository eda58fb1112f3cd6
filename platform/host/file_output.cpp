// Writes files completely or not at all.
#include "host/file_output.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "host/text.h"

#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#endif

namespace bsm::host {
namespace {

namespace fs = std::filesystem;

constexpr int kTemporaryNames = 100;  // names tried before giving up

}  // namespace

FileOutput::~FileOutput() {
  if (stream_ != nullptr && stream_ != stdout) std::fclose(stream_);
  if (!temporary_.empty()) std::remove(temporary_.c_str());
}

bool FileOutput::open(const std::string& path, std::string* error) {
  path_ = path == "-" ? "standard output" : path;
  if (path == "-") {
#if defined(_WIN32)
    _setmode(_fileno(stdout), _O_BINARY);
#endif
    stream_ = stdout;
    return true;
  }
  if (!can_write_to(path, error)) return false;
  std::error_code ignored;
  const fs::path resolved = fs::weakly_canonical(path, ignored);
  target_ = resolved.empty() ? path : resolved.string();
  const fs::file_status status = fs::status(target_, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    stream_ = std::fopen(target_.c_str(), "wb");
  } else {
    for (int i = 0; stream_ == nullptr && i < kTemporaryNames; ++i) {
      const std::string name = target_ + text(".part%d", i);
      errno = 0;
      stream_ = std::fopen(name.c_str(), "wbx");  // x: fails when the file exists
      if (stream_ != nullptr) temporary_ = name;
      if (stream_ == nullptr && errno != EEXIST) break;
    }
  }
  if (stream_ == nullptr) {
    *error = path + ": cannot write: " + std::strerror(errno);
    return false;
  }
  return true;
}

bool FileOutput::write(const void* bytes, size_t size, std::string* error) {
  if (size == 0 || std::fwrite(bytes, 1, size, stream_) == size) return true;
  *error = path_ + ": cannot write: " + std::strerror(errno);
  return false;
}

bool FileOutput::commit(std::string* error) {
  bool good = std::fflush(stream_) == 0 && std::ferror(stream_) == 0;
  if (stream_ != stdout && std::fclose(stream_) != 0) good = false;
  stream_ = nullptr;
  if (!good) {
    *error = path_ + ": cannot write: " + std::strerror(errno);
    return false;
  }
  if (temporary_.empty()) return true;
  std::error_code failure;
  fs::rename(temporary_, target_, failure);
  if (failure) {
    *error = path_ + ": cannot write: " + failure.message();
    return false;
  }
  temporary_.clear();
  return true;
}

bool write_file(const std::string& path, const std::vector<uint8_t>& bytes, std::string* error) {
  FileOutput output;
  return output.open(path, error) && output.write(bytes.data(), bytes.size(), error) && output.commit(error);
}

bool can_write_to(const std::string& path, std::string* error) {
  if (path == "-") return true;
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    *error = path + ": is a folder; name a file";
    return false;
  }
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, ignored)) {
    *error = path + ": the folder " + folder.string() + " does not exist; make it first";
    return false;
  }
  return true;
}

bool same_file(const std::string& a, const std::string& b) {
  if (a == "-" || b == "-") return false;
  std::error_code failure;
  if (fs::equivalent(a, b, failure) && !failure) return true;
  const fs::path a_path = fs::weakly_canonical(fs::absolute(a, failure), failure);
  const fs::path b_path = fs::weakly_canonical(fs::absolute(b, failure), failure);
  return !a_path.empty() && a_path == b_path;
}

}  // namespace bsm::host
