# shellcheck shell=bash disable=SC2154  # root is run.sh's
# Cortex-M: every kernel of a build against scalar, on an emulated board. cortexm.sh builds the images and calls this.

# kernels_image CORE BOARD ARGUMENT...
kernels_image() {
  local image=$root/build/cortex-$1/tests/cortexm/check_kernels-$2.elf board=$2 arguments="enable=on,target=native,arg=image" word
  shift 2
  for word in "$@"; do arguments+=",arg=$word"; done
  timeout 300 qemu-system-arm -M "$board" -kernel "$image" -display none -monitor none -serial none \
    -semihosting-config "$arguments" 2>&1
}

# test_kernels_on CORE BOARD ISA: the kernels are those of ISA and write what scalar writes; another ISA is refused.
test_kernels_on() {
  expect "$1, $2: $3 kernels equal scalar" kernels_image "$1" "$2" "isa=$3"
  expect "$1, $2: kernels of another kind, refused" refuses "not what is to be chosen" kernels_image "$1" "$2" isa=neon
}
