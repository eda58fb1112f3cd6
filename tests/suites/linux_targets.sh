# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# Linux on other processors, under emulation: ARM with its kernels, and machines that run the scalar ones.

# cross SUITE TRIPLE EMULATOR CPU:ISA[:all]...
cross() {
  local suite=$1 triple=$2 emulator=$3 build=$root/build/$1
  shift 3
  if ! require_tools "$triple-g++" "$emulator" > /dev/null 2>&1; then
    skip_target "$suite" - "$triple-g++ or $emulator is not installed and cannot be installed here (Debian and Ubuntu: apt-get install g++-$triple qemu-user)"
    return
  fi
  echo "== $suite: building in $build"
  mkdir -p "$build"
  if ! { configure "$root" "$build" "-DCMAKE_TOOLCHAIN_FILE=$root/toolchains/$triple.cmake" -DCMAKE_BUILD_TYPE=Release \
    -DBSM_WERROR=ON -DBSM_BUILD_BENCH=ON "$joined" && cmake --build "$build" --parallel "$jobs" --target test_kernels test_golden test_targets; } \
    > "$build/build.log" 2>&1; then
    cat "$build/build.log"
    failed+=("$suite build (the output is above and in $build/build.log)")
    return
  fi
  emulate "$suite" "$build" "$@" -- "$emulator" -L "/usr/$triple"
  expect "no symbols beyond memory functions, integer helpers and getauxval" proof "$triple" proofs.sh symbols "$build/core/libbsm.a"
  expect "no writable data, no constructors" proof "$triple" proofs.sh sections "$build/core/libbsm.a"
}

# proof TRIPLE SCRIPT ARGUMENT...: a proof with the tools of another machine.
proof() {
  local triple=$1 script=$2
  shift 2
  env "NM=$triple-nm" "OBJDUMP=$triple-objdump" "AS=$triple-as" "CXX=$triple-g++" bash "$root/tests/$script" "$@"
}

# scan SUITE TRIPLE FLAG...: the objects of a suite's library hold no instruction beyond these flags and their own set.
scan() {
  local suite=$1 triple=$2 library=$root/build/$1/core/libbsm.a
  shift 2
  [ ! -f "$library" ] || expect "each object has its own instructions, and no floating-point arithmetic" \
    proof "$triple" objects.sh scan "$library" "$@"
}

# scan_refuses SUITE TRIPLE FLAG...: and the scan sees what is foreign.
scan_refuses() {
  local suite=$1 triple=$2
  shift 2
  [ ! -d "$root/build/$suite/core" ] || expect "foreign instructions and shared symbols, refused" proof "$triple" objects.sh self-test "$@"
}

# measures SUITE ISA EMULATOR...: the static program that boards get runs without the machine's libraries and has kernels of ISA
# in its table. Under emulation its numbers mean nothing.
measures() {
  local suite=$1 isa=$2 bench=$root/build/$1/bench/bsm_bench
  shift 2
  [ -d "$root/build/$suite/core" ] || return 0
  expect "static bsm_bench, build" cmake --build "$root/build/$suite" --parallel "$jobs" --target bsm_bench &&
    expect "static bsm_bench, $isa kernels measured" has_rows "$isa" "$@" "$bench" kernels --width 64 --bits 128 --disparities 16 \
      --repeat 1 --csv
}
has_rows() {
  local isa=$1 output
  shift
  output=$("$@") || return
  echo "$output"
  grep -qE "^mask_threshold_scalar,px,[0-9.]+," <<< "$output" && grep -qE "^mask_threshold_$isa,px,[0-9.]+," <<< "$output"
}

# traps SUITE TRIPLE EMULATOR...: kernels that end where an index leaves its array, a pointer is not aligned or a number does not
# fit. Traps need none of clang's libraries for the machine. null, object-size and pointer-overflow take the compiler minutes.
traps() {
  local suite=$1 triple=$2 build=$root/build/$1_traps
  shift 2
  [ -d "$root/build/$suite/core" ] || return 0
  have_clang || {
    skipped+=("$suite traps: $no_clang")
    return
  }
  expect "kernels that trap, build" build "$root" "$build" test_kernels -DCMAKE_SYSTEM_NAME=Linux \
    "-DCMAKE_SYSTEM_PROCESSOR=${triple%%-*}" -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    "-DCMAKE_C_COMPILER_TARGET=$triple" "-DCMAKE_CXX_COMPILER_TARGET=$triple" -DCMAKE_BUILD_TYPE=Release -DBSM_BUILD_BENCH=OFF "$joined" \
    "-DCMAKE_CXX_FLAGS=-fsanitize=bounds,undefined -fno-sanitize=null,object-size,pointer-overflow -fsanitize-trap=all" &&
    expect "kernels trap nowhere" env BSM_TEST_EFFORT=4 "$@" "$build/tests/test_kernels"
}

run_arm64() {
  cross arm64 aarch64-linux-gnu qemu-aarch64 cortex-a53:neon:all cortex-a76:neon a64fx:sve max,sve128=on:neon \
    max,sve256=on:neon max,sve-default-vector-length=256:sve:all
  measures arm64 neon qemu-aarch64 -cpu cortex-a53
  measures arm64 sve qemu-aarch64 -cpu a64fx
  traps arm64 aarch64-linux-gnu qemu-aarch64 -L /usr/aarch64-linux-gnu -cpu max,sve256=on
  scan arm64 aarch64-linux-gnu
  if [ -f "$root/build/arm64/core/libbsm.a" ]; then
    suite=arm64 expect "a program without C library" \
      proof aarch64-linux-gnu proofs.sh freestanding "$root/build/arm64/core/libbsm.a" qemu-aarch64
  fi
  scan_refuses arm64 aarch64-linux-gnu
}
run_arm32() {
  cross arm32 arm-linux-gnueabihf qemu-arm cortex-a7:neon:all cortex-a9,neon=off:scalar
  measures arm32 neon qemu-arm -cpu cortex-a7
  traps arm32 arm-linux-gnueabihf qemu-arm -L /usr/arm-linux-gnueabihf -cpu cortex-a7
  scan arm32 arm-linux-gnueabihf -march=armv7-a -mfpu=vfpv3-d16 -mthumb
  scan_refuses arm32 arm-linux-gnueabihf -march=armv7-a -mfpu=vfpv3-d16 -mthumb
}

# Machines without kernels of their own: no floating-point unit (ARMv5TE), RISC-V, and big-endian.
run_armv5() {
  cross armv5 arm-linux-gnueabi qemu-arm arm926:scalar
  scan armv5 arm-linux-gnueabi -march=armv5te -mfpu=softvfp
}
run_riscv64() {
  cross riscv64 riscv64-linux-gnu qemu-riscv64 rv64:scalar
  scan riscv64 riscv64-linux-gnu
}
run_s390x() { cross s390x s390x-linux-gnu qemu-s390x max:scalar:all; }
