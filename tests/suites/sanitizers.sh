# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# The native tests with AddressSanitizer and UndefinedBehaviorSanitizer.

run_asan() {
  local sanitizers="-fsanitize=address,undefined,alignment -fno-sanitize-recover=all -fno-omit-frame-pointer"
  # shellcheck disable=SC2086  # options are words of their own
  if ! links 'int main() { return 0; }' ${CXX:-c++} $sanitizers; then
    skipped+=("asan: ${CXX:-c++} does not link $sanitizers; install its sanitizer runtime (Debian: libasan, libubsan)")
    return
  fi
  run_suite asan asan . -DCMAKE_BUILD_TYPE=RelWithDebInfo "-DCMAKE_C_FLAGS=$sanitizers" "-DCMAKE_CXX_FLAGS=$sanitizers"
}
