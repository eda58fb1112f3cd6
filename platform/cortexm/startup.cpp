// Start-up of a Cortex-M image: vector table, static memory, coprocessors, then main. Names of handlers are CMSIS's; an
// image that defines one of them replaces the default, which stops.
#include <stdint.h>

extern "C" {
// Of the linker script.
extern uint32_t stack_top[];
extern const uint32_t data_load[];
extern uint32_t data_begin[], data_end[], bss_begin[], bss_end[];

int main();

void Default_Handler() noexcept {
  for (;;) __asm__ volatile("wfe");
}
#define BSM_DEFAULT noexcept __attribute__((weak, alias("Default_Handler")))
void NMI_Handler() BSM_DEFAULT;
void HardFault_Handler() BSM_DEFAULT;
void SVC_Handler() BSM_DEFAULT;
void PendSV_Handler() BSM_DEFAULT;
void SysTick_Handler() BSM_DEFAULT;

void Reset_Handler() {
#if defined(__ARM_ARCH_6M__)
  // Where such an image runs on a larger core, misaligned accesses fault as well.
  *reinterpret_cast<volatile uint32_t*>(0xe000ed14) |= 1u << 3;
#endif
#if defined(__ARM_FEATURE_MVE) || defined(__ARM_FP)
  // Vector and floating-point instructions fault until coprocessors 10 and 11 are enabled.
  *reinterpret_cast<volatile uint32_t*>(0xe000ed88) |= 0xfu << 20;
  __asm__ volatile("dsb\n\tisb" ::: "memory");
#endif
  const uint32_t* from = data_load;
  for (uint32_t* to = data_begin; to != data_end; ++to) *to = *from++;
  for (uint32_t* to = bss_begin; to != bss_end; ++to) *to = 0;
  main();
  Default_Handler();
}

// libgcc's division names it; nothing here unwinds.
void __aeabi_unwind_cpp_pr0() {}
}

namespace {

using Handler = void (*)();
struct VectorTable {
  const void* stack;
  Handler handlers[15];
};

// Interrupts of the chip would follow; the example needs none. Faults other than HardFault escalate to it until enabled.
__attribute__((section(".vectors"), used))
const VectorTable vectors = {stack_top,
                             {Reset_Handler, NMI_Handler, HardFault_Handler, nullptr, nullptr, nullptr, nullptr, nullptr,
                              nullptr, nullptr, SVC_Handler, nullptr, nullptr, PendSV_Handler, SysTick_Handler}};

}  // namespace
