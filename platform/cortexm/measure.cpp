// The system timer (SysTick) as a counter of instructions, and the painted stack.
#include "cortexm/measure.h"

extern "C" uint32_t stack_bottom[];  // of the linker script

namespace bsm::cortexm {
namespace {

volatile uint32_t& timer_register(uintptr_t offset) {
  return *reinterpret_cast<volatile uint32_t*>(0xe000e010 + offset);
}

constexpr uint32_t kTimerMask = 0xffffff;
constexpr uint32_t kLoops = 1000000;

// Two instructions a round.
void run_loop(uint32_t rounds) {
  __asm__ volatile(".syntax unified\n1: subs %0, %0, #1\n\tbne 1b" : "+l"(rounds) : : "cc");
}

constexpr uint32_t kPaint = 0xb5b5b5b5;
constexpr uintptr_t kOwnFrame = 64;  // what paint_stack itself may use below its caller
uint32_t* painted_end;

uintptr_t stack_pointer() {
  uintptr_t address;
  __asm__ volatile("mov %0, sp" : "=r"(address));
  return address;
}

}  // namespace

InstructionCounter::InstructionCounter() {
  timer_register(4) = kTimerMask;  // reload
  timer_register(8) = 0;           // current
  timer_register(0) = 5;           // enabled, the core's clock, no interrupt
  start();
  run_loop(kLoops);
  loop_ticks_ = elapsed();
  loop_instructions_ = 2 * kLoops;
}

// Ticks count down.
uint32_t InstructionCounter::ticks() {
  return timer_register(8);
}

uint32_t InstructionCounter::elapsed() const {
  return (begin_ - ticks()) & kTimerMask;
}

uint64_t InstructionCounter::instructions() const {
  return total_ * loop_instructions_ / loop_ticks_;
}

__attribute__((noinline)) void paint_stack() {
  painted_end = reinterpret_cast<uint32_t*>((stack_pointer() - kOwnFrame) & ~uintptr_t{3});
  for (volatile uint32_t* word = stack_bottom; word < painted_end; ++word) *word = kPaint;
}

size_t deepest_stack() {
  const uint32_t* word = stack_bottom;
  while (word < painted_end && *word == kPaint) ++word;
  return static_cast<size_t>(reinterpret_cast<uintptr_t>(painted_end) - reinterpret_cast<uintptr_t>(word)) + kOwnFrame;
}

}  // namespace bsm::cortexm
