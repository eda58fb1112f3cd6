# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# The native tests with AddressSanitizer and UndefinedBehaviorSanitizer; those that run threads with ThreadSanitizer. Proofs about
# objects and text are the native suite's.

# Little optimization and debug information: sanitized code takes long to compile, and reports name its lines.
sanitized_build=(-DCMAKE_BUILD_TYPE=RelWithDebInfo "-DCMAKE_C_FLAGS_RELWITHDEBINFO=-O1 -g1 -DNDEBUG"
  "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1 -DNDEBUG" -DBSM_BUILD_BENCH=OFF "$joined")

run_asan() {
  local sanitizers="-fsanitize=address,undefined,alignment -fno-sanitize-recover=all -fno-omit-frame-pointer"
  # shellcheck disable=SC2086  # options are words of their own
  if ! links 'int main() { return 0; }' ${CXX:-c++} $sanitizers; then
    skipped+=("asan: ${CXX:-c++} does not link $sanitizers; install its sanitizer runtime (Debian: libasan, libubsan)")
    return
  fi
  run_suite asan asan '^test_' "${sanitized_build[@]}" "-DCMAKE_C_FLAGS=$sanitizers" "-DCMAKE_CXX_FLAGS=$sanitizers"
}

run_tsan() {
  local sanitizer=-fsanitize=thread
  # shellcheck disable=SC2034  # read by run_suite
  local targets="test_sequence test_stream" # threads meet between stages, whatever the kernels
  if ! links 'int main() { return 0; }' "${CXX:-c++}" $sanitizer; then
    skipped+=("tsan: ${CXX:-c++} does not link $sanitizer; install its runtime (Debian: libtsan2)")
    return
  fi
  run_suite tsan tsan '^test_(sequence|stream)$' "${sanitized_build[@]}" "${no_wide_vectors[@]}" "-DCMAKE_C_FLAGS=$sanitizer" \
    "-DCMAKE_CXX_FLAGS=$sanitizer"
}
