// Bytes in order, from a stream or from memory; the readers take nothing else, so that a test can hand them any bytes.
//
// Never reads past what the caller asked for: the next image on the same stream stays whole.
#ifndef BSM_HOST_BYTE_SOURCE_H
#define BSM_HOST_BYTE_SOURCE_H

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

namespace bsm::host {

class ByteSource {
 public:
  // The stream or the bytes stay the caller's and outlive the source.
  explicit ByteSource(std::FILE* stream) : stream_(stream) {}
  ByteSource(const uint8_t* data, size_t size) : data_(data), size_(size) {}

  // Gives a byte that was put back and not read again back to the stream, for the next source on it.
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  // The next byte, or -1 at the end or after an error.
  int get();
  // Reads up to `size` bytes; fewer only at the end or after an error.
  size_t read(uint8_t* out, size_t size);
  // Makes `byte` the next byte again; for at most two bytes, the last one got first.
  void put_back(uint8_t byte) { pushed_[pushed_count_++] = byte; }
  // Why reading stopped, when that was an error of the stream rather than its end; empty otherwise.
  const std::string& error() const { return error_; }

 private:
  void note_error();

  std::FILE* stream_ = nullptr;
  const uint8_t* data_ = nullptr;
  size_t size_ = 0;
  size_t position_ = 0;
  uint8_t pushed_[2] = {};
  size_t pushed_count_ = 0;
  std::string error_;
};

// White space between the words of a header; what get() returns.
inline bool is_space(int c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

// A stream for reading: a file, or standard input for "-". Closes what it opened.
class InputFile {
 public:
  InputFile() = default;
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  bool open(const std::string& path, std::string* error);
  std::FILE* stream() const { return stream_; }

 private:
  std::FILE* stream_ = nullptr;
};

}  // namespace bsm::host

#endif  // BSM_HOST_BYTE_SOURCE_H
