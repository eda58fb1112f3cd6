# 32-bit ARM Linux, ARMv7-A, hard float; processors are cortex-a7 or, without NEON, cortex-a9,neon=off.
set(bsm_triple arm-linux-gnueabihf)
set(bsm_emulator qemu-arm)
set(CMAKE_SYSTEM_PROCESSOR armv7l)
include(${CMAKE_CURRENT_LIST_DIR}/linux_gnu.cmake)
