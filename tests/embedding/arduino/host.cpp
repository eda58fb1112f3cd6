// host.cpp - runs a sketch's setup() on a computer and prints what it sends.
#include <cstdio>
#include <cstdlib>

#include "Arduino.h"

Port Serial;

void Port::begin(unsigned long) {}
void Port::print(const char* text) {
  std::fputs(text, stdout);
}
void Port::println(const char* text) {
  std::puts(text);
}
void Port::println(unsigned long value) {
  std::printf("%lu\n", value);
}
// The sketch waits when it has failed.
void delay(unsigned long) {
  std::exit(1);
}

int main() {
  setup();
  loop();
}
