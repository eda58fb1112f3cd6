// Text helpers of the program.
#include "host/text.h"

#include <cstdarg>
#include <cstdio>
#include <cstring>

namespace bsm::host {
namespace {

// Position of the dot that begins the extension of the file name, npos when there is none. A leading dot begins a hidden
// file's name, not an extension.
size_t extension_dot(const std::string& path) {
  const size_t slash = path.find_last_of("/\\");
  const size_t name = slash == std::string::npos ? 0 : slash + 1;
  const size_t dot = path.rfind('.');
  return dot == std::string::npos || dot <= name ? std::string::npos : dot;
}

}  // namespace

std::string text(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  va_list again;
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, arguments);
  va_end(arguments);
  std::string result;
  if (length > 0) {
    result.resize(static_cast<size_t>(length) + 1);
    std::vsnprintf(&result[0], result.size(), format, again);
    result.pop_back();
  }
  va_end(again);
  return result;
}

void print_error(const std::string& message) {
  std::fprintf(stderr, "bsm: %s\n", message.c_str());
}

std::string shell_word(const std::string& word) {
  static const char kPlain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-+=:,@%";
  if (!word.empty() && word[0] != '-' && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

std::string lower_extension(const std::string& path) {
  const size_t dot = extension_dot(path);
  if (dot == std::string::npos) return std::string();
  std::string extension = path.substr(dot + 1);
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

std::string with_extension(const std::string& path, const char* extension) {
  const size_t dot = extension_dot(path);
  return (dot == std::string::npos ? path : path.substr(0, dot)) + "." + extension;
}

}  // namespace bsm::host
