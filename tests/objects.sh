#!/usr/bin/env bash
# objects.sh - scans the library's object code: no instruction that a file's CPU features do not hold, no floating-point
# arithmetic, and from a kernel's object nothing but the kernel for the linker to see, least of all weak symbols.
#
# usage: bash tests/objects.sh scan LIBRARY [ASSEMBLER_FLAG...]
#        bash tests/objects.sh self-test [ASSEMBLER_FLAG...]
# The flags name the least processor of the build; x86-64, AArch64 and RISC-V have a default. NM, OBJDUMP and AS name the
# binutils for a library of another machine, CXX the compiler of the self-test, which sees the scan refuse what it must.
# Exit code: 0 proved, 1 refuted, 77 cannot be told here (the output says why).
#
# No list of instructions can be whole, the assembler's is: each instruction of a file is disassembled and assembled again for
# a processor that has the features of simd/isa.h for that file alone, the ones a CPU is asked for before its kernels run.
set -u
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=tests/proof_library.sh
. "$root/tests/proof_library.sh"
as=${AS:-as}

# The instruction sets of simd/isa.h as files are named after them, and the CPU features of one, such as "Popcnt Sse42".
isas() { sed -nE 's/^constexpr uint32_t kIsa([A-Za-z0-9]+) = .*/\1/p' "$root/simd/isa.h" | tr '[:upper:]' '[:lower:]'; }
features() {
  local words word
  words=$(sed -nE "s/^constexpr uint32_t kIsa${1^} = (.*);/\1/p" "$root/simd/isa.h")
  for word in $words; do
    case $word in
      kIsa*) features "${word#kIsa}" ;;
      kCpu*) echo "${word#kCpu}" ;;
    esac
  done
}

# What a CPU feature adds to the assembler's flags.
extension() {
  case $machine:$1 in
    x86-64:Popcnt) echo +popcnt ;;
    x86-64:Sse42) echo +sse4.2 ;;
    x86-64:Avx2) echo +avx2 ;;
    x86-64:Avx512) echo +avx512f+avx512bw+avx512dq+avx512vl ;;
    x86-64:Avx512Vbmi) echo +avx512vbmi ;;
    x86-64:Avx512Gfni) echo +gfni ;;
    x86-64:Avx512Vpopcntdq) echo +avx512_vpopcntdq ;;
    aarch64:Neon) ;; # every AArch64 has it
    aarch64:Sve) echo +sve ;;
    arm:Neon) echo " -mfpu=neon" ;;
    arm:ArmDsp | arm:Mve) ;; # M-profile: what the compiler targets
    *) echo "+no_name_known_for_$1" ;; # which the assembler refuses
  esac
}

# flags_of GROUP FLAG...: the assembler's flags for the files of one instruction set; "base" are those of none.
flags_of() {
  local group=$1 feature
  shift
  echo -n "$*"
  case $group in
    base) ;;
    cpu_x86) echo -n +xsave ;; # asks for XGETBV once OSXSAVE says that it is there
    *) for feature in $(features "$group"); do echo -n "$(extension "$feature")"; done ;;
  esac
}

# Writes each distinct instruction of the library once into FOLDER/GROUP.s, with the object that it was seen in.
disassemble() {
  local options=-dw
  # Without its name the long shifts of ARMv8.1-M are shown as what they were before.
  [ "$machine" != arm ] || ! "$objdump" -f "$1" | grep -q 'architecture: armv8.1-m.main' || options+=" -marmv8.1-m.main"
  # shellcheck disable=SC2086  # options are words of their own
  "$objdump" $options "$1" |
    awk -v folder="$2" -v machine="$machine" -v isas=" $(isas | tr '\n' ' ')" -f "$root/tests/instructions.awk"
}

# Mnemonics that compute with floating point; moves, permutations and bitwise operations of such registers do not.
float_arithmetic() {
  case $machine in
    x86-64)
      grep -E '^(\{evex\} )?(v?cvt|(v[^p]|[^vp])[a-z0-9]*[sp][sdh] )' "$1" |
        grep -vE '^(\{evex\} )?v?(and|blend|broadcast|compress|expand|extract|gather|insert|maskmov|mov|or|scatter|shuf|unpck|xor)'
      ;;
    aarch64) grep -E '^(f[a-z0-9]+|[su]cvtf|bf(dot|mmla|mlal[bt]|cvt[a-z0-9]*)) ' "$1" | grep -v '^fmov ' ;;
    arm) grep -E '(^|; )v[a-z0-9]+\.(b?f16|f32|f64)' "$1" | grep -vE '(^|; )vmov[a-z]*\.f(32|64) ' ;;
  esac
}

# Kernels of two instruction sets must share no symbol, or the linker keeps the code of one for both.
prove_symbols_alone() {
  local bad
  bad=$("$nm" -AC "$library" 2> /dev/null | sed 's/^[^:]*://' | awk -v isas=" $(isas | tr '\n' ' ')" '
    {
      object = $1; sub(/:.*/, "", object); name = object; sub(/\..*/, "", name); isa = name; sub(/.*_/, "", isa)
      line = $0; sub(/^[^:]*:[0-9a-f ]*/, "", line); type = substr(line, 1, 1); symbol = substr(line, 3)
      if (index(isas, " " isa " ") == 0) next
      if (type ~ /[WVwvu]/) print object ": weak symbol " symbol
      else if (type ~ /[A-TX-Z]/ && symbol !~ "^bsm::" name "(_scratch)?[(]") print object ": external symbol " symbol
    }')
  [ -z "$bad" ] || fail "symbols that linkers may join:
$bad"
}

scan() {
  local tool defaults
  library=${1:-}
  [ $# = 0 ] || shift
  need_library "$library" "$nm" "$objdump" "$as"
  for tool in "$objdump" "$as"; do
    "$tool" --version 2> /dev/null | grep -q '^GNU' || skip "'$tool' is not of GNU binutils"
  done
  case $("$objdump" -f "$library" 2> /dev/null | sed -n 's/.*file format //p' | sort -u) in
    elf64-x86-64) machine=x86-64 defaults=-march=generic64+no87+nommx+ibt ;;
    elf64-littleaarch64) machine=aarch64 defaults=-march=armv8-a ;;
    elf64-littleriscv) machine=riscv64 defaults=-march=rv64imac ;; # without F and D: no floating point at all
    elf32-littlearm) machine=arm defaults= ;;
    *) skip "no instruction set is known for this library's machine" ;;
  esac
  [ $# -gt 0 ] || set -- "$defaults"
  [ -n "$1" ] || fail "name the least processor of this build, such as -march=armv7-a"
  [ "$machine" != arm ] || syntax=".syntax unified"
  prove_symbols_alone

  local file group flags report="" bad
  disassemble "$library" "$dir"
  for file in "$dir"/*.s; do
    [ -f "$file" ] || fail "$objdump finds no code in $library"
    group=$(basename "$file" .s)
    flags=$(flags_of "$group" "$@")
    bad=$(float_arithmetic "$file")
    [ -z "$bad" ] || fail "floating-point arithmetic, files of $group:
$bad"
    # One line more at the front shifts the assembler's numbers by one.
    # shellcheck disable=SC2086  # flags are words of their own
    { echo "${syntax:-}" && cat "$file"; } | "$as" $flags -o "$dir/again.o" - > "$dir/errors" 2>&1
    bad=$(sed -nE 's/^[^:]*:([0-9]+): Error: (.*)/\1 \2/p' "$dir/errors" | while read -r line reason; do
      echo "$(sed -n "$((line - 1))p" "$file"): $reason"
    done)
    [ -z "$bad" ] || fail "instructions beyond $flags, files of $group:
$bad"
    [ -f "$dir/again.o" ] || fail "$as $flags: $(cat "$dir/errors")"
    rm -f "$dir/again.o"
    report+=" $group $(wc -l < "$file"),"
  done
  echo "$machine: distinct instructions of each instruction set, all its own:${report%,}; no weak symbols in kernels"
}

# probe NAME TEXT CODE: a library of one file NAME.cpp with the kernel that it has to hold and CODE is refused, saying TEXT.
# Without TEXT it is accepted.
probe() {
  local name=$1 text=$2 code=$3 output
  printf '%s\n' "namespace bsm {" "void $name() {}" "void ${name}_scratch() {}" "$code" "}" > "$dir/$name.cpp"
  "$cxx" -std=c++17 -O2 -c "$dir/$name.cpp" -o "$dir/$name.cpp.o" > "$dir/errors" 2>&1 ||
    skip "$cxx does not compile '$code': $(head -n 3 "$dir/errors")"
  rm -f "$dir/probe.a"
  ar rcs "$dir/probe.a" "$dir/$name.cpp.o"
  output=$({ bash "$0" scan "$dir/probe.a" "${base[@]}" && bash "$root/tests/proofs.sh" sections "$dir/probe.a"; } 2>&1)
  case $?:${text:+refuse} in
    0:) echo "accepted: $name, $code" ;;
    1:refuse)
      grep -qF -- "$text" <<< "$output" || fail "$name, $code: refused, but not for '$text': $output"
      echo "refused: $name, $code"
      ;;
    77:*) skip "${output#SKIPPED: }" ;;
    *) fail "$name, $code: ${text:+not refused, }$output" ;;
  esac
}

self_test() {
  local inside='static __attribute__((used))' beyond="instructions beyond"
  base=("$@")
  cxx=${CXX:-c++}
  command -v "$cxx" > /dev/null || skip "'$cxx' is not installed"
  case $("$cxx" -dumpmachine) in
    x86_64*)
      probe probe_sse42 "" 'void probe_sse42(int) { asm("pminuw %xmm0, %xmm1; popcnt %eax, %eax; rep bsf %eax, %eax"); }'
      probe probe_avx2 "" 'void probe_avx2(int) { asm("vpminuw %ymm0, %ymm1, %ymm2"); }'
      probe probe_avx512 "" 'void probe_avx512(int) { asm("vpopcntq %zmm0, %zmm1; vpermb %zmm0, %zmm1, %zmm2"); }'
      probe probe_scalar "$beyond" 'void probe_scalar(int) { asm("pshufb %xmm0, %xmm1"); }'
      probe probe_sse42 "$beyond" 'void probe_sse42(int) { asm("vpminuw %ymm0, %ymm1, %ymm2"); }'
      probe probe_sse42 "$beyond" 'void probe_sse42(int) { asm("lzcnt %eax, %eax"); }'
      probe probe_avx2 "$beyond" 'void probe_avx2(int) { asm("{evex} vpminuw %ymm0, %ymm1, %ymm2"); }'
      probe probe_avx2 "$beyond" 'void probe_avx2(int) { asm("andn %eax, %eax, %eax"); }'
      probe probe_avx512 "$beyond" 'void probe_avx512(int) { asm("vpcompressb %zmm0, %zmm1"); }'
      probe engine "$beyond" 'void engine(int) { asm("xgetbv"); }'
      probe engine "$beyond" 'void engine(int) { asm(".byte 0x06"); }'
      probe probe_avx512 "arithmetic" 'void probe_avx512(int) { asm("vfmadd231ps %zmm0, %zmm1, %zmm2"); }'
      ;;
    aarch64*)
      probe probe_neon "" 'void probe_neon(int) { asm("uqadd v0.8h, v1.8h, v2.8h"); }'
      probe probe_sve "" 'void probe_sve(int) { asm(".arch armv8.2-a+sve; uqadd z0.h, z1.h, z2.h"); }'
      probe probe_neon "$beyond" 'void probe_neon(int) { asm(".arch armv8.2-a+sve; uqadd z0.h, z1.h, z2.h"); }'
      probe probe_neon "$beyond" 'void probe_neon(int) { asm(".arch armv8.2-a+dotprod; udot v0.4s, v1.16b, v2.16b"); }'
      probe probe_scalar "$beyond" 'void probe_scalar(int) { asm(".arch armv8.1-a; ldadd w0, w1, [x2]"); }'
      probe engine "$beyond" 'void engine(int) { asm(".inst 0xffffffff"); }'
      ;;
    arm-*-gnueabihf)
      probe probe_neon "" 'void probe_neon(int) { asm(".fpu neon\n vqadd.u16 q0, q1, q2"); }'
      probe probe_scalar "$beyond" 'void probe_scalar(int) { asm(".fpu neon\n vqadd.u16 q0, q1, q2"); }'
      probe probe_neon "$beyond" 'void probe_neon(int) { asm(".arch armv8-a\n lda r0, [r1]"); }'
      ;;
    *) skip "there are no probes for $("$cxx" -dumpmachine)" ;;
  esac
  probe probe_scalar "arithmetic" "$inside float add(float a, float b) { return a + b; }"
  probe engine "arithmetic" "$inside float convert(int a) { return static_cast<float>(a); }"
  probe probe_scalar "weak symbol bsm::shared" "inline __attribute__((used)) int shared(int x) { return x; }"
  probe probe_scalar "external symbol bsm::stray" "int stray(int x) { return x; }"
  probe engine ".init_array" "int make(); $inside int made = make();"
}

command=${1:-}
[ $# = 0 ] || shift
dir=$(mktemp -d) || fail "no temporary folder"
trap 'rm -rf "$dir"' EXIT
case $command in
  scan) scan "$@" ;;
  self-test) self_test "$@" ;;
  *)
    sed -n '2,11s/^# \{0,1\}//p' "$0" >&2
    exit 2
    ;;
esac
