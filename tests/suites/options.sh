# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# Libraries that CMake's options leave parts out of: what they hold gives the same maps, the rest is refused.

# smaller NAME OPTION...: builds a library with these CMake options, and links the objects of the whole library's program with
# it: no option changes what a program compiles.
smaller() {
  local name=$1 host=${whole%/*}
  shift
  expect "$name, build" build "$root" "$out/$name" bsm -DCMAKE_BUILD_TYPE=Release -DBSM_WERROR=ON -DBSM_BUILD_TESTS=OFF \
    -DBSM_BUILD_BENCH=OFF -DBSM_BUILD_PROGRAM=OFF "$@" &&
    expect "$name, program" "${CXX:-c++}" "$host"/CMakeFiles/bsm_program.dir/*.o "$host/libbsm_host.a" "$out/$name/core/libbsm.a" \
      -pthread -o "$out/$name/bsm"
}

# same_map NAME MATCH_OPTION...: its program writes the map that the whole library's writes.
same_map() {
  local name=$1
  shift
  "$out/$name/bsm" match "$out/left.pgm" "$out/right.pgm" -o "$out/smaller.pgm" --disparities 32 "$@" &&
    "$whole" match "$out/left.pgm" "$out/right.pgm" -o "$out/whole.pgm" --disparities 32 "$@" &&
    cmp "$out/smaller.pgm" "$out/whole.pgm"
}

# same NAME MATCH_OPTION... and refused NAME TEXT MATCH_OPTION...: one check each.
same() { expect "$1, the same map: ${*:2}" same_map "$@"; }
refused() {
  local name=$1 text=$2
  shift 2
  expect "$name, refused: $*" refuses "$text" "$out/$name/bsm" match "$out/left.ppm" "$out/right.ppm" \
    -o "$out/refused.pgm" --disparities 32 "$@"
}

run_options() {
  local out=$root/build/options whole=$root/build/tests/platform/host/bsm
  mkdir -p "$out"
  echo "== options: building in $out"
  expect "whole library, build" build "$root" "$root/build/tests" bsm_program -DCMAKE_BUILD_TYPE=Release -DBSM_WERROR=ON &&
    expect "scene" "$whole" demo "$out" --width 160 --height 120 --disparities 32 || return
  expect "views in gray" gray_pair "$out"

  if smaller sgm -DBSM_LOCAL=OFF -DBSM_COLOR=OFF; then
    same sgm --preset fast
    same sgm --preset balanced --right-costs left
    same sgm --preset fast --paths 8 --stage aggregated
    same sgm --preset fast --isa scalar
    refused sgm "the method is unknown or was not built" --preset paper --bits 256
    refused sgm "the stage is unknown" --stage masked
    refused sgm "the pixel format is unknown or was not built" --preset fast
  fi
  if smaller local -DBSM_SGM=OFF; then
    same local --preset paper --bits 512
    same local --preset local
    same local --preset paper --bits 64 --stage cost --isa scalar
    refused local "the method is unknown or was not built" --preset fast
  fi
  if smaller checked "${no_wide_vectors[@]}" -DBSM_REFINEMENT=OFF -DBSM_CONFIDENCE=OFF; then
    same checked --preset balanced --stage checked
    same checked --preset paper --bits 256 --stage checked --isa scalar
    refused checked "the stage is unknown" --preset fast
    refused checked "confidence is neither 0 nor 1, or was not built" --stage checked --confidence-out "$out/refused-confidence.pgm"
  fi
  if smaller silent "${no_wide_vectors[@]}" -DBSM_TEXT=OFF; then
    same silent --preset fast
    refused silent "--bits: -9" --preset fast --bits 2048
  fi
  expect "no scalar kernels on this machine, refused" refuses "is for Cortex-M" cmake -S "$root" -B "$out/no-scalar" \
    -DBSM_BUILD_TESTS=OFF -DBSM_SCALAR=OFF
  expect "no method, refused" refuses "both off" cmake -S "$root" -B "$out/no-method" -DBSM_LOCAL=OFF -DBSM_SGM=OFF
  expect "tests of a part, refused" refuses "the whole library" cmake -S "$root" -B "$out/part-tests" -DBSM_SGM=OFF
}
