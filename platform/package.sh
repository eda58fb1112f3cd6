#!/usr/bin/env bash
# Lays out the library as the package that a registry of embedded libraries wants, from the two-file amalgamation.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
  cat << 'END'
usage: bash platform/package.sh arduino|esp-idf|zephyr FOLDER

Writes FOLDER/bsm, which replaces one of that name that an earlier run wrote: an Arduino and PlatformIO library, an ESP-IDF
component or a Zephyr module. Needs CMake 3.16 and a C++ compiler. Each kind's README says how to add it to a project.
END
}

case ${1-} in
  arduino | esp-idf | zephyr) ;;
  -h | --help)
    usage
    exit 0
    ;;
  *)
    echo "package.sh: '${1-}': unknown kind of package" >&2
    usage >&2
    exit 2
    ;;
esac
if [ $# != 2 ]; then
  echo "package.sh: give one FOLDER" >&2
  usage >&2
  exit 2
fi
kind=$1
package=$2/bsm
template=$root/platform/$kind
build=$root/build/package

if [ -e "$package" ] && [ ! -f "$package/bsm-package" ]; then
  echo "package.sh: $package is there and no package of an earlier run; move it away or name another folder" >&2
  exit 1
fi
mkdir -p "$build"
if ! { cmake -S "$root" -B "$build" -DBSM_BUILD_PROGRAM=OFF -DBSM_BUILD_TESTS=OFF -DBSM_BUILD_BENCH=OFF &&
  cmake --build "$build" --target bsm_amalgamation; } > "$build/package.log" 2>&1; then
  cat "$build/package.log" >&2
  echo "package.sh: writing the two files failed; the output is above and in $build/package.log" >&2
  exit 1
fi
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")

rm -rf "$package"
mkdir -p "$package"
cp -R "$template/." "$package"
cp "$root/LICENSE" "$package"
echo "bsm $version for $kind, written by platform/package.sh" > "$package/bsm-package"
# Arduino compiles src/ alone and includes <bsm.h>; the others include <bsm/bsm.h>.
case $kind in
  arduino) sources=$package/src ;;
  *) sources=$package/bsm ;;
esac
mkdir -p "$sources"
cp "$build/amalgamation/bsm/bsm.h" "$build/amalgamation/bsm/bsm.cpp" "$sources"
# Manifests say the version.
for file in "$package"/*.in; do
  [ -f "$file" ] || continue
  sed "s/@VERSION@/$version/g" "$file" > "${file%.in}"
  rm "$file"
done
echo "$package: bsm $version"
