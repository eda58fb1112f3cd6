// What a stretch of code costs on an emulated board: instructions and stack.
#ifndef BSM_CORTEXM_MEASURE_H
#define BSM_CORTEXM_MEASURE_H

#include <stddef.h>
#include <stdint.h>

namespace bsm::cortexm {

// Counts instructions by the system timer. Under `qemu-system-arm -icount shift=0` an instruction takes one nanosecond, and
// the timer's ticks are as many instructions as a loop of known length says. One stretch may last 2^24 ticks.
class InstructionCounter {
 public:
  InstructionCounter();  // starts the timer
  void start() { begin_ = ticks(); }
  void stop() { total_ += elapsed(); }
  uint64_t instructions() const;

 private:
  static uint32_t ticks();
  uint32_t elapsed() const;

  uint32_t begin_ = 0;
  uint64_t total_ = 0;                       // ticks
  uint32_t loop_instructions_, loop_ticks_;  // of the loop of known length
};

// Fills the free stack with a pattern; deepest_stack then tells how many bytes below the caller's frame have been written
// since.
void paint_stack();
size_t deepest_stack();

}  // namespace bsm::cortexm

#endif  // BSM_CORTEXM_MEASURE_H
