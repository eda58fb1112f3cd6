# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# The library as registries and mobile apps take it: the packages of platform/package.sh, Android, iOS.

# package_has KIND FILE...: the package is laid out whole: the files are there, and none still waits for a version.
package_has() {
  local kind=$1 file
  shift
  bash "$root/platform/package.sh" "$kind" "$out/$kind" || return
  for file in "$@" LICENSE README.md; do
    [ -s "$out/$kind/bsm/$file" ] || {
      echo "$file is missing in $out/$kind/bsm"
      return 1
    }
  done
  ! grep -rn '@VERSION@' "$out/$kind/bsm"
}

# says_version FILE PATTERN: a manifest says the version of bsm.h, in a line that matches PATTERN.
says_version() { grep -E -- "$2" "$1" | grep -F "${version:?}"; }

# compiles_sketch CPU FLAG...: the Arduino library and its example compile for a microcontroller from the package alone, and
# need nothing that a core does not bring.
compiles_sketch() {
  local cpu=$1 library=$out/arduino/bsm foreign
  shift
  arm-none-eabi-g++ -std=gnu++17 "-mcpu=$cpu" "$@" "${warnings[@]}" -mthumb -Os -fno-exceptions -fno-rtti "-I$library/src" -c "$library/src/bsm.cpp" \
    -o "$out/bsm-$cpu.o" &&
    arm-none-eabi-g++ -std=gnu++17 "-mcpu=$cpu" "$@" "${warnings[@]}" -mthumb -Os -fno-exceptions -fno-rtti "-I$library/src" "-I$here/arduino" \
      -x c++ -c "$library/examples/rows/rows.ino" -o "$out/rows-$cpu.o" || return
  foreign=$(arm-none-eabi-nm -u "$out/bsm-$cpu.o" | awk '{ print $2 }' | grep -Ev '^(mem(cpy|move|set)|__(aeabi|gnu_thumb1)_[a-z0-9_]+)$')
  [ -z "$foreign" ] || {
    echo "bsm.cpp needs $foreign"
    return 1
  }
}

# The example prints the middle row of its box: 9 in the middle, 3 around it.
sketch_runs() {
  "$out/sketch" | tee "$out/sketch.out" && tail -n 1 "$out/sketch.out" | grep -Ex '3{18,24}9{14,24}3{18,26}'
}

check_arduino() {
  local library=$out/arduino/bsm
  expect "arduino, package" package_has arduino library.properties library.json src/bsm.h src/bsm.cpp examples/rows/rows.ino || return
  expect "arduino, version of library.properties" says_version "$library/library.properties" '^version='
  expect "arduino, version of library.json" says_version "$library/library.json" '"version":'
  if expect "arduino, sketch compiles" "${CXX:-c++}" -std=gnu++17 -O1 "${warnings[@]}" "-I$library/src" "-I$here/arduino" \
    -x c++ "$library/examples/rows/rows.ino" "$library/src/bsm.cpp" "$here/arduino/host.cpp" -o "$out/sketch"; then
    expect "arduino, sketch runs" sketch_runs
  fi
  if require_tools arm-none-eabi-g++ > /dev/null 2>&1; then
    expect "arduino, Cortex-M0" compiles_sketch cortex-m0
    expect "arduino, Cortex-M4" compiles_sketch cortex-m4
    expect "arduino, Cortex-M55" compiles_sketch cortex-m55+nofp -mfloat-abi=softfp
  else
    skipped+=("packages arduino on Cortex-M: arm-none-eabi-g++ is not installed and cannot be installed here (Debian and Ubuntu: apt-get install gcc-arm-none-eabi)")
  fi
}

# check_framework KIND FILE...: a package's CMake files, run with stubs of the framework's functions, make a library that works.
check_framework() {
  local kind=$1
  shift
  expect "$kind, package" package_has "$kind" bsm/bsm.h bsm/bsm.cpp "$@" &&
    expect "$kind, builds with the framework's functions stubbed" build "$here/$kind" "$out/$kind-build" all "-DPACKAGE=$out/$kind/bsm" &&
    expect "$kind, a program on it runs" "$out/$kind-build/consumer"
}

check_refusals() {
  expect "package.sh refuses an unknown kind" refuses "unknown kind" bash "$root/platform/package.sh" pebble "$out/pebble"
  mkdir -p "$out/taken/bsm"
  expect "package.sh leaves foreign folders alone" refuses "no package of an earlier run" bash "$root/platform/package.sh" zephyr "$out/taken"
}

# The Java class and its native half, compiled and run by this machine's Java.
check_android() {
  local java includes
  if ! require_tools javac java > /dev/null 2>&1; then
    skipped+=("packages android: javac is not installed and cannot be installed here (Debian and Ubuntu: apt-get install openjdk-17-jdk-headless)")
    return
  fi
  java=$(dirname "$(dirname "$(readlink -f "$(command -v javac)")")")
  if [ ! -f "$java/include/jni.h" ]; then
    skipped+=("packages android: there is no jni.h in $java/include")
    return
  fi
  includes="$java/include;$(dirname "$(find "$java/include" -mindepth 2 -name jni_md.h | head -n 1)")"
  expect "android, native half" build "$root/platform/android" "$out/android" bsm_jni -DCMAKE_BUILD_TYPE=Release -DBSM_WERROR=ON \
    -DCMAKE_CXX_FLAGS=-Werror "-DCMAKE_CXX_STANDARD_INCLUDE_DIRECTORIES=$includes" &&
    expect "android, Java half" javac -Xlint:all -Werror --release 8 -Xlint:-options -d "$out/android/classes" "$root/platform/android/java/bsm/StereoMatcher.java" \
      "$here/android/StereoMatcherTest.java" &&
    expect "android, frames through Java" env "LD_LIBRARY_PATH=$out/android" java -ea -cp "$out/android/classes" StereoMatcherTest
}

# A dry run prints each step; every library that the framework takes was joined before from archives that were built before.
framework_steps() {
  local script=$root/platform/ios/xcframework.sh steps library archive
  steps=$(bash "$script" --dry-run "$out/ios") || return
  echo "$steps"
  [ "$(grep -c '^cmake --build ' <<< "$steps")" = 5 ] && [ ! -e "$out/ios" ] || return
  while read -r library; do
    grep '^xcrun lipo ' <<< "$steps" | grep -qF -- "-output $library" || return
  done < <(grep '^xcodebuild ' <<< "$steps" | grep -oE -- '-library [^ ]+' | cut -d' ' -f2)
  while read -r archive; do
    grep -qF "cmake --build ${archive%/core/libbsm.a} " <<< "$steps" || return
  done < <(grep '^xcrun lipo ' <<< "$steps" | sed 's/-output.*//' | grep -oE '[^ ]+libbsm\.a')
}

# The two files compile for the systems of phones, which have no SDK here.
compiles_for() {
  clang++ -std=c++17 "--target=$1" -O1 -ffreestanding -nostdlibinc -fno-exceptions -fno-rtti "${warnings[@]}" -fsyntax-only "$out/esp-idf/bsm/bsm/bsm.cpp"
}

check_phones() {
  local target headers=$out/module
  expect "ios, steps of the xcframework" framework_steps
  if ! require_tools clang clang++ > /dev/null 2>&1; then
    skipped+=("packages ios, module and phones' compilers: clang is not installed and cannot be installed here (Debian and Ubuntu: apt-get install clang)")
    return
  fi
  mkdir -p "$headers/bsm"
  cp "$root/core/include/bsm/bsm.h" "$headers/bsm"
  cp "$root/platform/ios/module.modulemap" "$headers"
  expect "ios, header as a module" clang -x objective-c -fmodules "-fmodules-cache-path=$out/module-cache" "-I$headers" -Wall -Wextra -Werror \
    -fsyntax-only "$here/ios/import.m"
  for target in arm64-apple-ios12.0 arm64-apple-macosx11.0 aarch64-linux-android24 armv7a-linux-androideabi24 x86_64-linux-android24; do
    expect "two files compile for $target" compiles_for "$target"
  done
}

run_packages() {
  local here=$root/tests/embedding out=$root/build/packages version
  local warnings=(-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)
  version=$(sed -nE 's/^#define BSM_VERSION_[A-Z]+ ([0-9]+)$/\1/p' "$root/core/include/bsm/bsm.h" | paste -sd .)
  rm -rf "$out"
  mkdir -p "$out"
  echo "== packages: building in $out"
  check_refusals
  check_arduino
  check_framework esp-idf CMakeLists.txt idf_component.yml
  expect "esp-idf, version of idf_component.yml" says_version "$out/esp-idf/bsm/idf_component.yml" '^version:'
  check_framework zephyr zephyr/module.yml zephyr/CMakeLists.txt zephyr/Kconfig
  check_android
  check_phones
}
