# Cortex-M0, ARMv6-M: no division, no misaligned access (Debian: gcc-arm-none-eabi).
set(CMAKE_SYSTEM_PROCESSOR cortex-m0)
include(${CMAKE_CURRENT_LIST_DIR}/cortex-m.cmake)
