# shellcheck shell=bash disable=SC2154  # root is run.sh's
# Cortex-M: every kernel of a build against scalar, on an emulated board. cortexm.sh builds the images and calls this.

# kernels_image CORE BOARD IMAGE ARGUMENT...: IMAGE is a path in the build folder, without the board.
kernels_image() {
  local image=$root/build/cortex-$1/$3-$2.elf board=$2 arguments="enable=on,target=native,arg=image" word
  shift 3
  for word in "$@"; do arguments+=",arg=$word"; done
  timeout 300 qemu-system-arm -M "$board" -kernel "$image" -display none -monitor none -serial none \
    -semihosting-config "$arguments" 2>&1
}

# The measurement of the kernels ends well and has kernels of ISA in it. Without -icount its numbers mean nothing.
measures_kernels() {
  local output
  output=$(kernels_image "$1" "$2" bench/cortexm/bench_kernels) || { echo "$output"; return 1; }
  echo "$output"
  grep -qE "^mask_threshold_$3 .* [0-9]+\.[0-9]$" <<< "$output"
}

# test_kernels_on CORE BOARD ISA: the kernels are those of ISA and write what scalar writes; another ISA is refused.
test_kernels_on() {
  expect "$1, $2: $3 kernels equal scalar" kernels_image "$1" "$2" tests/cortexm/check_kernels "isa=$3"
  expect "$1, $2: kernels of another kind, refused" refuses "not what is to be chosen" \
    kernels_image "$1" "$2" tests/cortexm/check_kernels isa=neon
  expect "$1, $2: kernels measured" measures_kernels "$1" "$2" "$3"
}
