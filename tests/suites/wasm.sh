# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# WebAssembly without an SDK and without a C library: node runs a module that computes the golden hashes, once built for every
# engine and once with vectors of 128 bits.

# True when an instruction of the module works on vectors.
uses_vectors() {
  local code
  code=$(llvm-objdump-16 -d "$1") && grep -m1 -E '[[:space:]](v128|i8x16|i16x8|i32x4|i64x2)\.' <<< "$code"
}
uses_no_vectors() { ! uses_vectors "$1"; }

# Runs the module; what it prints stays in the file.
gives_golden_hashes() { node "$root/tests/wasm/check_scene.js" "$1" > "$2"; }

run_wasm() {
  # shellcheck disable=SC2034  # read by expect
  local suite=wasm
  local entry name vectors folder result
  if ! require_tools clang++-16 wasm-ld-16 llvm-ar-16 node > /dev/null 2>&1; then
    skip_target wasm32 - "clang-16, lld-16, llvm-16 or nodejs is not installed and cannot be installed here (Debian and Ubuntu: apt-get install clang-16 lld-16 llvm-16 nodejs)"
    return
  fi
  echo "== wasm: building in $root/build/wasm32*"
  for entry in wasm32:uses_no_vectors wasm32-simd128:uses_vectors; do
    IFS=: read -r name vectors <<< "$entry"
    folder=$root/build/$name
    result=failed
    rm -f "$folder/hashes"
    expect "$name, build" build "$root" "$folder" all "-DCMAKE_TOOLCHAIN_FILE=$root/toolchains/$name.cmake" \
      -DCMAKE_BUILD_TYPE=Release -DBSM_WERROR=ON && expect "$name ${vectors//_/ }" "$vectors" "$folder/tests/wasm/check_scene.wasm" &&
      expect "$name, golden hashes in node" gives_golden_hashes "$folder/tests/wasm/check_scene.wasm" "$folder/hashes" && result=passed
    add_target_row "$name" "node $(node --version)" "$result" "$(cat "$folder/hashes" 2> /dev/null)"
  done
}
