# IBM Z Linux: a big-endian machine.
set(bsm_triple s390x-linux-gnu)
set(bsm_emulator qemu-s390x)
set(CMAKE_SYSTEM_PROCESSOR s390x)
include(${CMAKE_CURRENT_LIST_DIR}/linux_gnu.cmake)
