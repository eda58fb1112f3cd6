#!/usr/bin/env bash
# measure.sh - what the library takes on Cortex-M: flash by core and CMake options, stack, arena and instructions of a frame.
set -eu -o pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$root/build/measure

usage() {
  cat << 'END'
usage: bash platform/cortexm/measure.sh [CORE...]
       bash platform/cortexm/measure.sh --flash BUILD

Builds the library in build/measure for each CORE (m0 m3 m4 m7 m33 m55; all of them without a name), with everything and with
parts left out, runs the image probe under qemu-system-arm and prints three tables in Markdown: bytes of flash, stack, costs of
a frame of 160 x 120 with 32 disparities. Installs the compiler and qemu on Debian and Ubuntu when it may.

  --flash BUILD   prints one number: the bytes of code and constants of the library in a build folder for Cortex-M
END
}

fail() {
  echo "measure.sh: $1" >&2
  exit "$2"
}

# The functions of bsm.h.
public_functions() { sed -nE 's/^BSM_API .*(bsm_[a-z_]+)\(.*/\1/p' "$root/core/include/bsm/bsm.h"; }

# flash BUILD: code and constants that the functions of bsm.h reach, with the memory functions and the compiler's integer helpers.
flash() {
  local folder=$1 flags wanted=()
  flags=$(sed -n 's/^CMAKE_CXX_FLAGS:STRING=//p' "$folder/CMakeCache.txt")
  mapfile -t wanted < <(public_functions | sed 's/^/-Wl,-u,/')
  # shellcheck disable=SC2086  # the flags are words
  arm-none-eabi-g++ $flags -nostdlib -Wl,--gc-sections -Wl,--entry=bsm_open "${wanted[@]}" "$folder/core/libbsm.a" \
    "$folder/platform/cortexm/CMakeFiles/bsm_startup.dir/memory.cpp.obj" -lgcc -Wl,--defsym=__aeabi_unwind_cpp_pr0=0 \
    -o "$folder/whole.elf"
  arm-none-eabi-size "$folder/whole.elf" | awk 'NR == 2 { print $1 }'
}

cores=()
case ${1-} in
  -h | --help)
    usage
    exit 0
    ;;
  --flash)
    [ $# -eq 2 ] || fail "--flash needs one build folder; see --help" 2
    [ -r "$2/core/libbsm.a" ] || fail "$2: holds no library" 1
    flash "$2"
    exit 0
    ;;
esac
for core in "$@"; do
  case $core in
    m0 | m3 | m4 | m7 | m33 | m55) cores+=("$core") ;;
    *) fail "$core: unknown core; see --help" 2 ;;
  esac
done
[ ${#cores[@]} -gt 0 ] || cores=(m0 m3 m4 m7 m33 m55)

# shellcheck source=/dev/null
. "$root/platform/host/require_tools.sh"
require_tools c++ cmake make arm-none-eabi-g++ qemu-system-arm || exit 1

# What a set leaves out.
sets=(everything no_local no_color dense sparse)
small="-DBSM_CONFIDENCE=OFF -DBSM_SCALAR=OFF -DBSM_TEXT=OFF"
declare -A options=(
  [everything]=""
  [no_local]="-DBSM_LOCAL=OFF"
  [no_color]="-DBSM_COLOR=OFF"
  [dense]="-DBSM_LOCAL=OFF -DBSM_COLOR=OFF $small"
  [sparse]="-DBSM_LOCAL=OFF -DBSM_COLOR=OFF -DBSM_REFINEMENT=OFF $small"
)
declare -A boards=([m0]=mps2-an385 [m3]=mps2-an385 [m4]=mps2-an386 [m7]=mps2-an500 [m33]=mps2-an505 [m55]=mps3-an547)

# build_set CORE SET TARGET..: with the frames and calls of each object beside it.
build_set() {
  local folder=$build/$1-$2 core=$1 set=$2
  shift 2
  # shellcheck disable=SC2086  # the options are words
  { cmake -S "$root" -B "$folder" "-DCMAKE_TOOLCHAIN_FILE=$root/toolchains/cortex-$core.cmake" -DCMAKE_BUILD_TYPE=Release \
    "-DCMAKE_CXX_FLAGS_RELEASE=-O3 -DNDEBUG -fcallgraph-info=su" ${options[$set]} &&
    cmake --build "$folder" --parallel "$(getconf _NPROCESSORS_ONLN)" --target "$@"; } > "$folder.log" 2>&1 ||
    fail "the build $core-$set failed; see $folder.log" 1
}

# chain BUILD FUNCTION..: the most bytes of stack that a call of one of the functions takes, from the frames and the calls that
# the compiler wrote. A kernel is called by pointer: the deepest one counts. A caller's parallel_for is the caller's.
chain() {
  local folder=$1
  shift
  find "$folder/core" -name '*.ci' -exec cat {} + | awk -v functions="$*" '
    function title(text) { sub(/^.*title: "/, "", text); sub(/".*/, "", text); return text }
    /^node:/ {
      name = title($0)
      if (match($0, /[0-9]+ bytes \(/)) frame[name] = substr($0, RSTART) + 0
    }
    /^edge:/ {
      from = $0; sub(/^.*sourcename: "/, "", from); sub(/".*/, "", from)
      to = $0; sub(/^.*targetname: "/, "", to); sub(/".*/, "", to)
      calls[from] = calls[from] SUBSEP to
    }
    function deepest(name,    list, count, i, most, depth) {
      if (name in known) return known[name]
      known[name] = 0
      count = split(calls[name], list, SUBSEP)
      for (i = 1; i <= count; ++i) {
        if (list[i] == "") continue
        if (list[i] == "__indirect_call") depth = name ~ /kernel_scratch_bytes/ ? 0 : by_pointer()
        else depth = deepest(list[i])
        if (depth > most) most = depth
      }
      return known[name] = most + frame[name]
    }
    function by_pointer(    name, depth) {
      if (kernels_known) return kernels
      kernels_known = 1
      for (name in frame) {
        if (name !~ /_(scalar|dsp|mve)ERKNS_[0-9]+[A-Za-z]+ArgsE$/) continue
        depth = deepest(name)
        if (depth > kernels) kernels = depth
      }
      return kernels
    }
    END {
      count = split(functions, list, " ")
      for (i = 1; i <= count; ++i) {
        depth = deepest(list[i])
        if (depth > most) most = depth
      }
      print most
    }'
}

# probe CORE ARGUMENT..: the image's line, with instructions counted.
probe() {
  local core=$1 board=${boards[$1]} arguments="enable=on,target=native,arg=image" word
  shift
  for word in "$@"; do arguments+=",arg=$word"; done
  timeout 300 qemu-system-arm -M "$board" -icount shift=0 -kernel "$build/$core-everything/platform/cortexm/probe-$board.elf" \
    -display none -monitor none -serial none -semihosting-config "$arguments" 2>&1
}

value_of() { sed -nE "s/.*\b$1=([0-9]+).*/\1/p"; }

mkdir -p "$build"
for core in "${cores[@]}"; do
  echo "measure.sh: building for $core" >&2
  for set in "${sets[@]}"; do build_set "$core" "$set" bsm bsm_startup; done
  build_set "$core" everything "probe-${boards[$core]}"
done

echo "| flash in bytes | everything | without local | gray8 alone | sgm, gray8 | sgm, gray8, sparse |"
echo "|---|---|---|---|---|---|"
for core in "${cores[@]}"; do
  row="| Cortex-${core^^} |"
  for set in "${sets[@]}"; do row+=" $(flash "$build/$core-$set") |"; done
  echo "$row"
done
echo

# The format comes first: presets depend on it.
gray=(width=160 height=120 disparities=32 format=gray8)
color=(width=160 height=120 disparities=32 format=rgb24)
paper=("${color[@]}" preset=paper bits=128)
echo "| stack in bytes | bsm_open, by calls | a row, by calls | a frame, by calls | used by fast | used by paper |"
echo "|---|---|---|---|---|---|"
for core in "${cores[@]}"; do
  whole=$build/$core-everything
  echo "| Cortex-${core^^} | $(chain "$whole" bsm_open) | $(chain "$whole" bsm_push_row bsm_pull_row) |" \
    "$(chain "$whole" bsm_process) | $(probe "$core" "${color[@]}" preset=fast frame=1 | value_of stack) |" \
    "$(probe "$core" "${paper[@]}" frame=1 | value_of stack) |"
done
echo

# cost CORE ARGUMENT..: million instructions of a frame, row by row, and KB of the arena.
cost() {
  local line
  line=$(probe "$@") || fail "$*: $line" 1
  awk -v instructions="$(value_of instructions <<< "$line")" -v arena="$(value_of arena <<< "$line")" \
    'BEGIN { printf " %.0f / %.0f |", instructions / 1e6, arena / 1024 }'
}
echo "| million instructions / arena in KB | fast, gray8, right_costs 1 | fast, gray8 | fast, rgb24, right_costs 1 | fast, rgb24 | paper, 128 bits, rgb24 |"
echo "|---|---|---|---|---|---|"
for core in "${cores[@]}"; do
  row="| Cortex-${core^^} |"
  row+=$(cost "$core" "${gray[@]}" preset=fast speckle=0 right_costs=1)
  row+=$(cost "$core" "${gray[@]}" preset=fast speckle=0)
  row+=$(cost "$core" "${color[@]}" preset=fast speckle=0 right_costs=1)
  row+=$(cost "$core" "${color[@]}" preset=fast speckle=0)
  echo "$row$(cost "$core" "${paper[@]}")"
done
