#!/usr/bin/env bash
# run.sh - builds the library with its tests, runs them and says what passed, what failed and what was skipped and why.
set -u -o pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# In an order that keeps two of them busy: what others go on with and what takes long first.
all_suites="native arm64 asan tiers embedding armv5 options s390x cortexm clang arm32 tsan riscv64 nosdk fuzz packages wasm"

usage() {
  cat << END
usage: bash tests/run.sh [--all | --suite NAME...]

Checks for a compiler, CMake and make (installs them on Debian and Ubuntu when it may), builds in build/tests and runs every
test. Exit code 0: nothing failed.

  --suite  that suite instead, built in a folder of its own under build/; again for more. Suites:
           $all_suites
  --all    every suite: the native build; the kernels of older x86 processors and of ARM, other Linux machines and Cortex-M
           boards under emulation; objects for systems whose SDK is not here; WebAssembly in node; embedding in other
           projects; a build with clang, the sanitizers, and the fuzzers for a short fixed count. Installs compilers and
           emulators on Debian and Ubuntu when it may; what this machine lacks is listed as skipped
  --help   this text

Environment: BSM_DATA names a folder of real pairs with ground truth (v2/tsukuba, v2/venus, v2/teddy, v2/cones);
BSM_TEST_EFFORT scales the number of random cases, in percent; CC and CXX choose the compilers.
END
}

suites="" part=""
while [ $# -gt 0 ]; do
  case $1 in
    --all) suites=$all_suites ;;
    --part) # side_by_side.sh's
      part=$2
      shift
      ;;
    --suite)
      [[ -n ${2:-} && " $all_suites " == *" $2 "* ]] || {
        echo "run.sh: --suite ${2:-}: the suites are $all_suites" >&2
        exit 2
      }
      suites+=" $2"
      shift
      ;;
    -h | --help)
      usage
      exit 0
      ;;
    *)
      echo "run.sh: $1: unknown option" >&2
      usage >&2
      exit 2
      ;;
  esac
  shift
done

# shellcheck source-path=SCRIPTDIR source=../platform/host/require_tools.sh
. "$root/platform/host/require_tools.sh"
exec < /dev/null
[ -n "$part" ] || require_tools cc c++ cmake make || exit 1

jobs=$(getconf _NPROCESSORS_ONLN 2> /dev/null || echo 2)
passed=0
failed=()
skipped=()
table=()

# add_row TARGET CPU KERNELS LOCAL_HASH SGM_HASH WAYS RESULT: a line of the table of targets. KERNELS are the instruction sets
# that ran, WAYS is frame, rows or frame+rows, RESULT is passed, failed or skipped; "-" stands for what there is none of.
add_row() {
  local IFS=$'\t'
  table+=("$*")
}

# add_target_row TARGET CPU RESULT OUTPUT: the same with what test_targets wrote in OUTPUT, "target: KERNELS LOCAL SGM WAYS".
add_target_row() {
  local kernels local_hash sgm_hash ways
  read -r kernels local_hash sgm_hash ways < <(sed -n 's/^target: //p' <<< "$4")
  add_row "$1" "$2" "${kernels:--}" "${local_hash:--}" "${sgm_hash:--}" "${ways:--}" "$3"
}

# skip_target TARGET CPU REASON: counts a target as skipped, in the table too.
skip_target() {
  skipped+=("$1: $3")
  add_row "$1" "$2" - - - - skipped
}

print_table() {
  printf '%s\n' $'target\tprocessor\tkernels\tlocal hash\tsgm hash\tways\tresult' "${table[@]}" | awk -F '\t' '
    { for (i = 1; i <= NF; i++) { cell[NR, i] = $i; if (length($i) > width[i]) width[i] = length($i) } }
    END {
      for (row = 1; row <= NR; row++) {
        line = ""
        for (i = 1; i <= NF; i++) line = line sprintf("%-" width[i] "s  ", cell[row, i])
        sub(/ +$/, "", line)
        print line
      }
    }'
}

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

# The table's line of a ctest run that held test_targets.
add_ctest_row() {
  local result=failed
  grep -q ' test_targets \.* *Passed' "$2" && result=passed
  grep -q ' test_targets ' "$2" && add_target_row "$1" "$(uname -m), this one" "$result" "$(cat "$3")"
}

# configure SOURCE FOLDER OPTION...: by Ninja where it is there, which starts fewer processes than make; a folder stays with the
# one that it has.
configure() {
  local source=$1 folder=$2 generator=()
  shift 2
  [ -e "$folder/CMakeCache.txt" ] || ! have_tool ninja || generator=(-G Ninja)
  cmake ${generator[@]+"${generator[@]}"} -S "$source" -B "$folder" "$@"
}

# run_suite NAME FOLDER CTEST_PATTERN CMAKE_OPTION...; the variable `targets` of the caller names what to build, if not everything.
run_suite() {
  local suite=$1 build=$root/build/$2 pattern=$3 before=$((passed + ${#failed[@]} + ${#skipped[@]}))
  shift 3
  mkdir -p "$build"
  echo "== $suite: building in $build"
  if ! { configure "$root" "$build" -DBSM_BUILD_TESTS=ON -DBSM_BUILD_PROGRAM=ON -DBSM_WERROR=ON "$@" &&
    cmake --build "$build" --parallel "$jobs" ${targets:+--target $targets}; } > "$build/build.log" 2>&1; then
    cat "$build/build.log"
    failed+=("$suite build (the output is above and in $build/build.log)")
    return
  fi
  wait_for tools
  rm -f "$build/Testing/Temporary/LastTest.log"
  (cd "$build" && ctest --output-on-failure -j "$jobs" -R "$pattern") 2>&1 | tee "$build/ctest.out"
  if [ -f "$build/Testing/Temporary/LastTest.log" ]; then
    count_results "$suite" "$build/ctest.out" "$build/Testing/Temporary/LastTest.log"
    add_ctest_row "$suite" "$build/ctest.out" "$build/Testing/Temporary/LastTest.log"
  fi
  [ $((passed + ${#failed[@]} + ${#skipped[@]})) -gt "$before" ] || failed+=("$suite: ctest ran nothing")
}

# For builds that do not test kernels: as with a compiler that has none of those that take it longest.
# shellcheck disable=SC2034  # suites'
no_wide_vectors=(-DBSM_COMPILES_X86_AVX2=OFF -DBSM_COMPILES_X86_AVX512=OFF)

# Sources of the tests by several at a time, which the native suite compiles one by one.
# shellcheck disable=SC2034  # suites'
joined=-DCMAKE_UNITY_BUILD=ON

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

# expect NAME COMMAND...: one check of the suite that runs; its output is shown when it fails.
expect() {
  local name=$1 output
  shift
  if output=$("$@" 2>&1); then
    echo "$suite: $name"
    passed=$((passed + 1))
  else
    printf '%s\n' "$output"
    failed+=("$suite $name")
    return 1
  fi
}

# The command fails, and says TEXT.
refuses() {
  local text=$1 output
  shift
  ! output=$("$@" 2>&1) && grep -qF -- "$text" <<< "$output"
}

# build SOURCE FOLDER TARGETS OPTION...: configures and builds some targets, "all" for all.
build() {
  local source=$1 folder=$2 targets=$3
  shift 3
  # shellcheck disable=SC2086  # targets are words of their own
  configure "$source" "$folder" "$@" && cmake --build "$folder" --parallel "$jobs" --target $targets
}

# gray_pair FOLDER: left.pgm and right.pgm of the demo's left.ppm and right.ppm. Their green stands for gray, as in golden.inc.
gray_pair() {
  local view width height
  for view in left right; do
    read -r width height < <(sed -n 2p "$1/$view.ppm") &&
      { printf 'P5\n%d %d\n255\n' "$width" "$height" && tail -c "$((3 * width * height))" "$1/$view.ppm" |
        od -An -v -tu1 -w3 | LC_ALL=C awk '{ printf "%c", $2 }'; } > "$1/$view.pgm" || return
  done
}

# emulate SUITE BUILD CPU:ISA[:all]... -- EMULATOR...: the tests of kernels and hashes on emulated CPUs, each of which has to
# choose the kernels of that instruction set; an instruction that it lacks ends the test. CPUs with ":all" compute all hashes,
# the others those of the presets. As many run at once as there are processors here.
emulate() {
  local suite=$1 build=$2 cpus=() tests=(test_golden test_kernels test_targets) entry cpu isa name log all result runs=()
  shift 2
  while [ "$1" != -- ]; do
    cpus+=("$1")
    shift
  done
  shift
  rm -rf "$build/emulated"
  mkdir -p "$build/emulated"
  for entry in "${cpus[@]}"; do
    case $entry in
      *:all) runs=("$entry test_golden all" ${runs[@]+"${runs[@]}"}) ;; # the longest, so first
      *) runs+=("$entry test_golden preset") ;;
    esac
    runs+=("$entry test_kernels all" "$entry test_targets all")
  done
  # shellcheck disable=SC2016  # expanded by the shell of each test
  printf '%s\n' "${runs[@]}" | xargs -n 3 -P "$jobs" bash -c '
    build=$0 emulator=("${@:1:$#-3}") entry=${*: -3:1} name=${*: -2:1} cases=${*: -1}
    log=$build/emulated/$entry.$name
    entry=${entry%:all}
    BSM_EXPECT_ISA=${entry#*:} BSM_TEST_EFFORT=25 "${emulator[@]}" -cpu "${entry%%:*}" "$build/tests/$name" \
      --filter "${cases#all}" > "$log" 2>&1 && touch "$log.passed"' "$build" "$@"
  for entry in "${cpus[@]}"; do
    isa=${entry%:all} cpu=${entry%%:*} all="" result=passed
    isa=${isa#*:}
    for name in "${tests[@]}"; do
      log=$build/emulated/$entry.$name
      if [ -e "$log.passed" ]; then
        echo "$suite $cpu: $name passed with $isa kernels"
        passed=$((passed + 1))
      else
        grep -v '^ok' "$log" | head -n 40
        failed+=("$suite $cpu: $name")
        result=failed
      fi
      all+=$(cat "$log")$'\n'
    done
    add_target_row "$suite" "$cpu" "$result" "$all"
  done
}

# Each file holds suites: functions run_<suite> that count what passed, failed and was skipped.
for file in "$root"/tests/suites/*.sh; do
  # shellcheck source=/dev/null
  . "$file"
done

# shellcheck source-path=SCRIPTDIR source=side_by_side.sh
. "$root/tests/side_by_side.sh"
if [ -n "$part" ]; then
  run_part "$part"
  exit
fi
# shellcheck disable=SC2086  # names of suites
set -- ${suites:-native}
if [ $# -gt 1 ]; then run_side_by_side "$@"; else run_part "$1"; fi

if [ ${#table[@]} -gt 0 ]; then
  printf '\n== the synthetic scene on each target\n'
  print_table
fi
echo
echo "== summary"
[ ${#failed[@]} -eq 0 ] || printf 'failed:  %s\n' "${failed[@]}"
[ ${#skipped[@]} -eq 0 ] || printf 'skipped: %s\n' "${skipped[@]}"
echo "$passed passed, ${#failed[@]} failed, ${#skipped[@]} skipped"
[ ${#failed[@]} -eq 0 ]
