# Cortex-M7, ARMv7E-M: the DSP instructions, two at a time (Debian: gcc-arm-none-eabi).
set(CMAKE_SYSTEM_PROCESSOR cortex-m7)
include(${CMAKE_CURRENT_LIST_DIR}/cortex-m.cmake)
