// Arduino.h - what the example sketch uses of Arduino, for compiling it and, on a computer, running it.
#ifndef BSM_TESTS_ARDUINO_H
#define BSM_TESTS_ARDUINO_H

struct Port {
  void begin(unsigned long baud);
  void print(const char* text);
  void println(const char* text);
  void println(unsigned long value);
};
extern Port Serial;

void delay(unsigned long milliseconds);
void setup();
void loop();

#endif  // BSM_TESTS_ARDUINO_H
