# 32-bit ARM Linux without any floating-point unit: ARMv5TE, soft float; a processor is arm926.
set(bsm_triple arm-linux-gnueabi)
set(bsm_emulator qemu-arm)
set(CMAKE_SYSTEM_PROCESSOR armv5tel)
set(CMAKE_C_FLAGS_INIT "-march=armv5te -marm")
set(CMAKE_CXX_FLAGS_INIT "-march=armv5te -marm")
include(${CMAKE_CURRENT_LIST_DIR}/linux_gnu.cmake)
