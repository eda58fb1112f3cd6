# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# The build that users make, on this machine.

run_native() { run_suite native tests . -DCMAKE_BUILD_TYPE=Release; }
