# shellcheck shell=bash disable=SC2034
# Sourced by the proofs about object code: how they end, and the library that they read.

nm=${NM:-nm}
objdump=${OBJDUMP:-objdump}

skip() {
  echo "SKIPPED: $1"
  exit 77
}

fail() {
  echo "FAILED: $1"
  exit 1
}

# need_library LIBRARY TOOL...: the file is a static library that is not instrumented, and the tools can be run.
need_library() {
  local library=$1 tool
  shift
  [ -f "$library" ] || fail "'$library' is no file; give the path of libbsm.a"
  case $library in
    *.a) ;;
    *) skip "the proof reads a static library" ;;
  esac
  for tool in "$@"; do
    command -v "$tool" > /dev/null || skip "'$tool' is not installed"
  done
  if "$nm" "$library" 2> /dev/null | grep -q '__asan_\|__ubsan_\|__gcov_\|__llvm_prof'; then
    skip "instrumented build (sanitizer or coverage)"
  fi
}
