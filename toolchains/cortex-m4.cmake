# Cortex-M4, ARMv7E-M: the DSP instructions (Debian: gcc-arm-none-eabi).
set(CMAKE_SYSTEM_PROCESSOR cortex-m4)
include(${CMAKE_CURRENT_LIST_DIR}/cortex-m.cmake)
