// Text helpers of the program: printf-style strings, words for error messages, shell quoting.
#ifndef BSM_HOST_TEXT_H
#define BSM_HOST_TEXT_H

#include <string>

namespace bsm::host {

#if defined(__GNUC__)
#define BSM_HOST_PRINTF(format_index, first_argument) __attribute__((format(printf, format_index, first_argument)))
#else
#define BSM_HOST_PRINTF(format_index, first_argument)
#endif

// std::string from a printf format.
std::string text(const char* format, ...) BSM_HOST_PRINTF(1, 2);

// Writes "bsm: " and the message to stderr as one line.
void print_error(const std::string& message);

// The word as a shell takes it: itself, or in single quotes when it holds anything unusual.
std::string shell_word(const std::string& word);

// What follows the last dot of the file name, in lower case and without the dot; empty when there is none.
std::string lower_extension(const std::string& path);

// The path with the extension of its file name replaced, or added when there is none.
std::string with_extension(const std::string& path, const char* extension);

}  // namespace bsm::host

#endif  // BSM_HOST_TEXT_H
