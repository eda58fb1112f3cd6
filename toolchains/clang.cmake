# Objects for any system that clang knows, without its SDK: proves that the library compiles there with the C headers that come
# with the compiler alone. BSM_TARGET is clang's name of the machine, as in -DBSM_TARGET=arm64-apple-ios12. For macOS
# CMAKE_OSX_ARCHITECTURES may name several machines at once, whose objects clang joins by the program lipo. (Debian: clang-16,
# llvm-16, whose llvm-lipo-16 is that program.)
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES BSM_TARGET)
set(CMAKE_C_COMPILER clang-16)
set(CMAKE_CXX_COMPILER clang++-16)
set(CMAKE_AR llvm-ar-16)
set(CMAKE_RANLIB llvm-ranlib-16)
set(bsm_flags "--target=${BSM_TARGET} -ffreestanding -nostdlibinc")
set(CMAKE_C_FLAGS_INIT "${bsm_flags}")
set(CMAKE_CXX_FLAGS_INIT "${bsm_flags}")
if(BSM_TARGET MATCHES "-apple-macos")
  set(CMAKE_SYSTEM_NAME Darwin)
  set(CMAKE_OSX_SYSROOT /)  # a folder that is there; nothing is taken from it
  set(CMAKE_INSTALL_NAME_TOOL llvm-install-name-tool-16)
endif()
# CMake names no flags of the build types where clang stands in for MSVC and the system is none that it knows.
if(BSM_TARGET MATCHES "-msvc$")
  set(CMAKE_C_FLAGS_RELEASE_INIT "-O3 -DNDEBUG")
  set(CMAKE_CXX_FLAGS_RELEASE_INIT "-O3 -DNDEBUG")
endif()
