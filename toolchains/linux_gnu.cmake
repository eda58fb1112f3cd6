# What the toolchain files of Debian's cross compilers share. They set bsm_triple, the compiler's prefix and the folder of its
# libraries, and bsm_emulator, the program that runs what was built (Debian: qemu-user); the environment variable QEMU_CPU
# chooses the processor, as in QEMU_CPU=cortex-a53.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_C_COMPILER ${bsm_triple}-gcc)
set(CMAKE_CXX_COMPILER ${bsm_triple}-g++)
set(CMAKE_FIND_ROOT_PATH /usr/${bsm_triple})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_CROSSCOMPILING_EMULATOR "${bsm_emulator};-L;/usr/${bsm_triple}")
