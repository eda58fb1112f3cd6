// Semihosting calls of Arm's "Semihosting for AArch32 and AArch64", section 5, by the breakpoint that M-profile cores use.
#include "cortexm/semihosting.h"

namespace bsm::cortexm {
namespace {

enum Operation : uint32_t {
  kOpen = 0x01,
  kClose = 0x02,
  kPrint = 0x04,
  kWrite = 0x05,
  kRead = 0x06,
  kGetCommandLine = 0x15,
  kExitExtended = 0x20
};
constexpr uintptr_t kApplicationExit = 0x20026;

int32_t call(Operation operation, const void* argument) {
  register uint32_t r0 __asm__("r0") = operation;
  register const void* r1 __asm__("r1") = argument;
  __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
  return static_cast<int32_t>(r0);
}

uintptr_t word(const void* pointer) {
  return reinterpret_cast<uintptr_t>(pointer);
}

size_t length(const char* text) {
  size_t count = 0;
  while (text[count] != 0) ++count;
  return count;
}

}  // namespace

int32_t host_open(const char* path, OpenMode mode) {
  const uintptr_t block[] = {word(path), static_cast<uintptr_t>(mode), length(path)};
  return call(kOpen, block);
}

void host_close(int32_t file) {
  const uintptr_t block[] = {static_cast<uintptr_t>(file)};
  call(kClose, block);
}

// Both calls return how many bytes were left over.
bool host_read(int32_t file, void* data, size_t bytes) {
  const uintptr_t block[] = {static_cast<uintptr_t>(file), word(data), bytes};
  return call(kRead, block) == 0;
}

bool host_write(int32_t file, const void* data, size_t bytes) {
  const uintptr_t block[] = {static_cast<uintptr_t>(file), word(data), bytes};
  return call(kWrite, block) == 0;
}

void host_print(const char* text) {
  call(kPrint, text);
}

bool host_arguments(char* text, size_t bytes) {
  uintptr_t block[] = {word(text), bytes};
  return call(kGetCommandLine, block) == 0;
}

void host_exit(int32_t code) {
  const uintptr_t block[] = {kApplicationExit, static_cast<uintptr_t>(code)};
  for (;;) call(kExitExtended, block);
}

}  // namespace bsm::cortexm
