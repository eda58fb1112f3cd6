#!/usr/bin/env bash
# run.sh - builds the library with its tests, runs them and says what passed, what failed and what was skipped and why.
set -u -o pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
  cat << 'END'
usage: bash tests/run.sh [--asan] [--all]

Checks for a compiler, CMake and make (installs them on Debian and Ubuntu when it may), builds in build/tests and runs every
test. Exit code 0: nothing failed.

  --asan   build with AddressSanitizer and UndefinedBehaviorSanitizer in build/asan and run that instead
  --all    the native build, the kernels of older x86 processors and of ARM under emulation, a build with clang, the
           sanitizers, and the fuzzers for a short fixed count; what this machine lacks is listed as skipped
  --help   this text

Environment: BSM_DATA names a folder of real pairs with ground truth (v2/tsukuba, v2/venus, v2/teddy, v2/cones);
BSM_TEST_EFFORT scales the number of random cases, in percent; CC and CXX choose the compilers.
END
}

suites=native
for option in "$@"; do
  case $option in
    --asan) suites=asan ;;
    --all) suites="native tiers arm64 arm32 clang asan fuzz" ;;
    -h | --help)
      usage
      exit 0
      ;;
    *)
      echo "run.sh: $option: unknown option" >&2
      usage >&2
      exit 2
      ;;
  esac
done

# shellcheck source=../platform/host/require_tools.sh
. "$root/platform/host/require_tools.sh"
exec < /dev/null
require_tools cc c++ cmake make || exit 1

jobs=$(getconf _NPROCESSORS_ONLN 2> /dev/null || echo 2)
sanitizers="-fsanitize=address,undefined,alignment -fno-sanitize-recover=all -fno-omit-frame-pointer"
passed=0
failed=()
skipped=()

# Counts the results of one ctest run by its output, and takes the reasons of skips from its log.
count_results() {
  local suite=$1 output=$2 log=$3 name result reasons
  # Lines "SKIPPED: reason" of each test, as test<TAB>reason.
  reasons=$(awk '/^[0-9]+\/[0-9]+ Testing: / { name = $3 } /^SKIPPED: / { sub(/^SKIPPED: /, ""); print name "\t" $0 }' "$log")
  while IFS=$'\t' read -r name result; do
    case $result in
      Passed)
        passed=$((passed + 1))
        while IFS= read -r reason; do
          [ -n "$reason" ] && skipped+=("$suite $name, in part: $reason")
        done < <(awk -F '\t' -v n="$name" '$1 == n { print $2 }' <<< "$reasons")
        ;;
      Skipped)
        reason=$(awk -F '\t' -v n="$name" '$1 == n { print $2; exit }' <<< "$reasons")
        skipped+=("$suite $name: ${reason:-no reason given}")
        ;;
      *Disabled*) skipped+=("$suite $name: not for this configuration") ;;
      *) failed+=("$suite $name ($result)") ;;
    esac
  done < <(sed -nE 's/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: ([^ ]+) \.*[ *]*([A-Z][A-Za-z]*( Run)?( \([A-Za-z]*\))?).*/\1\t\2/p' "$output")
}

# run_suite NAME FOLDER CTEST_PATTERN CMAKE_OPTION...
run_suite() {
  local suite=$1 build=$root/build/$2 pattern=$3 before=$((passed + ${#failed[@]} + ${#skipped[@]}))
  shift 3
  mkdir -p "$build"
  echo "== $suite: building in $build"
  if ! { cmake -S "$root" -B "$build" -DBSM_BUILD_TESTS=ON -DBSM_BUILD_PROGRAM=ON -DBSM_WERROR=ON "$@" &&
    cmake --build "$build" --parallel "$jobs"; } > "$build/build.log" 2>&1; then
    cat "$build/build.log"
    failed+=("$suite build (the output is above and in $build/build.log)")
    return
  fi
  rm -f "$build/Testing/Temporary/LastTest.log"
  (cd "$build" && ctest --output-on-failure -j "$jobs" -R "$pattern") 2>&1 | tee "$build/ctest.out"
  if [ -f "$build/Testing/Temporary/LastTest.log" ]; then
    count_results "$suite" "$build/ctest.out" "$build/Testing/Temporary/LastTest.log"
  fi
  [ $((passed + ${#failed[@]} + ${#skipped[@]})) -gt "$before" ] || failed+=("$suite: ctest ran nothing")
}

# True when a one-line program links with the given compiler and options.
links() {
  local dir good
  dir=$(mktemp -d) || return 1
  echo "$1" > "$dir/probe.cpp"
  shift
  "$@" "$dir/probe.cpp" -o "$dir/probe" > /dev/null 2>&1
  good=$?
  rm -rf "$dir"
  return $good
}

main_program='int main() { return 0; }'
fuzz_program='extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }'

run_native() { run_suite native tests . -DCMAKE_BUILD_TYPE=Release; }

run_asan() {
  # shellcheck disable=SC2086  # options are words of their own
  if ! links "$main_program" ${CXX:-c++} $sanitizers; then
    skipped+=("asan: ${CXX:-c++} does not link $sanitizers; install its sanitizer runtime (Debian: libasan, libubsan)")
    return
  fi
  run_suite asan asan . -DCMAKE_BUILD_TYPE=RelWithDebInfo "-DCMAKE_C_FLAGS=$sanitizers" "-DCMAKE_CXX_FLAGS=$sanitizers"
}

# Set by have_clang; the two suites that need clang say the same.
no_clang="clang is not installed and cannot be installed here (Debian and Ubuntu: apt-get install clang)"
have_clang() { require_tools clang clang++ > /dev/null 2>&1; }

run_clang() {
  have_clang || {
    skipped+=("clang: $no_clang")
    return
  }
  run_suite clang clang . -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++
}

run_fuzz() {
  have_clang || {
    skipped+=("fuzz: $no_clang")
    return
  }
  local flags="-fsanitize=address,undefined -fno-sanitize-recover=all" runtime
  runtime=libclang-rt-$(clang++ -dumpversion | cut -d. -f1)-dev
  # shellcheck disable=SC2086
  if ! links "$fuzz_program" clang++ -fsanitize=fuzzer $flags && ! { install_packages "$runtime" > /dev/null 2>&1 &&
    links "$fuzz_program" clang++ -fsanitize=fuzzer $flags; }; then
    skipped+=("fuzz: clang++ does not link -fsanitize=fuzzer (Debian and Ubuntu: apt-get install $runtime)")
    return
  fi
  run_suite fuzz fuzz '^fuzz_' -DCMAKE_BUILD_TYPE=RelWithDebInfo -DBSM_BUILD_FUZZERS=ON -DBSM_BUILD_BENCH=OFF \
    -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ "-DCMAKE_C_FLAGS=$flags" \
    "-DCMAKE_CXX_FLAGS=$flags -fsanitize=fuzzer-no-link"
}

# emulate SUITE BUILD CPU ISA EMULATOR...: the tests of kernels and hashes on an emulated CPU, which has to choose the kernels of
# that instruction set; an instruction that it lacks ends the test.
emulate() {
  local suite=$1 build=$2 cpu=$3 isa=$4 name output
  shift 4
  for name in test_kernels test_golden; do
    if output=$(BSM_EXPECT_ISA=$isa BSM_TEST_EFFORT=25 "$@" -cpu "$cpu" "$build/tests/$name" 2>&1); then
      echo "$suite $cpu: $name passed with $isa kernels"
      passed=$((passed + 1))
    else
      printf '%s\n' "$output" | grep -v '^ok' | head -n 40
      failed+=("$suite $cpu: $name")
    fi
  done
}

# The x86 tiers that this machine's own run does not choose.
run_tiers() {
  if [ "$(uname -m)" != x86_64 ]; then
    skipped+=("tiers: the build is not for x86-64")
  elif ! require_tools qemu-x86_64 > /dev/null 2>&1; then
    skipped+=("tiers: qemu-x86_64 is not installed and cannot be installed here (Debian and Ubuntu: apt-get install qemu-user)")
  elif [ -x "$root/build/tests/tests/test_kernels" ]; then
    echo "== tiers: x86 processors of several ages"
    emulate tiers "$root/build/tests" core2duo scalar qemu-x86_64
    emulate tiers "$root/build/tests" Nehalem sse42 qemu-x86_64
    emulate tiers "$root/build/tests" Haswell avx2 qemu-x86_64
  fi
}

# cross SUITE TRIPLE EMULATOR CPU:ISA...
cross() {
  local suite=$1 triple=$2 emulator=$3 build=$root/build/$1 entry
  shift 3
  if ! require_tools "$triple-g++" "$emulator" > /dev/null 2>&1; then
    skipped+=("$suite: $triple-g++ or $emulator is not installed and cannot be installed here (Debian and Ubuntu: apt-get install g++-$triple qemu-user)")
    return
  fi
  echo "== $suite: building in $build"
  mkdir -p "$build"
  if ! { cmake -S "$root" -B "$build" "-DCMAKE_TOOLCHAIN_FILE=$root/toolchains/$triple.cmake" -DCMAKE_BUILD_TYPE=Release \
    -DBSM_WERROR=ON -DBSM_BUILD_BENCH=OFF && cmake --build "$build" --parallel "$jobs" --target test_kernels test_golden; } \
    > "$build/build.log" 2>&1; then
    cat "$build/build.log"
    failed+=("$suite build (the output is above and in $build/build.log)")
    return
  fi
  for entry in "$@"; do emulate "$suite" "$build" "${entry%%:*}" "${entry#*:}" "$emulator" -L "/usr/$triple"; done
}

run_arm64() { cross arm64 aarch64-linux-gnu qemu-aarch64 cortex-a53:neon; }
run_arm32() { cross arm32 arm-linux-gnueabihf qemu-arm cortex-a7:neon cortex-a9,neon=off:scalar; }

for suite in $suites; do "run_$suite"; done

echo
echo "== summary"
[ ${#failed[@]} -eq 0 ] || printf 'failed:  %s\n' "${failed[@]}"
[ ${#skipped[@]} -eq 0 ] || printf 'skipped: %s\n' "${skipped[@]}"
echo "$passed passed, ${#failed[@]} failed, ${#skipped[@]} skipped"
[ ${#failed[@]} -eq 0 ]
