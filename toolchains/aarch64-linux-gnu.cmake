# 64-bit ARM Linux.
set(bsm_triple aarch64-linux-gnu)
set(bsm_emulator qemu-aarch64)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
include(${CMAKE_CURRENT_LIST_DIR}/linux_gnu.cmake)
