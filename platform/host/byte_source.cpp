// Bytes in order, from a stream or from memory.
#include "host/byte_source.h"

#include <cerrno>
#include <cstring>

#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#endif

namespace bsm::host {

ByteSource::~ByteSource() {
  if (stream_ != nullptr && pushed_count_ > 0) std::ungetc(pushed_[0], stream_);
}

void ByteSource::note_error() {
  if (std::ferror(stream_) != 0 && error_.empty()) error_ = std::strerror(errno);
}

int ByteSource::get() {
  if (pushed_count_ > 0) return pushed_[--pushed_count_];
  if (stream_ == nullptr) return position_ < size_ ? data_[position_++] : -1;
  const int c = std::getc(stream_);
  if (c == EOF) {
    note_error();
    return -1;
  }
  return c;
}

size_t ByteSource::read(uint8_t* out, size_t size) {
  size_t taken = 0;
  while (taken < size && pushed_count_ > 0) out[taken++] = pushed_[--pushed_count_];
  out += taken;
  size -= taken;
  if (size == 0) return taken;
  if (stream_ == nullptr) {
    const size_t count = size < size_ - position_ ? size : size_ - position_;
    if (count > 0) std::memcpy(out, data_ + position_, count);
    position_ += count;
    return taken + count;
  }
  const size_t count = std::fread(out, 1, size, stream_);
  if (count < size) note_error();
  return taken + count;
}

InputFile::~InputFile() {
  if (stream_ != nullptr && stream_ != stdin) std::fclose(stream_);
}

bool InputFile::open(const std::string& path, std::string* error) {
  if (path == "-") {
#if defined(_WIN32)
    _setmode(_fileno(stdin), _O_BINARY);
#endif
    stream_ = stdin;
    return true;
  }
  stream_ = std::fopen(path.c_str(), "rb");
  if (stream_ == nullptr) {
    *error = path + ": cannot open: " + std::strerror(errno);
    return false;
  }
  return true;
}

}  // namespace bsm::host
