// What an image asks of the computer that runs it (platform/cortexm/semihosting.h), here of run_image.js.
#include "cortexm/semihosting.h"

#define IMPORT(name) __attribute__((import_module("host"), import_name(#name)))

extern "C" {
IMPORT(print) void import_print(const char* text);
IMPORT(arguments) int32_t import_arguments(char* text, size_t bytes);
[[noreturn]] IMPORT(exit) void import_exit(int32_t code);
}

int main();  // of the image: without a system a function like others

extern "C" __attribute__((export_name("run"))) void run() {
  main();
}

namespace bsm::cortexm {

void host_print(const char* text) {
  import_print(text);
}

bool host_arguments(char* text, size_t bytes) {
  return import_arguments(text, bytes) != 0;
}

void host_exit(int32_t code) {
  import_exit(code);
}

}  // namespace bsm::cortexm
