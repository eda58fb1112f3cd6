# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# Linux on other processors, under emulation: ARM with its kernels, and machines that run the scalar ones.

# cross SUITE TRIPLE EMULATOR CPU:ISA...
cross() {
  local suite=$1 triple=$2 emulator=$3 build=$root/build/$1 entry
  shift 3
  if ! require_tools "$triple-g++" "$emulator" > /dev/null 2>&1; then
    skip_target "$suite" - "$triple-g++ or $emulator is not installed and cannot be installed here (Debian and Ubuntu: apt-get install g++-$triple qemu-user)"
    return
  fi
  echo "== $suite: building in $build"
  mkdir -p "$build"
  if ! { cmake -S "$root" -B "$build" "-DCMAKE_TOOLCHAIN_FILE=$root/toolchains/$triple.cmake" -DCMAKE_BUILD_TYPE=Release \
    -DBSM_WERROR=ON -DBSM_BUILD_BENCH=OFF && cmake --build "$build" --parallel "$jobs" --target test_kernels test_golden test_targets; } \
    > "$build/build.log" 2>&1; then
    cat "$build/build.log"
    failed+=("$suite build (the output is above and in $build/build.log)")
    return
  fi
  for entry in "$@"; do emulate "$suite" "$build" "${entry%%:*}" "${entry#*:}" "$emulator" -L "/usr/$triple"; done
}

run_arm64() {
  cross arm64 aarch64-linux-gnu qemu-aarch64 cortex-a53:neon cortex-a76:neon a64fx:sve max,sve128=on:sve max,sve256=on:sve \
    max,sve-default-vector-length=256:sve
}
run_arm32() { cross arm32 arm-linux-gnueabihf qemu-arm cortex-a7:neon cortex-a9,neon=off:scalar; }

# Machines without kernels of their own: no floating-point unit (ARMv5TE), RISC-V, and big-endian.
run_armv5() {
  # shellcheck disable=SC2034  # read by expect
  local suite=armv5
  cross armv5 arm-linux-gnueabi qemu-arm arm926:scalar
  if [ -f "$root/build/armv5/core/libbsm.a" ]; then
    expect "no floating point, memory functions and integer helpers alone" \
      env NM=arm-linux-gnueabi-nm OBJDUMP=arm-linux-gnueabi-objdump bash "$root/tests/proofs.sh" symbols "$root/build/armv5/core/libbsm.a"
  fi
}
run_riscv64() { cross riscv64 riscv64-linux-gnu qemu-riscv64 rv64:scalar; }
run_s390x() { cross s390x s390x-linux-gnu qemu-s390x max:scalar; }
