# shellcheck shell=bash disable=SC2154  # root, the suites and the counts are run.sh's
# Several suites at once, two at a time: while one configures, links or waits for a single board, the other uses the
# processors. Each is a process of its own, whose output and results lie in files of the folder that BSM_PARTS names.

# tools_of SUITE: the programs that its require_tools asks for.
tools_of() {
  case $1 in
    arm64) echo aarch64-linux-gnu-g++ qemu-aarch64 clang clang++ ;;
    arm32) echo arm-linux-gnueabihf-g++ qemu-arm clang clang++ ;;
    armv5) echo arm-linux-gnueabi-g++ qemu-arm ;;
    riscv64) echo riscv64-linux-gnu-g++ qemu-riscv64 ;;
    s390x) echo s390x-linux-gnu-g++ qemu-s390x ;;
    tiers) echo qemu-x86_64 ;;
    nosdk) echo clang++-16 llvm-ar-16 ;;
    wasm) echo clang++-16 wasm-ld-16 llvm-ar-16 node ;;
    embedding) echo pkg-config aarch64-linux-gnu-g++ qemu-aarch64 ;;
    packages) echo arm-none-eabi-g++ javac java clang clang++ ;;
    cortexm) echo arm-none-eabi-g++ qemu-system-arm ;;
    clang | fuzz) echo clang clang++ ;;
  esac
}

# suites_before SUITE: those whose build it goes on with, or that work in the same folder.
suites_before() {
  case $1 in
    tiers) echo native ;;
    embedding) echo native arm64 ;;
    options) echo native embedding ;;
    cortexm) echo native embedding options ;;
  esac
}

# wait_for PART...: until these parts of the run have ended; those that are not in it count as ended.
wait_for() {
  local part
  [ -n "${BSM_PARTS:-}" ] || return 0
  for part in "$@"; do
    while grep -qx "$part" "$BSM_PARTS/parts" && [ ! -e "$BSM_PARTS/$part.results" ]; do sleep 0.5; done
  done
}

# The part "tools" installs at once what all suites need; where that fails, each suite finds out what it lacks.
run_tools() {
  local part words=(ninja)
  while IFS= read -r part; do
    # shellcheck disable=SC2207  # names of programs
    words+=($(tools_of "$part"))
  done < "$BSM_PARTS/parts"
  require_tools "${words[@]}" > /dev/null 2>&1 || true
}

# results: what this process counted, as shell text that adds it to another's counts.
results() {
  echo "passed=\$((passed + $passed))"
  [ ${#failed[@]} -eq 0 ] || echo "failed+=($(printf '%q ' "${failed[@]}"))"
  [ ${#skipped[@]} -eq 0 ] || echo "skipped+=($(printf '%q ' "${skipped[@]}"))"
  [ ${#table[@]} -eq 0 ] || echo "table+=($(printf '%q ' "${table[@]}"))"
}

# run_part PART: a suite, or "tools", in this process.
run_part() {
  # shellcheck disable=SC2034  # suite is read by expect
  local part=$1 suite=$1 started times
  # The native suite builds while the tools of the others are installed.
  [ "$part" = tools ] || [ "$part" = native ] || wait_for tools
  # shellcheck disable=SC2046  # names of suites
  wait_for $(suites_before "$part")
  started=$SECONDS
  "run_$part"
  times=$(mktemp) && times > "$times" # of what this shell waited for, in the last line: 1m23.456s 0m7.890s
  echo "== $part: $((SECONDS - started)) s, $(tail -n 1 "$times" | tr ms '  ' | awk '{ printf "%.0f", 60 * ($1 + $3) + $2 + $4 }') s of processor time"
  rm -f "$times"
  if [ -n "${BSM_PARTS:-}" ]; then
    results > "$BSM_PARTS/$part.partial"
    mv "$BSM_PARTS/$part.partial" "$BSM_PARTS/$part.results"
  fi
}

# run_side_by_side SUITE...: all of them, begun in this order; shows the output of each when it has ended and adds its counts.
run_side_by_side() {
  local part
  export BSM_PARTS=$root/build/parts
  rm -rf "$BSM_PARTS"
  mkdir -p "$BSM_PARTS"
  printf '%s\n' tools "$@" > "$BSM_PARTS/parts"
  # shellcheck disable=SC2016  # expanded by the shell of each part
  xargs -n 1 -P 2 bash -c 'bash "$0" --part "$1" > "$BSM_PARTS/$1.log" 2>&1; cat "$BSM_PARTS/$1.log"' "$root/tests/run.sh" \
    < "$BSM_PARTS/parts"
  for part in tools "$@"; do
    if [ -e "$BSM_PARTS/$part.results" ]; then
      # shellcheck source=/dev/null
      . "$BSM_PARTS/$part.results"
    else
      failed+=("$part: ended early")
    fi
  done
}
