// The trials of test_kernels as an image for a microcontroller: every kernel of the build writes the same bytes as scalar,
// and nothing around them; the best ones are chosen. Exits with 1 when something differs.
//
// Arguments (by semihosting): isa=NAME, the instruction set that all kernels beside the scalar ones have to be of; seed=N,
// another start of the random numbers.
#include <stddef.h>
#include <stdint.h>

#include "cortexm/semihosting.h"
#include "cortexm/text.h"
#include "kernel_cases.h"
#include "platform/cpu.h"
#include "rng.h"
#include "yard.h"

using namespace bsm;
using namespace bsm::cortexm;
using namespace bsm::test;

extern "C" {
// What abstract classes refer to.
[[noreturn]] void __cxa_pure_virtual() {
  host_exit(1);
}
[[noreturn]] void HardFault_Handler() {
  host_print(": hard fault\n");
  host_exit(1);
}
}

namespace {

constexpr size_t kFence = 64;
constexpr uint8_t kFenceByte = 0xa7;

alignas(64) uint8_t memory[BSM_IMAGE_BYTES];

void print(const char* text, uint32_t number) {
  char line[120];
  char* end = append_decimal(append_text(line, text), number);
  *end = 0;
  host_print(line);
}

// Pieces one after the other, each between fences.
class FenceYard final : public Yard {
 public:
  void clear() {
    next_ = 0;
    pieces_ = 0;
  }
  uint8_t* take(size_t bytes, size_t alignment) override {
    const size_t begin = (next_ + kFence + alignment - 1) / alignment * alignment;
    const size_t end = begin + bytes;
    if (end + kFence > sizeof memory || pieces_ == kMostPieces) {
      host_print("the trial takes more memory than the image has\n");
      host_exit(1);
    }
    for (size_t i = next_; i < begin; ++i) memory[i] = kFenceByte;
    for (size_t i = end; i < end + kFence; ++i) memory[i] = kFenceByte;
    piece_[pieces_++] = Piece{next_, begin, end};
    next_ = end;
    return memory + begin;
  }
  bool intact() const override {
    for (int32_t i = 0; i < pieces_; ++i) {
      if (!clean(piece_[i].fence, piece_[i].begin)) return false;
    }
    return clean(next_, next_ + kFence);
  }

 private:
  static constexpr int32_t kMostPieces = 256;
  struct Piece {
    size_t fence, begin, end;
  };
  static bool clean(size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      if (memory[i] != kFenceByte) return false;
    }
    return true;
  }
  Piece piece_[kMostPieces] = {};
  int32_t pieces_ = 0;
  size_t next_ = 0;
};

FenceYard yard;
const char* kernel_name;
int trial_width, trial_bits;

[[noreturn]] void report(const Difference& difference) {
  host_print(kernel_name);
  print(": width ", static_cast<uint32_t>(trial_width));
  print(" bits ", static_cast<uint32_t>(trial_bits));
  for (size_t i = 0; i < difference.notes_count; ++i) {
    host_print(" ");
    host_print(difference.notes[i].name);
    const int value = difference.notes[i].value;
    print(value < 0 ? " -" : " ", static_cast<uint32_t>(value < 0 ? -value : value));
  }
  host_print(": ");
  host_print(difference.what);
  if (difference.kernel == difference.scalar) {
    host_print(": something was written around the memory\n");
  } else {
    print(": element ", static_cast<uint32_t>(difference.element));
    print(" is ", difference.kernel);
    print(", scalar ", difference.scalar);
    host_print("\n");
  }
  host_exit(1);
}

template <class Args>
void try_widths(uint64_t seed, const Kernel<Args>& kernel, const Kernel<Args>& scalar) {
  Rng rng(seed);
  int group = rng.range(0, 63);
  for (int width = 1; width <= 200; ++width) {
    group = (group + 27) % 64;  // all lengths, in an order without a pattern; every other trial takes a short one
    trial_width = width;
    trial_bits = 64 * ((width % 2 == 0 ? group : group % 8) + 1);
    yard.clear();
    try_kernel(Trial{rng, yard, trial_width, trial_bits, report}, kernel, scalar);
  }
}

template <class Args>
Kernel<Args> kernel_of(void (*run)(const Args&), kernel_scratch_fn* scratch, int block) {
  return Kernel<Args>{run, scratch, block};
}

struct Selection {
  const char* isa;  // expected
  Kernels best;
  uint32_t checked;
};

template <class Args>
void run_kernel(Selection& selection, uint64_t seed, const char* name, const char* isa, int32_t stage,
                const Kernel<Args>& kernel, const Kernel<Args>& scalar) {
  if (kernel.run == scalar.run) return;
  kernel_name = name;
  host_print(name);
  if (!same_text(isa, selection.isa) || !same_text(selection.best.name[stage], name)) {
    host_print(": not what is to be chosen\n");
    host_exit(1);
  }
  try_widths(seed, kernel, scalar);
  host_print(" equals scalar\n");
  ++selection.checked;
}

uint64_t number_of(const char* word) {
  uint64_t number = 0;
  for (; *word != 0; ++word) {
    if (*word < '0' || *word > '9') {
      host_print("seed=N takes a number\n");
      host_exit(2);
    }
    number = 10 * number + static_cast<uint64_t>(*word - '0');
  }
  return number;
}

// What stands behind `name` in a word that begins with it; nullptr when it does not.
const char* value_of(const char* word, const char* name) {
  while (*name != 0 && *word == *name) ++word, ++name;
  return *name == 0 ? word : nullptr;
}

enum Stage : int32_t {
#define BSM_STAGE(stage, operation, Args, axis) stage##_##operation##_stage,
#include "simd/stages.def"
#undef BSM_STAGE
};

}  // namespace

int main() {
  char text[200];
  char* words[8];
  uint64_t seed = 20120611;
  Selection selection{"scalar", select_kernels(cpu_features()), 0};
  const int32_t count = host_arguments(text, sizeof text) ? split_words(text, words, 8) : 0;
  for (int32_t i = 1; i < count; ++i) {  // behind the image's name
    if (const char* isa = value_of(words[i], "isa=")) {
      selection.isa = isa;
    } else if (const char* start = value_of(words[i], "seed=")) {
      seed = number_of(start);
    } else {
      host_print("arguments: isa=NAME seed=N\n");
      host_exit(2);
    }
  }
  print("seed ", static_cast<uint32_t>(seed));
  host_print("\n");
#define BSM_KERNEL(stage, operation, isa, required, block)                                         \
  run_kernel(selection, seed, #stage "_" #operation "_" #isa, #isa, stage##_##operation##_stage,   \
             kernel_of(stage##_##operation##_##isa, stage##_##operation##_##isa##_scratch, block), \
             kernel_of(stage##_##operation##_scalar, stage##_##operation##_scalar_scratch, 1));
#include "simd/kernels.def"
#undef BSM_KERNEL
  print("kernels checked: ", selection.checked);
  host_print("\n");
  host_exit(selection.checked != 0 || same_text(selection.isa, "scalar") ? 0 : 1);
}
