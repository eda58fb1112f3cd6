# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# The build that users make, on this machine.

run_native() {
  run_suite native tests . -DCMAKE_BUILD_TYPE=Release
  savings_change_nothing
  frames_measured
  check_presets
}

# CMake takes each preset, and the toolchain file that it names is there.
preset_is_whole() {
  local output toolchain
  output=$(cd "$root" && cmake --preset "$1" -N) || return
  toolchain=$(sed -n 's/^ *CMAKE_TOOLCHAIN_FILE.*="\(.*\)"$/\1/p' <<< "$output")
  echo "$output"
  grep -q 'CMAKE_BUILD_TYPE=' <<< "$output" && { [ -z "$toolchain" ] || [ -f "$root/$toolchain" ]; }
}

check_presets() {
  # shellcheck disable=SC2034  # read by expect
  local suite=native preset presets version
  version=$(cmake --version | sed -n '1s/.* //p')
  if [ "$(printf '%s\n' 3.21 "$version" | sort -V | head -n 1)" != 3.21 ]; then
    skipped+=("native, presets: CMake $version is older than 3.21")
    return
  fi
  presets=$(sed -nE 's/.*"configurePreset": "([^"]+)".*/\1/p' "$root/CMakePresets.json" | sort -u)
  for preset in $presets; do expect "preset $preset" preset_is_whole "$preset"; done
  expect "each toolchain file of a machine has a preset" \
    diff <(grep -x '.*-.*\|wasm32' <<< "$presets" | grep -v '^cortex-m$') \
    <(find "$root/toolchains" -name '*-*.cmake' ! -name cortex-m.cmake -o -name wasm32.cmake | sed 's|.*/||; s|\.cmake$||' | sort)
}

# Each saving of the kernels writes the bytes of the same computation without it, and the measurement of them runs.
savings_change_nothing() {
  # shellcheck disable=SC2034  # read by expect
  local suite=native options out=$root/build/tests/savings
  expect "savings, scene" "$root/build/tests/platform/host/bsm" demo "$out" && gray_pair "$out" || return
  for options in "fast" "balanced" "best" "local" "local --bits 64" "paper"; do
    # shellcheck disable=SC2086  # options are words of their own
    expect "savings change nothing, preset $options" "$root/build/tests/bench/bsm_bench" savings "$out/left.ppm" \
      "$out/right.ppm" --preset $options --repeat 1
  done
  expect "every kernel measured" "$root/build/tests/bench/bsm_bench" kernels --width 64 --bits 128 --disparities 16 --repeat 1
  expect "savings change nothing, gray" "$root/build/tests/bench/bsm_bench" savings "$out/left.pgm" "$out/right.pgm" --repeat 1
}

# The stages of a frame, one thread in turns with two.
frames_measured() {
  # shellcheck disable=SC2034  # read by expect
  local suite=native bench=$root/build/tests/bench/bsm_bench scene=$root/build/tests/savings
  expect "stages of a frame measured, one thread and two" has_speedups "$bench" frame "$scene/left.ppm" "$scene/right.ppm" \
    --threads 2 --repeat 1 --csv
}

has_speedups() {
  local output
  output=$("$@") || return
  echo "$output"
  grep -q '^stage,.*,ms_one_thread,speedup$' <<< "$output" && grep -qE '^refined,.*,[0-9]+\.[0-9]+,[0-9]+\.[0-9]+$' <<< "$output"
}
