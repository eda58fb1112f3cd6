#!/usr/bin/env bash
# arm_counts.sh - instructions of a matched frame on AArch64 and ARMv7, by preset, descriptor length and function, counted
# under qemu; estimates of llvm-mca for the hottest loop of each kernel on Cortex-A53, A55 and A72.
set -eu -o pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/arm_counts
disparities=60
functions=12

usage() {
  cat << 'END'
usage: bash bench/arm_counts.sh LEFT RIGHT [--disparities N] [--quick]

LEFT and RIGHT are a rectified pair as PPM or PGM. Builds in build/arm_counts what it needs, installs the cross compilers, qemu
and LLVM on Debian and Ubuntu when it may, and prints, for one thread:

  * instructions of a frame for the presets and, for the local method and sgm, against the number of descriptor bits
  * instructions of a frame by function, for AArch64 with NEON and the presets fast and paper
  * instructions of four rows matched without and with each saving of the NEON kernel, for the presets local and paper
  * estimates of llvm-mca, cycles for one round of each kernel's hottest loop

Instructions are exact and the same on every machine; times of a real processor they are not.

  --disparities N   range searched, default 60
  --quick           the preset fast alone, no lengths, no savings
END
}

fail() {
  echo "arm_counts.sh: $1" >&2
  exit "$2"
}

pair=()
quick=0
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help)
      usage
      exit 0
      ;;
    --disparities)
      [ $# -ge 2 ] || fail "--disparities needs a number" 2
      disparities=$2
      shift
      ;;
    --quick) quick=1 ;;
    -*) fail "$1: unknown option; see --help" 2 ;;
    *) pair+=("$1") ;;
  esac
  shift
done
[ ${#pair[@]} = 2 ] || fail "give the left and the right image; see --help" 2
for image in "${pair[@]}"; do [ -r "$image" ] || fail "$image: cannot be read" 1; done

# shellcheck source=../platform/host/require_tools.sh
. "$root/platform/host/require_tools.sh"
require_tools cc cmake make aarch64-linux-gnu-g++ arm-linux-gnueabihf-g++ qemu-aarch64 qemu-arm llvm-mca-16 || exit 1

mkdir -p "$build"
cc -std=c99 -Wall -Wextra -O2 -shared -fPIC -fvisibility=hidden "$root/bench/qemu/count_instructions.c" -o "$build/count.so"
for target in aarch64-linux-gnu arm-linux-gnueabihf; do
  { cmake -S "$root" -B "$build/$target" "-DCMAKE_TOOLCHAIN_FILE=$root/toolchains/$target.cmake" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_EXE_LINKER_FLAGS=-static -DBSM_BUILD_TESTS=OFF -DBSM_BUILD_BENCH=ON &&
    cmake --build "$build/$target" --parallel "$(getconf _NPROCESSORS_ONLN)" --target bsm_program bsm_bench; } > "$build/build.log" 2>&1 ||
    fail "the build for $target failed; see $build/build.log" 1
done

program() { echo "$build/$1/platform/host/bsm"; }

# blocks TARGET CPU OPTION...: what ran for a match of the pair, as the plugin writes it.
blocks() {
  local target=$1 cpu=$2 emulator=qemu-arm
  shift 2
  [ "$target" = aarch64-linux-gnu ] && emulator=qemu-aarch64
  "$emulator" -cpu "$cpu" -plugin "$build/count.so,out=$build/blocks" "$(program "$target")" match "${pair[@]}" \
    -o "$build/map.pfm" --disparities "$disparities" "$@" > /dev/null
  cat "$build/blocks"
}

# saving_count OPTION...: instructions of bsm_bench savings on AArch64.
saving_count() {
  qemu-aarch64 -cpu cortex-a53 -plugin "$build/count.so,out=$build/blocks" "$build/aarch64-linux-gnu/bench/bsm_bench" savings \
    "${pair[@]}" --disparities "$disparities" "$@" > /dev/null && total < "$build/blocks"
}

# form_count FORM OPTION...: of one run of a form of a saving over the sampled rows.
form_count() {
  local form=$1 once
  shift
  once=$(saving_count --count "$form" --repeat 1 "$@") && echo $(($(saving_count --count "$form" --repeat 2 "$@") - once))
}

# print_savings OPTION...: each saving of the NEON kernels without and with it.
print_savings() {
  local saving plain saved
  while IFS= read -r saving; do
    plain=$(form_count plain --filter "$saving" "$@") && saved=$(form_count saved --filter "$saving" "$@")
    awk -v name="$saving" -v plain="$plain" -v saved="$saved" \
      'BEGIN { printf "%8.2f M without  %8.2f M with  x %.2f  %s\n", plain / 1e6, saved / 1e6, plain / saved, name }'
  done < <(qemu-aarch64 "$build/aarch64-linux-gnu/bench/bsm_bench" savings "${pair[@]}" --list --filter _neon "$@")
}

total() { awk '{ sum += $1 * $2 } END { printf "%.0f\n", sum }'; }

# What a program runs for its files and its start: a run less what a second frame adds. It hardly depends on the options.
host_part() {
  local once twice
  once=$(blocks "$1" "$2" --preset fast --repeat 1 | total)
  twice=$(blocks "$1" "$2" --preset fast --repeat 2 | total)
  echo $((2 * once - twice))
}

# print_frame TARGET CPU NAME OPTION...
print_frame() {
  local target=$1 cpu=$2 name=$3 count
  shift 3
  count=$(blocks "$target" "$cpu" "$@" | total)
  awk -v name="$name" -v count="$((count - host))" -v options="$*" \
    'BEGIN { printf "%-10s %9.1f M instructions  %s\n", name, count / 1e6, options }'
}

by_function() {
  blocks aarch64-linux-gnu cortex-a53 "$@" |
    awk '{ sum[$4] += $1 * $2 } END { for (f in sum) printf "%9.1f M instructions  %s\n", sum[f] / 1e6, f }' | sort -rn |
    head -n "$functions" | c++filt -p
}

# print_loops OPTION...: the hottest block of each kernel that runs.
print_loops() {
  local address size kernel cpu code cycles
  blocks aarch64-linux-gnu cortex-a53 "$@" > "$build/hot"
  aarch64-linux-gnu-objdump -d --no-show-raw-insn "$(program aarch64-linux-gnu)" > "$build/code"
  while read -r address size kernel; do
    # Targets of branches and page addresses become a name: llvm-mca places nothing.
    code=$(awk -v from="$address:" -v size="$size" '$1 == from { on = 1 } on && size-- > 0 { $1 = ""; print }' "$build/code" |
      sed -e 's,//.*,,' -e 's/[0-9a-f]* <.*>/target/')
    printf '%-28s %4d instructions a round, estimate of cycles' "$kernel" "$size"
    for cpu in cortex-a53 cortex-a55 cortex-a72; do
      cycles=$(llvm-mca-16 -mtriple=aarch64 -mcpu=$cpu -iterations=100 2> /dev/null <<< "$code" |
        awk '/^Total Cycles/ { print $3 / 100 }')
      printf '  %s %s' "${cpu#cortex-}" "$cycles"
    done
    echo
  done < <(kernel_blocks)
}

kernel_objects() { ls "$build/aarch64-linux-gnu/core/CMakeFiles/bsm.dir/__/simd/arm/"*_neon.cpp.o; }

# The functions of an object's kernel.
functions_of() { aarch64-linux-gnu-nm --defined-only "$1" | awk '$2 ~ /[tT]/ && $3 !~ /_scratchER/ { print $3 }'; }

# Address, size and kernel of the block of each kernel's file in which most instructions run.
kernel_blocks() {
  local object kernel
  for object in $(kernel_objects); do
    kernel=$(basename "$object" .cpp.o)
    # A name that several files give to functions of their own tells none of them.
    functions_of "$object" | grep -Fxvf <(shared_functions) |
      awk -v kernel="$kernel" '
        NR == FNR { own[$1] = 1; next }
        ($4 in own) && $1 * $2 > most { most = $1 * $2; line = $3 " " $2 " " kernel }
        END { if (most > 0) print line }' - "$build/hot"
  done
}

shared_functions() {
  local object
  echo "-"
  for object in $(kernel_objects); do functions_of "$object"; done | sort | uniq -d
}

for entry in "aarch64-linux-gnu cortex-a53" "arm-linux-gnueabihf cortex-a7"; do
  read -r target cpu <<< "$entry"
  host=$(host_part "$target" "$cpu")
  echo "== $target, NEON kernels: a frame in one thread"
  print_frame "$target" "$cpu" fast --preset fast
  [ "$quick" = 1 ] && continue
  print_frame "$target" "$cpu" balanced --preset balanced
  print_frame "$target" "$cpu" paper --preset paper
  [ "$target" = aarch64-linux-gnu ] || continue
  echo "-- against the number of bits"
  for bits in 64 128 256 512 1024; do print_frame "$target" "$cpu" "sgm $bits" --preset balanced --bits $bits; done
  for bits in 256 512 1024 2048 4096; do
    print_frame "$target" "$cpu" "local $bits" --preset local --bits $bits
  done
done

presets=(fast)
[ "$quick" = 1 ] || presets+=(paper)
for preset in "${presets[@]}"; do
  echo "== aarch64-linux-gnu, NEON kernels: a frame with the preset $preset, by function"
  by_function --preset "$preset"
  echo "== aarch64-linux-gnu, NEON kernels: the hottest loop of each kernel with the preset $preset, estimates of llvm-mca"
  print_loops --preset "$preset"
done

[ "$quick" = 1 ] && exit 0
for preset in local paper; do
  echo "== aarch64-linux-gnu, NEON kernels: four rows without and with each saving, preset $preset"
  print_savings --preset "$preset"
done
