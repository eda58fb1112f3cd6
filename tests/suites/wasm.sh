# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# WebAssembly without an SDK and without a C library: node runs modules that compute the golden hashes, once built for every
# engine and once with vectors of 128 bits, whose kernels equal scalar.

# Runs the module; what it prints stays in the file.
gives_golden_hashes() { node "$root/tests/wasm/check_scene.js" "$1" > "$2"; }

run_wasm() {
  # shellcheck disable=SC2034  # read by expect
  local suite=wasm
  local entry name kernels modules result before
  if ! require_tools clang++-16 wasm-ld-16 llvm-ar-16 node > /dev/null 2>&1; then
    skip_target wasm32 - "clang-16, lld-16, llvm-16 or nodejs is not installed and cannot be installed here (Debian and Ubuntu: apt-get install clang-16 lld-16 llvm-16 nodejs)"
    return
  fi
  echo "== wasm: building in $root/build/wasm32*"
  for entry in wasm32:scalar wasm32-simd128:simd128; do
    IFS=: read -r name kernels <<< "$entry"
    modules=$root/build/$name/tests/wasm
    before=${#failed[@]}
    result=passed
    rm -f "$modules/hashes"
    if expect "$name, build" build "$root" "$root/build/$name" all "-DCMAKE_TOOLCHAIN_FILE=$root/toolchains/$name.cmake" \
      -DCMAKE_BUILD_TYPE=Release -DBSM_WERROR=ON; then
      expect "$name, golden hashes in node" gives_golden_hashes "$modules/check_scene.wasm" "$modules/hashes"
      expect "$name, kernels" grep -E "^target: $kernels(\+scalar)? " "$modules/hashes"
      [ "$kernels" = scalar ] ||
        expect "$name, $kernels kernels equal scalar" node "$root/tests/wasm/run_image.js" "$modules/check_kernels.wasm" "isa=$kernels"
    fi
    [ ${#failed[@]} -eq "$before" ] || result=failed
    add_target_row "$name" "node $(node --version)" "$result" "$(cat "$modules/hashes" 2> /dev/null)"
  done
}
