# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# The build that users make, on this machine.

run_native() {
  run_suite native tests . -DCMAKE_BUILD_TYPE=Release
  savings_change_nothing
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
