# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# Kernels of older x86 processors, under emulation.

# The x86 tiers that this machine's own run does not choose.
run_tiers() {
  if [ "$(uname -m)" != x86_64 ]; then
    skip_target x86-64 - "the build is not for x86-64"
  elif ! require_tools qemu-x86_64 > /dev/null 2>&1; then
    skip_target x86-64 - "qemu-x86_64 is not installed and cannot be installed here (Debian and Ubuntu: apt-get install qemu-user)"
  elif [ -x "$root/build/tests/tests/test_kernels" ]; then
    echo "== tiers: x86 processors of several ages"
    emulate x86-64 "$root/build/tests" core2duo:scalar Nehalem:sse42:all SandyBridge:sse42 Haswell:avx2:all -- qemu-x86_64
  fi
}
