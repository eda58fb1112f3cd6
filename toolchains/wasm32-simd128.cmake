# WebAssembly with vectors of 128 bits (Debian: clang-16, lld-16, llvm-16).
set(wasm_features -msimd128)
include(${CMAKE_CURRENT_LIST_DIR}/wasm32.cmake)
