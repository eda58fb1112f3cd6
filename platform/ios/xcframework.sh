#!/usr/bin/env bash
# Builds bsm.xcframework, static libraries for iOS, its simulator and macOS with the module map for Swift. Runs on macOS.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

usage() {
  cat << 'END'
usage: bash platform/ios/xcframework.sh [--dry-run] FOLDER

Writes FOLDER/bsm.xcframework; one of an earlier run is replaced. Needs Xcode and CMake. --dry-run prints the commands and runs
none of them, on any machine.
END
}

dry=
if [ "${1-}" = --dry-run ]; then
  dry=1
  shift
fi
case ${1-} in
  -h | --help)
    usage
    exit 0
    ;;
  -* | "")
    echo "xcframework.sh: '${1-}': give the FOLDER to write to" >&2
    usage >&2
    exit 2
    ;;
esac
out=$1
build=$root/build/xcframework

if [ -z "$dry" ]; then
  for tool in cmake xcrun xcodebuild; do
    command -v "$tool" > /dev/null || {
      echo "xcframework.sh: $tool is missing: install Xcode and CMake, or print the commands with --dry-run" >&2
      exit 1
    }
  done
fi

# Prints a command and, unless the run is dry, runs it.
run() {
  printf '%q ' "$@"
  echo
  [ -n "$dry" ] || "$@"
}

# slice NAME SYSTEM SDK OLDEST ARCH...: one library for all architectures of a platform, joined from one for each.
slice() {
  local name=$1 system=$2 sdk=$3 oldest=$4 arch library archives=()
  shift 4
  for arch in "$@"; do
    run cmake -S "$root" -B "$build/$name-$arch" "-DCMAKE_SYSTEM_NAME=$system" "-DCMAKE_SYSTEM_PROCESSOR=$arch" \
      "-DCMAKE_OSX_SYSROOT=$sdk" "-DCMAKE_OSX_ARCHITECTURES=$arch" "-DCMAKE_OSX_DEPLOYMENT_TARGET=$oldest" \
      -DCMAKE_BUILD_TYPE=Release -DBSM_BUILD_PROGRAM=OFF -DBSM_BUILD_TESTS=OFF -DBSM_BUILD_BENCH=OFF
    run cmake --build "$build/$name-$arch" --target bsm
    archives+=("$build/$name-$arch/core/libbsm.a")
  done
  library=$build/$name/libbsm.a
  run mkdir -p "$build/$name"
  run xcrun lipo -create "${archives[@]}" -output "$library"
  libraries+=(-library "$library" -headers "$build/headers")
}

libraries=()
run rm -rf "$build/headers" "$out/bsm.xcframework"
run mkdir -p "$build/headers/bsm" "$out"
run cp "$root/core/include/bsm/bsm.h" "$build/headers/bsm"
run cp "$root/platform/ios/module.modulemap" "$build/headers"
slice ios iOS iphoneos 12.0 arm64
slice simulator iOS iphonesimulator 12.0 arm64 x86_64
slice macos Darwin macosx 10.13 arm64 x86_64
run xcodebuild -create-xcframework "${libraries[@]}" -output "$out/bsm.xcframework"
