# What all Cortex-M targets share: bare metal with gcc-arm-none-eabi and binutils alone, no C library. A toolchain file of one
# core sets CMAKE_SYSTEM_PROCESSOR and includes this one.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)

# Software calling convention on every core: the library has no floating point, and images for boards with and without a
# floating-point unit link the same archive.
set(cpu ${CMAKE_SYSTEM_PROCESSOR})
set(float_abi soft)
if(cpu STREQUAL "cortex-m55")
  # Integer vectors (MVE) without their floating-point half; softfp is what allows vector registers.
  string(APPEND cpu "+nofp")
  set(float_abi softfp)
endif()
# Freestanding: <stdint.h> and <stddef.h> are the compiler's own.
set(flags "-mcpu=${cpu} -mthumb -mfloat-abi=${float_abi} -ffreestanding -ffunction-sections -fdata-sections")
set(CMAKE_C_FLAGS_INIT "${flags}")
set(CMAKE_CXX_FLAGS_INIT "${flags}")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostdlib -Wl,--gc-sections")
