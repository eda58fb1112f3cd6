# Cortex-M55, ARMv8.1-M: integer vectors (MVE) (Debian: gcc-arm-none-eabi).
set(CMAKE_SYSTEM_PROCESSOR cortex-m55)
include(${CMAKE_CURRENT_LIST_DIR}/cortex-m.cmake)
