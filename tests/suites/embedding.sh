# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# The library inside other projects: installed, as a subdirectory, and as packages.

# An installed tree works after it was moved, from CMake and from pkg-config, and for the version that the header says alone.
installed_tree() {
  local kind=$1 tree=$2 moved=$2-moved version=$3
  rm -rf "$moved"
  mv "$tree" "$moved"
  expect "$kind, find_package" build "$here/installed" "$out/$kind-consumer" all "-DCMAKE_PREFIX_PATH=$moved" "-DBSM_WANTED_VERSION=$version" &&
    expect "$kind, find_package's program runs" "$out/$kind-consumer/consumer"
  expect "$kind, find_package refuses another version" refuses "99.0" \
    build "$here/installed" "$out/$kind-refused" all "-DCMAKE_PREFIX_PATH=$moved" -DBSM_WANTED_VERSION=99.0
  if require_tools pkg-config > /dev/null 2>&1; then
    expect "$kind, pkg-config" with_pkg_config "$moved" "$version" "$out/$kind-pkg-config"
  else
    skipped+=("embedding $kind, pkg-config: pkg-config is not installed and cannot be installed here")
  fi
}

# A C compiler alone and what pkg-config says make a program that runs; no path leads out of the tree.
with_pkg_config() {
  local version=$2 program=$3 folder flags library
  folder=$(find "$1" -type d -name pkgconfig)
  flags=$(PKG_CONFIG_LIBDIR=$folder pkg-config --cflags --libs bsm) || return
  [ "$(PKG_CONFIG_LIBDIR=$folder pkg-config --modversion bsm)" = "$version" ] || return
  library=$(PKG_CONFIG_LIBDIR=$folder pkg-config --variable=libdir bsm) || return
  echo "flags: $flags"
  # shellcheck disable=SC2086  # flags are words of their own
  ${CC:-cc} -std=c99 "$root/tests/test_c99.c" $flags "-Wl,-rpath,$library" -o "$program" && "$program"
}

# Functions that bsm.h declares, sorted.
public_functions() {
  sed -nE 's/^BSM_API .*[ *](bsm_[a-z_]+)\(.*/\1/p' "$root/core/include/bsm/bsm.h" | sort
}

# A shared library shows the functions of bsm.h and nothing else.
shows_public_functions_alone() {
  local shown
  shown=$(nm -D --defined-only "$1" | awk '{ print $3 }' | sort)
  diff <(public_functions) - <<< "$shown" && [ "$(wc -l <<< "$shown")" -ge 10 ]
}

has_soname() { readelf -d "$1" | grep -F "Library soname: [$2]"; }

is_empty_folder() { [ -z "$(find "$1" -mindepth 1 2> /dev/null)" ]; }

run_embedding() {
  local here=$root/tests/embedding out=$root/build/embedding native=$root/build/tests version library
  version=$(sed -nE 's/^#define BSM_VERSION_[A-Z]+ ([0-9]+)$/\1/p' "$root/core/include/bsm/bsm.h" | paste -sd .)
  rm -rf "$out"
  mkdir -p "$out"
  echo "== embedding: building in $out"

  # The static library is the native suite's.
  if expect "static, build" build "$root" "$native" all -DCMAKE_BUILD_TYPE=Release -DBSM_WERROR=ON &&
    expect "static, install" cmake --install "$native" --prefix "$out/static"; then
    expect "the project has the header's version" grep -qx "CMAKE_PROJECT_VERSION:STATIC=$version" "$native/CMakeCache.txt"
    installed_tree static "$out/static" "$version"
  fi

  # A strict parent compiles bsm under its own warnings; one without any sees none of bsm's, and installs the shared library.
  if expect "strict parent, add_subdirectory" build "$here/parent" "$out/strict" all -DPARENT_IS_STRICT=ON; then
    expect "strict parent, its program runs" "$out/strict/consumer"
    expect "strict parent, nothing to install" cmake --install "$out/strict" --prefix "$out/nothing"
    expect "strict parent, nothing installed" is_empty_folder "$out/nothing"
  fi
  if expect "sloppy parent, FetchContent, shared" build "$here/parent" "$out/sloppy" all \
    -DPARENT_FETCHES=ON -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON -DBSM_INSTALL=ON &&
    expect "shared, install" cmake --install "$out/sloppy" --prefix "$out/shared"; then
    if [ "$(uname -s)" = Linux ]; then
      library=$(find "$out/shared" -name libbsm.so)
      expect "shared, shows the public functions alone" shows_public_functions_alone "$library"
      expect "shared, versioned name" has_soname "$library.$version" "libbsm.so.${version%%.*}"
    else
      skipped+=("embedding shared, public functions and versioned name: read on Linux alone")
    fi
    installed_tree shared "$out/shared" "$version"
  fi
}
