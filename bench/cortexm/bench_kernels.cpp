// Measures the kernels inside a frame on a microcontroller: the synthetic scene, 160 x 120 with 32 disparities, the preset
// `fast` in colour, once by the board's best kernels and once by the scalar ones. Prints what each stage takes per pixel of
// the frame: cycles where the core counts them (DWT), else instructions, which hold under qemu's -icount shift=0.
#include <stddef.h>
#include <stdint.h>

#include "core/context.h"
#include "cortexm/semihosting.h"
#include "cortexm/text.h"
#include "host/scene.h"

using namespace bsm;
using namespace bsm::cortexm;

namespace {

constexpr int32_t kWidth = 160;
constexpr int32_t kHeight = 120;
constexpr int32_t kDisparities = 32;
constexpr uint32_t kLoops = 100000;

alignas(64) uint8_t arena[192 * 1024];

volatile uint32_t& device(uintptr_t address) {
  return *reinterpret_cast<volatile uint32_t*>(address);
}

void run_loop(uint32_t rounds) {
  __asm__ volatile(".syntax unified\n1: subs %0, %0, #1\n\tbne 1b" : "+l"(rounds) : : "cc");
}

// A counter of cycles, or of the system timer's ticks, each of which is as many instructions as a loop of known length says.
class Clock {
 public:
  void start() {
    device(0xe000edfc) |= 1u << 24;  // DEMCR: trace on
    device(0xe0001000) |= 1u;        // DWT_CTRL: count cycles
    const uint32_t before = device(0xe0001004);
    run_loop(kLoops);
    cycles_ = device(0xe0001004) != before;
    device(0xe000e014) = 0xffffff;  // SysTick: reload, current value, on
    device(0xe000e018) = 0;
    device(0xe000e010) = 5;
    const uint32_t begin = now();
    run_loop(kLoops);
    loop_ = since(begin);
  }
  bool counts_cycles() const { return cycles_; }
  uint32_t now() const { return cycles_ ? device(0xe0001004) : 0 - device(0xe000e018); }
  uint32_t since(uint32_t begin) const { return cycles_ ? now() - begin : (now() - begin) & 0xffffff; }
  // Cycles or instructions of so many counts; two instructions a round.
  uint64_t units(uint64_t counts) const { return cycles_ ? counts : counts * (2 * kLoops) / loop_; }

 private:
  bool cycles_ = false;
  uint32_t loop_ = 1;
};

Clock timer;
uint64_t counts[BSM_KERNEL_COUNT];
void (*kernel_of_stage[BSM_KERNEL_COUNT])();  // what the metered functions call

enum Stage : int32_t {
#define BSM_STAGE(stage, operation, Args, axis) stage##_##operation##_stage,
#include "simd/stages.def"
#undef BSM_STAGE
};

template <class Args, int32_t kStage>
void metered(const Args& args) {
  const uint32_t begin = timer.now();
  reinterpret_cast<void (*)(const Args&)>(kernel_of_stage[kStage])(args);
  counts[kStage] += timer.since(begin);
}

void check(bsm_status status) {
  if (status >= 0) return;
  host_print(bsm_status_string(status));
  host_print("\n");
  host_exit(1);
}

// What each stage took in a frame; the names of its kernels.
struct Frame {
  uint64_t units[BSM_KERNEL_COUNT];
  const char* name[BSM_KERNEL_COUNT];
};

Frame measure_frame(uint32_t isa_mask) {
  static uint8_t left[3 * kWidth], right[3 * kWidth];
  static int16_t disparities[kWidth];
  bsm_config config;
  check(bsm_config_init(&config, kWidth, kHeight));
  check(bsm_config_preset(&config, BSM_PRESET_FAST));
  config.num_disparities = kDisparities;
  config.isa_mask = isa_mask;
  bsm_context* context = nullptr;
  check(bsm_open(&config, arena, sizeof arena, &context));
#define BSM_STAGE(stage, operation, Args, axis)                                                                      \
  kernel_of_stage[stage##_##operation##_stage] = reinterpret_cast<void (*)()>(context->kernels.stage##_##operation); \
  context->kernels.stage##_##operation = metered<Args, stage##_##operation##_stage>;
#include "simd/stages.def"
#undef BSM_STAGE
  for (uint64_t& count : counts) count = 0;
  host::SceneOptions scene;
  scene.width = kWidth;
  scene.height = kHeight;
  scene.num_disparities = kDisparities;
  const bsm_row left_row = {{left, nullptr}}, right_row = {{right, nullptr}};
  bsm_status pulled = BSM_OK;
  for (int32_t y = 0; pulled != BSM_END; ++y) {
    if (y < kHeight) {
      host::scene_row(scene, y, host::SceneRow{left, right, nullptr, nullptr, nullptr, nullptr});
      check(bsm_push_row(context, &left_row, &right_row));
    }
    pulled = bsm_pull_row(context, disparities, nullptr, nullptr);
    check(pulled);
  }
  Frame frame;
  for (int32_t i = 0; i < BSM_KERNEL_COUNT; ++i) {
    frame.units[i] = timer.units(counts[i]);
    frame.name[i] = context->kernels.name[i];
  }
  return frame;
}

char* append_padding(char* end, const char* line, int32_t column) {
  while (end < line + column) *end++ = ' ';
  return end;
}

void print_row(const char* name, uint64_t best, uint64_t scalar) {
  constexpr uint32_t kPixels = kWidth * kHeight;
  char line[120];
  char* end = append_padding(append_text(line, name), line, 28);
  end = append_padding(append_decimal(end, static_cast<uint32_t>((best + kPixels / 2) / kPixels)), line, 40);
  end = append_padding(append_decimal(end, static_cast<uint32_t>((scalar + kPixels / 2) / kPixels)), line, 52);
  const uint32_t tenths = static_cast<uint32_t>((10 * scalar + best / 2) / (best == 0 ? 1 : best));
  end = append_decimal(append_text(append_decimal(end, tenths / 10), "."), tenths % 10);
  *append_text(end, "\n") = 0;
  host_print(line);
}

}  // namespace

extern "C" void HardFault_Handler() {
  host_print("hard fault\n");
  host_exit(1);
}

int main() {
  timer.start();
  const Frame best = measure_frame(BSM_ISA_ALL);
  const Frame scalar = measure_frame(0);
  host_print(timer.counts_cycles() ? "cycles" : "instructions");
  host_print(" per pixel of a frame, 160 x 120, 32 disparities, preset fast, rgb24\n");
  host_print("kernel                      it          scalar      x scalar\n");
  uint64_t all = 0, all_scalar = 0;
  for (int32_t i = 0; i < BSM_KERNEL_COUNT; ++i) {
    if (scalar.units[i] == 0) continue;  // does not run in this frame
    print_row(best.name[i], best.units[i], scalar.units[i]);
    all += best.units[i];
    all_scalar += scalar.units[i];
  }
  print_row("all kernels", all, all_scalar);
  host_exit(0);
}
