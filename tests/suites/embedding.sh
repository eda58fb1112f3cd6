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

# run_amalgamation FOLDER EMULATOR ISA...: what the two-file library made of each instruction set's flags computes the hashes of
# all builds, with the kernels of that set; slow runs compute those of the presets alone.
run_amalgamation() {
  local folder=$1 emulator=$2 isa cases
  shift 2
  for isa in "$@"; do
    # shellcheck disable=SC2086  # the emulator's options are words of their own
    expect "amalgamation $isa, its kernels run" env "BSM_EXPECT_ISA=$isa" $emulator "$folder/c99_$isa"
    cases=
    if [ -n "$emulator" ] || [ "$isa" = scalar ]; then cases=presets; fi
    # shellcheck disable=SC2086
    expect "amalgamation $isa, golden hashes" $emulator "$folder/golden_$isa" --filter "$cases"
  done
}

# The amalgamation for this machine, and for AArch64 under emulation.
check_amalgamation() {
  local features isa machine=$root/build/arm64 isas=()
  expect "amalgamation, written" cmake --build "$native" --target bsm_amalgamation || return
  if expect "amalgamation, compiles under all flags" build "$here/amalgamation" "$out/amalgamation" all "-DBUILD=$native"; then
    features=$("$native/platform/host/bsm" info | sed -n 's/^CPU features: //p')
    for isa in scalar sse42 avx2 avx512 neon sve; do
      if [ ! -x "$out/amalgamation/c99_$isa" ]; then
        continue # another machine's
      elif [ $isa != scalar ] && [[ " $features " != *" ${isa/avx512/avx512vpopcntdq} "* ]]; then
        skipped+=("embedding amalgamation $isa: this machine lacks it")
      else
        isas+=("$isa")
      fi
    done
    expect "amalgamation, made for this machine" [ ${#isas[@]} -gt 0 ]
    run_amalgamation "$out/amalgamation" "" "${isas[@]}"
  fi

  if [ "$(uname -m)" = aarch64 ]; then
    return
  elif ! require_tools aarch64-linux-gnu-g++ qemu-aarch64 > /dev/null 2>&1; then
    skipped+=("embedding amalgamation for AArch64: aarch64-linux-gnu-g++ or qemu-aarch64 is not installed and cannot be installed here")
  elif expect "amalgamation for AArch64, objects of the tests" build "$root" "$machine" test_golden \
    "-DCMAKE_TOOLCHAIN_FILE=$root/toolchains/aarch64-linux-gnu.cmake" -DCMAKE_BUILD_TYPE=Release -DBSM_WERROR=ON -DBSM_BUILD_BENCH=OFF "$joined" &&
    expect "amalgamation for AArch64, compiles" build "$here/amalgamation" "$out/amalgamation-arm64" all "-DBUILD=$machine" \
      "-DAMALGAMATION=$native/amalgamation" "-DCMAKE_TOOLCHAIN_FILE=$root/toolchains/aarch64-linux-gnu.cmake"; then
    run_amalgamation "$out/amalgamation-arm64" "qemu-aarch64 -L /usr/aarch64-linux-gnu" neon sve
  fi
}

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

  # A strict parent compiles bsm under its own warnings; one without any, which joins its sources, sees none of bsm's, and
  # installs the shared library.
  if expect "strict parent, add_subdirectory" build "$here/parent" "$out/strict" all -DPARENT_IS_STRICT=ON; then
    expect "strict parent, its program runs" "$out/strict/consumer"
    expect "strict parent, nothing to install" cmake --install "$out/strict" --prefix "$out/nothing"
    expect "strict parent, nothing installed" is_empty_folder "$out/nothing"
  fi
  if expect "sloppy parent, FetchContent, shared" build "$here/parent" "$out/sloppy" all \
    -DPARENT_FETCHES=ON -DCMAKE_BUILD_TYPE=Release "$joined" -DBUILD_SHARED_LIBS=ON -DBSM_INSTALL=ON &&
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

  check_amalgamation
}
