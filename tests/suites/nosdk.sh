# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# Systems whose SDK is not here: the library compiles for them with clang and the C headers that come with it, which is all that
# it includes, and makes no frame above 1 KB, which is a warning and so an error. Nothing is linked or run. For Android and iOS
# CMake's own support gives the flags, as with the SDK.

# compiles FOLDER OPTION...: the library with the options that CMake takes by itself on that system.
compiles() {
  local folder=$1
  shift
  build "$root" "$folder" bsm -DCMAKE_BUILD_TYPE=Release -DBSM_WERROR=ON "$@"
}

# compiles_for_system FOLDER TARGET OPTION...
compiles_for_system() {
  local folder=$1 target=$2
  shift 2
  compiles "$folder" "-DCMAKE_TOOLCHAIN_FILE=$root/toolchains/clang.cmake" "-DBSM_TARGET=$target" "${library_alone[@]}" "$@"
}

# compiles_for_android FOLDER ABI: with a folder that CMake takes for an NDK, whose programs cannot be linked.
compiles_for_android() {
  local folder=$1 abi=$2 ndk=$root/build/nosdk/ndk bin tool
  bin=$ndk/toolchains/llvm/prebuilt/linux-x86_64/bin
  mkdir -p "$bin" "${bin%bin}sysroot" "$ndk/build/cmake" && ln -sfn linux-x86_64 "${bin%_64/bin}" &&
    printf 'Pkg.Desc = Android NDK\nPkg.Revision = 26.0.0\n' > "$ndk/source.properties" &&
    echo 'set(NDK_MIN_PLATFORM_LEVEL 21)' > "$ndk/build/cmake/platforms.cmake" || return
  for tool in clang clang++ llvm-ar llvm-ranlib; do ln -sf "$(command -v "$tool-16")" "$bin/$tool"; done
  compiles "$folder" -DCMAKE_SYSTEM_NAME=Android -DCMAKE_SYSTEM_VERSION=21 "-DCMAKE_ANDROID_NDK=$ndk" "-DCMAKE_ANDROID_ARCH_ABI=$abi" \
    -DCMAKE_CXX_COMPILER_WORKS=ON "${library_alone[@]}"
}

# apple_tools SYSTEM SDK COMPILER: options that take the place of Xcode.
apple_tools() {
  printf '%s\n' "-DCMAKE_SYSTEM_NAME=$1" "-DCMAKE_OSX_SYSROOT=$2" "-DCMAKE_CXX_COMPILER=$3" -DCMAKE_CXX_COMPILER_WORKS=ON \
    "-DCMAKE_AR=$(command -v llvm-ar-16)" "-DCMAKE_RANLIB=$(command -v llvm-ranlib-16)" -DCMAKE_INSTALL_NAME_TOOL=llvm-install-name-tool-16
}

# compiles_for_ios FOLDER: with a folder that CMake takes for an SDK.
compiles_for_ios() {
  local sdk=$root/build/nosdk/iPhoneOS.sdk options
  mkdir -p "$sdk" && mapfile -t options < <(apple_tools iOS "$sdk" clang++-16) || return
  compiles "$1" "${options[@]}" -DCMAKE_CXX_COMPILER_TARGET=arm64-apple-ios12 -DCMAKE_OSX_ARCHITECTURES=arm64 -DCMAKE_OSX_DEPLOYMENT_TARGET=12.0
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
  llvm-nm-16 --demangle --quiet "$@" | sed -nE 's/^(.* [TU] )?bsm::([a-z]+_[a-z]+_[a-z0-9]+)\(bsm::[A-Za-z]+Args const&\)$/\2/p' | sort
}

# slice_has FOLDER MACHINE ISA|ISA..: what a build holds are the kernels of these instruction sets, and it chooses from them; in a
# universal one for MACHINE, which is empty otherwise.
slice_has() {
  local objects=$1/core/CMakeFiles/bsm.dir/__/simd machine=${2:+--arch=$2} listed
  listed=$(listed_kernels "$3")
  diff <(echo "$listed") <(compiled_kernels ${machine:+"$machine"} --defined-only "$objects"/*/*.o) &&
    diff <(echo "$listed") <(compiled_kernels ${machine:+"$machine"} --undefined-only "$objects/kernels.cpp.o") &&
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

# Xcode calls the compiler once for each machine, and chooses the machines when it builds: each call knows the flags of all.
check_xcode() {
  local folder=$root/build/nosdk/xcode compiler=$root/build/nosdk/tools/xcode-c++ options isa
  # shellcheck disable=SC2016  # expanded by the script
  printf '%s\n' '#!/bin/sh' \
    'for machine in arm64 x86_64; do clang++-16 --target=$machine-apple-macos11 -ffreestanding -nostdlibinc "$@" || exit; done' > "$compiler"
  chmod +x "$compiler"
  mapfile -t options < <(apple_tools Darwin / "$compiler")
  expect "xcode, configures" cmake -G "Unix Makefiles" -S "$root" -B "$folder" -DXCODE=ON "${options[@]}" -DCMAKE_BUILD_TYPE=Release \
    -DBSM_WERROR=ON "${library_alone[@]}" || return
  for isa in X86_SSE42 X86_AVX2 X86_AVX512 ARM64_NEON; do
    expect "xcode, takes the kernels of $isa" grep -qx "BSM_COMPILES_$isa:INTERNAL=1" "$folder/CMakeCache.txt"
  done
  expect "xcode, compiles kernels for each machine" make -C "$folder/core" __/simd/x86/mask_threshold_avx2.o __/simd/arm/mask_threshold_neon.o
}

# llvm_proof PROOF LIBRARY: a proof of proofs.sh about the objects of another system.
llvm_proof() { env NM=llvm-nm-16 OBJDUMP=llvm-objdump-16 bash "$root/tests/proofs.sh" "$@"; }

# check_phone NAME ARCH ISA|ISA.. COMMAND [ABI]: the command builds the library of a phone in the folder that it is given.
check_phone() {
  local name=$1 arch=$2 isas=$3 command=$4 folder=$root/build/nosdk/$1
  shift 4
  expect "$name compiles" "$command" "$folder" "$@" || return
  expect "$name is for $arch" is_for "$folder" "$arch"
  expect "$name, kernels" slice_has "$folder" "" "$isas"
  expect "$name, needs memory functions and integer helpers alone" llvm_proof symbols "$folder/core/libbsm.a"
  expect "$name, no writable data, no constructors" llvm_proof sections "$folder/core/libbsm.a"
}

run_nosdk() {
  # shellcheck disable=SC2034  # read by expect
  local suite=nosdk
  local entry name target arch abi isas folder=$root/build/nosdk library_alone=(-DBSM_BUILD_TESTS=OFF -DBSM_BUILD_PROGRAM=OFF -DBSM_BUILD_BENCH=OFF)
  if ! require_tools clang++-16 llvm-ar-16 > /dev/null 2>&1; then
    skipped+=("nosdk: clang-16 or llvm-16 is not installed and cannot be installed here (Debian and Ubuntu: apt-get install clang-16 llvm-16)")
    return
  fi
  echo "== nosdk: objects for systems without their SDK"
  for entry in "arm64:aarch64:arm64-v8a:scalar|neon|sve" "armv7:arm:armeabi-v7a:scalar|neon"; do
    IFS=: read -r name arch abi isas <<< "$entry"
    check_phone "android-$name" "$arch" "$isas" compiles_for_android "$abi"
  done
  check_phone ios-arm64 aarch64 "scalar|neon" compiles_for_ios
  for entry in windows-arm64:aarch64:aarch64-pc-windows-msvc windows-x64:x86_64:x86_64-pc-windows-msvc; do
    IFS=: read -r name arch target <<< "$entry"
    expect "$name compiles" compiles_for_system "$folder/$name" "$target" &&
      expect "$name is for $arch" is_for "$folder/$name" "$arch"
  done
  check_universal
  check_xcode
}
