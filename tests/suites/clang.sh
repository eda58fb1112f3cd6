# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# Builds that need clang: the library compiled by it, and the fuzzers for a short fixed count.

# Set by have_clang; the two suites that need clang say the same.
no_clang="clang is not installed and cannot be installed here (Debian and Ubuntu: apt-get install clang)"
have_clang() { require_tools clang clang++ > /dev/null 2>&1; }

run_clang() {
  have_clang || {
    skipped+=("clang: $no_clang")
    return
  }
  # What depends on the compiler: the bytes, the stack and the objects.
  # shellcheck disable=SC2034  # read by run_suite
  local targets="bsm test_kernels test_golden test_targets test_stack"
  run_suite clang clang '^(test_(kernels|golden|targets|stack)|proof_(symbols|sections|freestanding|objects))$' \
    -DCMAKE_BUILD_TYPE=Release -DBSM_BUILD_BENCH=OFF "$joined" -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++
}

fuzz_program='extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }'

run_fuzz() {
  have_clang || {
    skipped+=("fuzz: $no_clang")
    return
  }
  local flags="-fsanitize=address,undefined -fno-sanitize-recover=all" runtime
  # shellcheck disable=SC2034  # read by run_suite
  local targets="fuzz_config fuzz_pnm"
  runtime=libclang-rt-$(clang++ -dumpversion | cut -d. -f1)-dev
  # shellcheck disable=SC2086
  if ! links "$fuzz_program" clang++ -fsanitize=fuzzer $flags && ! { install_packages "$runtime" > /dev/null 2>&1 &&
    links "$fuzz_program" clang++ -fsanitize=fuzzer $flags; }; then
    skipped+=("fuzz: clang++ does not link -fsanitize=fuzzer (Debian and Ubuntu: apt-get install $runtime)")
    return
  fi
  run_suite fuzz fuzz '^fuzz_' "${sanitized_build[@]}" -DBSM_BUILD_FUZZERS=ON \
    -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ "-DCMAKE_C_FLAGS=$flags" \
    "-DCMAKE_CXX_FLAGS=$flags -fsanitize=fuzzer-no-link"
}
