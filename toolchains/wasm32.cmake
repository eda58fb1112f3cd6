# WebAssembly, 32-bit, without a system interface: clang and its linker alone, no C library (Debian: clang-16, lld-16, llvm-16).
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang-16)
set(CMAKE_CXX_COMPILER clang++-16)
set(CMAKE_AR llvm-ar-16)
set(CMAKE_RANLIB llvm-ranlib-16)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
# A toolchain file that includes this one names in wasm_features what the machine has beyond the first version.
set(flags "--target=wasm32-unknown-unknown -ffreestanding ${wasm_features}")
set(CMAKE_C_FLAGS_INIT "${flags}")
set(CMAKE_CXX_FLAGS_INIT "${flags}")
# A module without a main function: what it exports is called from outside. A call that uses more stack than there is traps.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostdlib -Wl,--no-entry -Wl,--stack-first -Wl,-z,stack-size=8192")
