# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# Systems whose SDK is not here: the library compiles for them with clang and the C headers that come with it, which is all that
# it includes, and makes no frame above 1 KB, which is a warning and so an error. Nothing is linked or run.

# compiles_for_system FOLDER TARGET OPTION...
compiles_for_system() {
  local folder=$1 target=$2
  shift 2
  build "$root" "$folder" bsm "-DCMAKE_TOOLCHAIN_FILE=$root/toolchains/clang.cmake" "-DBSM_TARGET=$target" -DCMAKE_BUILD_TYPE=Release \
    -DBSM_WERROR=ON -DBSM_BUILD_TESTS=OFF -DBSM_BUILD_PROGRAM=OFF -DBSM_BUILD_BENCH=OFF "$@"
}

# The objects are for the machine that the target names.
is_for() {
  local headers
  headers=$(llvm-readobj-16 --file-headers "$1/core/libbsm.a") && grep -i "^Arch: $2" <<< "$headers"
}

# listed_kernels ISA|ISA..: the kernels of these instruction sets in the list, sorted.
listed_kernels() {
  sed -nE "s/^BSM_KERNEL\(([a-z]+), ([a-z]+), ($1),.*/\1_\2_\3/p" "$root/simd/kernels.def" | sort
}

# compiled_kernels NM_OPTION... OBJECT...: the kernels among the symbols, sorted.
compiled_kernels() {
  llvm-nm-16 --demangle --quiet "$@" | sed -nE 's/^(.* T )?bsm::([a-z]+_[a-z]+_[a-z0-9]+)\(bsm::[A-Za-z]+Args const&\)$/\2/p' | sort
}

# slice_has FOLDER MACHINE ISA|ISA..: what a universal build holds for a machine are the kernels of these instruction sets, and
# it chooses from them.
slice_has() {
  local objects=$1/core/CMakeFiles/bsm.dir/__/simd machine=$2 listed
  listed=$(listed_kernels "$3")
  diff <(echo "$listed") <(compiled_kernels "--arch=$machine" --defined-only "$objects"/*/*.o) &&
    diff <(echo "$listed") <(compiled_kernels "--arch=$machine" --undefined-only "$objects/kernels.cpp.o") &&
    [ "$(wc -l <<< "$listed")" -gt 20 ]
}

# Both machines of Apple's at once: clang joins their objects by the program lipo, here LLVM's.
check_universal() {
  local folder=$root/build/nosdk/macos-universal tools=$root/build/nosdk/tools
  mkdir -p "$tools" && ln -sf "$(command -v llvm-lipo-16)" "$tools/lipo"
  PATH=$tools:$PATH expect "macos-universal compiles" compiles_for_system "$folder" arm64-apple-macos11 \
    "-DCMAKE_OSX_ARCHITECTURES=arm64;x86_64" || return
  expect "macos-universal, kernels for arm64" slice_has "$folder" arm64 "scalar|neon"
  expect "macos-universal, kernels for x86_64" slice_has "$folder" x86_64 "scalar|sse42|avx2|avx512"
}

run_nosdk() {
  # shellcheck disable=SC2034  # read by expect
  local suite=nosdk
  local entry name target arch
  if ! require_tools clang++-16 llvm-ar-16 > /dev/null 2>&1; then
    skipped+=("nosdk: clang-16 or llvm-16 is not installed and cannot be installed here (Debian and Ubuntu: apt-get install clang-16 llvm-16)")
    return
  fi
  echo "== nosdk: objects for systems without their SDK"
  for entry in android-arm64:aarch64:aarch64-linux-android21 android-armv7:arm:armv7a-linux-androideabi21 \
    ios-arm64:aarch64:arm64-apple-ios12 macos-arm64:aarch64:arm64-apple-macos11 macos-x86_64:x86_64:x86_64-apple-macos11 \
    windows-arm64:aarch64:aarch64-pc-windows-msvc windows-x64:x86_64:x86_64-pc-windows-msvc; do
    IFS=: read -r name arch target <<< "$entry"
    expect "$name compiles" compiles_for_system "$root/build/nosdk/$name" "$target" &&
      expect "$name is for $arch" is_for "$root/build/nosdk/$name" "$arch"
  done
  check_universal
}
