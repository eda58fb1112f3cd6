#!/usr/bin/env bash
# Builds bsm and runs 'bsm demo': a synthetic stereo pair is matched, measured and shown in pictures.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=$root/build/demo
pictures=$root/out/demo

case ${1-} in
  -h | --help)
    echo "usage: bash platform/host/demo.sh [options of 'bsm demo']"
    echo
    echo "Checks for a C++ compiler, CMake and make (installs them on Debian and Ubuntu when it may), builds bsm in"
    echo "$build, runs 'bsm demo' and leaves the pictures in"
    echo "$pictures. Options such as --bits 256 or --threads 1 go to 'bsm demo'."
    exit 0
    ;;
esac

. "$here/require_tools.sh"
require_tools cc c++ cmake make

# Runs a command whose output matters only when it fails.
quietly() {
  local log=$build/build.log
  "$@" > "$log" 2>&1 && return 0
  cat "$log" >&2
  echo "demo.sh: building failed; the output is above and in $log" >&2
  return 1
}

mkdir -p "$build"
echo "building bsm in $build" >&2
quietly cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DBSM_BUILD_PROGRAM=ON -DBSM_BUILD_TESTS=OFF -DBSM_BUILD_BENCH=OFF
quietly cmake --build "$build" --config Release --target bsm_program --parallel "$(getconf _NPROCESSORS_ONLN 2> /dev/null || echo 2)"

"$build/platform/host/bsm" demo "$pictures" "$@"
echo "your own pair: $build/platform/host/bsm match left.ppm right.ppm -o depth.png --color --disparities 64"
