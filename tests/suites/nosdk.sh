# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# Systems whose SDK is not here: the library compiles for them with clang and the C headers that come with it, which is all that
# it includes, and makes no frame above 1 KB, which is a warning and so an error. Nothing is linked or run.

# The objects are for the machine that the target names.
is_for() {
  local headers
  headers=$(llvm-readobj-16 --file-headers "$1/core/libbsm.a") && grep -i "^Arch: $2" <<< "$headers"
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
    windows-arm64:aarch64:aarch64-pc-windows-msvc windows-x64:x86_64:x86_64-pc-windows-msvc \
    wasm32:wasm32:wasm32-unknown-unknown; do
    IFS=: read -r name arch target <<< "$entry"
    expect "$name compiles" build "$root" "$root/build/nosdk/$name" bsm "-DCMAKE_TOOLCHAIN_FILE=$root/toolchains/clang.cmake" \
      "-DBSM_TARGET=$target" -DCMAKE_BUILD_TYPE=Release -DBSM_WERROR=ON -DBSM_BUILD_TESTS=OFF -DBSM_BUILD_PROGRAM=OFF \
      -DBSM_BUILD_BENCH=OFF && expect "$name is for $arch" is_for "$root/build/nosdk/$name" "$arch"
  done
}
