// Semihosting: files, messages and the exit of the computer that runs or debugs the image (an emulator, or a debugger at the
// other end of a probe). Without one of them the first call stops the core.
#ifndef BSM_CORTEXM_SEMIHOSTING_H
#define BSM_CORTEXM_SEMIHOSTING_H

#include <stddef.h>
#include <stdint.h>

namespace bsm::cortexm {

enum class OpenMode : uint32_t { kRead = 1, kWrite = 5 };  // fopen's "rb" and "wb"

// A handle, or -1 when the host cannot open the file.
int32_t host_open(const char* path, OpenMode mode);
void host_close(int32_t file);

// True when all `bytes` bytes were read or written.
bool host_read(int32_t file, void* data, size_t bytes);
bool host_write(int32_t file, const void* data, size_t bytes);

// Prints a text that ends with a zero.
void host_print(const char* text);

// The arguments that the image was started with, separated by spaces, ending with a zero; false when they do not fit.
bool host_arguments(char* text, size_t bytes);

[[noreturn]] void host_exit(int32_t code);

}  // namespace bsm::cortexm

#endif  // BSM_CORTEXM_SEMIHOSTING_H
