# Cortex-M33, ARMv8-M: the DSP instructions (Debian: gcc-arm-none-eabi).
set(CMAKE_SYSTEM_PROCESSOR cortex-m33)
include(${CMAKE_CURRENT_LIST_DIR}/cortex-m.cmake)
