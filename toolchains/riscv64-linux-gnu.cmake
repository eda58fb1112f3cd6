# 64-bit RISC-V Linux.
set(bsm_triple riscv64-linux-gnu)
set(bsm_emulator qemu-riscv64)
set(CMAKE_SYSTEM_PROCESSOR riscv64)
include(${CMAKE_CURRENT_LIST_DIR}/linux_gnu.cmake)
