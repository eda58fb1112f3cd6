#!/usr/bin/env bash
# proofs.sh - properties of the library that its text and its object code show: which symbols it needs, that it holds no
# writable data and no constructors, that it uses no floating point, what it includes, and that a program needs no more.
#
# usage: bash tests/proofs.sh symbols|sections|float|includes|general-regs-x86_64|general-regs-aarch64 [LIBRARY]
#        bash tests/proofs.sh freestanding LIBRARY [EMULATOR...]
# Exit code: 0 proved, 1 refuted, 77 cannot be told here (the output says why).
# NM, OBJDUMP and CXX name the tools for a library of another machine. On soft-float builds the proof of the symbols is one of no
# floating point: its operations would be calls.
# shellcheck disable=SC2154  # nm and objdump are proof_library.sh's
set -u
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
proof=${1:-}
library=${2:-}
# shellcheck source=tests/proof_library.sh
. "$root/tests/proof_library.sh"

# The library's own source files, headers with the argument "all".
sources() {
  if [ "${1:-}" = all ]; then
    find "$root/core" "$root/simd" -type f \( -name '*.cpp' -o -name '*.h' -o -name '*.hpp' -o -name '*.def' \) | sort
  else
    find "$root/core" "$root/simd" "$root/platform" -maxdepth 1 -type f -name '*.cpp' | sort
    find "$root/simd/scalar" -type f -name '*.cpp' | sort
  fi
}

# Prints all of the library's text without comments, line by line as file:number:text. Text in quotes stays, so that an include
# keeps its path.
without_comments() {
  # shellcheck disable=SC2016  # $0 is awk's
  (cd "$root" && sources all | sed "s|^$root/||" | xargs awk '
    FNR == 1 { in_comment = 0 }
    !in_comment && !/["\047\/]/ { print FILENAME ":" FNR ":" $0; next }
    {
      line = $0; out = ""; i = 1; n = length(line); quote = ""
      while (i <= n) {
        c = substr(line, i, 1); two = substr(line, i, 2)
        if (in_comment) {
          if (two == "*/") { in_comment = 0; i += 2; out = out " " } else i++
        } else if (quote != "") {
          out = out c
          if (c == "\\") { out = out substr(line, i + 1, 1); i++ } else if (c == quote) quote = ""
          i++
        } else if (two == "//") {
          break
        } else if (two == "/*") {
          in_comment = 1; i += 2
        } else {
          # An apostrophe between digits separates digits.
          if (c == "\"" || (c == "\047" && !(substr(line, i - 1, 1) ~ /[0-9a-fA-F]/))) quote = c
          out = out c; i++
        }
      }
      print FILENAME ":" FNR ":" out
    }')
}

# Undefined symbols of the whole archive that it does not define itself.
prove_symbols() {
  need_library "$library" "$nm"
  local allowed='^(memcpy|memset|memmove|memcmp'
  allowed+='|__(u?(div|mod)|u?divmod|mul|ashl|ashr|lshr|neg|u?cmp|popcount|clz|ctz|bswap|parity|ffs)[sdt]i[234]?' # integer helpers
  allowed+='|__gnu_thumb1_case_[us](qi|hi|si)' # switches on ARMv6-M
  allowed+='|__aeabi_(u?idiv(mod)?|u?ldivmod|lmul|llsl|llsr|lasr|u?lcmp|mem(cpy|move|set|clr)[48]?)'
  allowed+='|getauxval' # the capabilities of an ARM processor, which Linux and Android report
  allowed+='|(__)?bzero|memset_pattern16' # what clang makes of memset for Apple's systems
  allowed+='|__mem(cpy|move|set)_chk|__stack_chk_(fail|guard)|_GLOBAL_OFFSET_TABLE_)$' # what distributions add
  local defined undefined foreign own=
  # On Apple's systems every name begins with an underscore more.
  "$nm" -g --defined-only "$library" 2> /dev/null | grep ' _bsm_open$' > /dev/null && own=_
  defined=$("$nm" -g --defined-only "$library" 2> /dev/null | awk -v own="^$own" 'NF >= 3 { sub(own, "", $3); print $3 }' | sort -u)
  undefined=$("$nm" -u "$library" 2> /dev/null | awk -v own="^$own" '!/:$/ { sub(own, "", $NF); print $NF }' | sort -u)
  [ -n "$defined" ] || fail "$nm finds no symbols in $library"
  foreign=$(comm -23 <(echo "$undefined") <(echo "$defined") | grep -Ev "$allowed" | grep .)
  [ -z "$foreign" ] || fail "the library needs: ${foreign//$'\n'/ }"
  echo "needs nothing beyond: $(comm -23 <(echo "$undefined") <(echo "$defined") | grep . | tr '\n' ' ')"
  # Beside the C interface nothing but names of the namespace.
  foreign=$(echo "$defined" | grep -Ev '^(bsm_|_ZNK?3bsm|_ZT[VIS]N?3bsm)')
  [ -z "$foreign" ] || fail "names outside bsm_ and bsm::: ${foreign//$'\n'/ }"
}

# No writable data, no code that runs before main, no exception tables of its own.
prove_sections() {
  need_library "$library" "$nm" "$objdump"
  local bad
  bad=$("$objdump" -h "$library" | awk '
    /file format/ { object = $1 }
    $1 ~ /^[0-9]+$/ {
      name = $2; size = $3
      if (size ~ /^0+$/) next
      if (name ~ /^\.(data|bss|tdata|tbss|sdata|sbss)($|\.)/ && name !~ /^\.data\.rel\.ro/) print object, name, "0x" size
      if (name ~ /^\.(init_array|ctors|preinit_array|fini_array|dtors|init|fini)($|\.)/) print object, name, "0x" size
      if (name ~ /^\.gcc_except_table/) print object, name, "0x" size
      # The names that Apple gives them.
      if (name ~ /^__(data|bss|common|thread_(vars|data|bss)|mod_(init|term)_func|gcc_except_tab)$/) print object, name, "0x" size
    }')
  [ -z "$bad" ] || fail "sections that may not be there: $bad"
  bad=$("$nm" "$library" 2> /dev/null | awk '$2 ~ /^[CBbDd]$/ { print $2, $3 }' | grep -v '_GLOBAL_OFFSET_TABLE_' |
    while read -r kind name; do
      # Constant tables of pointers lie in .data.rel.ro, which nm also calls data.
      "$objdump" -t "$library" | grep -F " $name" | grep -q '\.data\.rel\.ro' || echo "$kind $name"
    done)
  [ -z "$bad" ] || fail "writable symbols: $bad"
  echo "no writable data, no constructors, no exception tables"
}

prove_float() {
  local found
  # Names of types, and literals such as 1.5, .5, 1e3, 2.0f; hexadecimal integers such as 0x1e5 are none.
  found=$(without_comments | sed 's/"[^"]*"//g' |
    grep -E '(^|[^A-Za-z0-9_])(float|double|_Float16|__fp16|float(16|32|64)_t)([^A-Za-z0-9_]|$)|(^|[^A-Za-z0-9_.])([0-9]+\.[0-9]*|\.[0-9]+|[0-9]+[eE][-+]?[0-9]+)')
  [ -z "$found" ] || fail "floating point in the text of the library:
$found"
  echo "no floating point in $(sources all | wc -l) files of core/ and simd/"
}

# core/ may include the two C headers, its own headers, the contract in simd/ and the facts in platform/; simd/ the same without
# core/, and intrinsics in the folders of one instruction set.
prove_includes() {
  local found=0 where name
  while IFS=: read -r where _ name; do
    name=${name#*include}
    name=${name//[[:space:]]/}
    case $where:$name in
      *:"<stdint.h>" | *:"<stddef.h>") continue ;;
      simd/*/*:"<immintrin.h>" | simd/*/*:"<nmmintrin.h>" | simd/*/*:"<arm_neon.h>" | simd/*/*:"<arm_sve.h>") continue ;;
      simd/*/*:"<arm_acle.h>" | simd/*/*:"<arm_mve.h>" | simd/*/*:"<wasm_simd128.h>") continue ;;
      core/include/*:'"bsm/'*) [ -f "$root/core/include/${name//\"/}" ] && continue ;;
      *:'"bsm/bsm.h"') continue ;;
      core/*:'"core/'*.h\" | core/*:'"simd/'*.h\" | simd/*:'"simd/'*.h\" | simd/*:'"simd/'*.def\")
        if [ -f "$root/${name//\"/}" ]; then
          case $where:$name in
            core/*:'"simd/'*/*) ;; # never a file of one instruction set
            *) continue ;;
          esac
        fi
        ;;
      *:'"platform/compiler.h"' | *:'"platform/cpu.h"') continue ;;
    esac
    echo "$where: #include $name"
    found=1
  done < <(without_comments | grep -E '^[^:]*:[0-9]*:[[:space:]]*#[[:space:]]*include')
  [ "$found" = 0 ] || fail "includes that the layering does not allow"
  echo "core/ and simd/ include only <stdint.h>, <stddef.h>, intrinsics and their own headers"
}

# Compiles the scalar library with a compiler that refuses to emit floating point code.
prove_general_regs() {
  local compiler=$1 file
  dir=$(mktemp -d) || fail "no temporary folder"
  trap 'rm -rf "$dir"' EXIT
  # The compiler has to refuse what it is asked to prove absent.
  echo 'int scale(int x) { return (int)(x * 1.5); }' > "$dir/control.cpp"
  if "$compiler" -mgeneral-regs-only -O2 -c "$dir/control.cpp" -o "$dir/control.o" > /dev/null 2>&1; then
    skip "$compiler accepts floating point under -mgeneral-regs-only, which proves nothing"
  fi
  while read -r file; do
    "$compiler" -std=c++17 -O2 -mgeneral-regs-only -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics \
      -I"$root" -I"$root/core/include" -c "$file" -o "$dir/object.o" || fail "${file#"$root"/} does not compile with -mgeneral-regs-only"
  done < <(sources)
  echo "$(sources | wc -l) files compile with $compiler -mgeneral-regs-only"
}

general_regs_x86_64() {
  command -v g++ > /dev/null || skip "g++ is not installed"
  case $(g++ -dumpmachine) in
    x86_64*) prove_general_regs g++ ;;
    *) skip "g++ does not make x86-64 code" ;;
  esac
}

general_regs_aarch64() {
  if command -v aarch64-linux-gnu-g++ > /dev/null; then
    prove_general_regs aarch64-linux-gnu-g++
  elif command -v g++ > /dev/null && [[ $(g++ -dumpmachine) == aarch64* ]]; then
    prove_general_regs g++
  else
    skip "aarch64-linux-gnu-g++ is not installed (Debian/Ubuntu: apt-get install g++-aarch64-linux-gnu)"
  fi
}

# freestanding LIBRARY EMULATOR...: a program of the library and the memory functions alone runs and finds the golden hashes.
prove_freestanding() {
  local compiler=${CXX:-c++}
  need_library "$library" "$nm" "$compiler"
  case $("$compiler" -dumpmachine) in
    x86_64*linux* | aarch64*linux*) ;;
    *) skip "the program has no entry point for $("$compiler" -dumpmachine)" ;;
  esac
  if "$nm" "$library" 2> /dev/null | grep -q '__stack_chk_fail'; then
    skip "the compiler's stack protector needs the C library"
  fi
  dir=$(mktemp -d) || fail "no temporary folder"
  trap 'rm -rf "$dir"' EXIT
  # -O1: GCC makes no memory functions of their own loops.
  "$compiler" -std=c++17 -O1 -ffreestanding -fno-exceptions -fno-rtti -fno-stack-protector -nostdlib -static \
    -I"$root" -I"$root/core/include" -I"$root/platform" "$root/tests/freestanding.cpp" "$root/tests/scene_hashes.cpp" \
    "$root/platform/host/scene.cpp" "$root/platform/host/scene_texture.cpp" "$root/platform/cortexm/memory.cpp" "$library" -o "$dir/program" || fail "the program does not link"
  "$@" "$dir/program" || fail "the program ends with exit code $?; 1: local, 2: sgm"
  echo "a static program without C library computes the golden hashes: $(wc -c < "$dir/program") bytes"
}

case $proof in
  symbols) prove_symbols ;;
  sections) prove_sections ;;
  float) prove_float ;;
  freestanding) prove_freestanding "${@:3}" ;;
  includes) prove_includes ;;
  general-regs-x86_64) general_regs_x86_64 ;;
  general-regs-aarch64) general_regs_aarch64 ;;
  *)
    sed -n '2,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
    exit 2
    ;;
esac
