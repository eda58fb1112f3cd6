# shellcheck shell=bash disable=SC2154  # root, jobs and the counts are run.sh's
# Cortex-M: the images of platform/cortexm on emulated boards, and proofs about the library they hold.

# on_board CORE BOARD IMAGE ARGUMENT...: runs an image; its messages go to standard output.
on_board() {
  local core=$1 board=$2 image=$root/build/cortex-$1/platform/cortexm/$3-$2.elf arguments="enable=on,target=native,arg=image" word
  shift 3
  for word in "$@"; do arguments+=",arg=$word"; done
  timeout 120 qemu-system-arm -M "$board" -kernel "$image" -display none -monitor none -serial none \
    -semihosting-config "$arguments" 2>&1
}

golden_hash() { sed -nE "s/^\{\"$1\", (0x[0-9a-f]+)u\},$/\1/p" "$root/tests/golden.inc"; }

# The golden hash NAME, by kernels of ISA and within 2 KB of stack.
gives_hash() {
  local name=$1 isa=$2 core=$3 hash output
  shift 2
  hash=$(golden_hash "$name")
  [ -n "$hash" ] || { echo "tests/golden.inc has no hash '$name'"; return 1; }
  output=$(on_board "$@") || { echo "$output"; return 1; }
  echo "$output" > "$out/$core ${name%% *}"
  echo "$output, expected isa=$isa hash=$hash stack<=2048"
  grep -qF "isa=$isa hash=$hash " <<< "$output" && [ "$(sed -n 's/.* stack=\([0-9]*\).*/\1/p' <<< "$output")" -le 2048 ]
}

# The example on a board writes the map that the program writes on this computer.
example_map() {
  local core=$1 board=$2 left=$3 right=$4
  rm -f "$out/board.pgm"
  "$program" match "$left" "$right" -o "$out/computer.pgm" --preset fast --speckle 0 --disparities 32 &&
    on_board "$core" "$board" example "$left" "$right" "$out/board.pgm" && cmp "$out/board.pgm" "$out/computer.pgm"
}

# The smallest board takes a small configuration.
microbit_map() {
  rm -f "$out/board.pgm"
  "$program" match "$out/16/left.pgm" "$out/16/right.pgm" -o "$out/computer.pgm" --preset fast --speckle 0 --disparities 4 --bits 64 \
    --vote-radius 4 --vote-step 2 --smooth-radius 1 --smooth-passes 1 --border 0 &&
    on_board m0 microbit probe width=16 height=12 disparities=4 format=gray8 preset=fast speckle=0 bits=64 vote_radius=4 \
      vote_step=2 smooth_radius=1 smooth_passes=1 border=0 "map=$out/board.pgm" && cmp "$out/board.pgm" "$out/computer.pgm"
}

# All of the library links with the memory functions and the compiler's integer helpers, and with nothing else.
links_freestanding() {
  local build=$root/build/cortex-$1
  arm-none-eabi-g++ "-mcpu=cortex-$1" -mthumb -nostdlib -Wl,--entry=bsm_open -Wl,--whole-archive "$build/core/libbsm.a" \
    -Wl,--no-whole-archive "$build/platform/cortexm/CMakeFiles/bsm_startup.dir/memory.cpp.obj" -lgcc \
    -Wl,--defsym=__aeabi_unwind_cpp_pr0=0 -o "$out/whole.elf" && arm-none-eabi-size "$out/whole.elf"
}

# The processor's own instructions for the assembler, without a floating-point unit.
instructions_of() {
  case $1 in
    m55) echo -march=armv8.1-m.main+mve ;;
    *) echo "-mcpu=cortex-$1 -mfpu=softvfp" ;;
  esac
}

# flash_within CORE BYTES: code and constants of a build's library.
flash_within() {
  local bytes
  bytes=$(bash "$root/platform/cortexm/measure.sh" --flash "$root/build/cortex-$1") || return 1
  echo "$bytes bytes, expected at most $2"
  [ "$bytes" -le "$2" ]
}

# A library with floating point in it, which the proof of the symbols has to refuse.
make_float_library() {
  echo 'extern "C" int bsm_scale(int x) { return static_cast<int>(static_cast<float>(x) * 1.5f); }' > "$out/float.cpp" &&
    arm-none-eabi-g++ -mcpu=cortex-m4 -mfloat-abi=soft -mthumb -ffreestanding -O2 -c "$out/float.cpp" -o "$out/float.o" &&
    rm -f "$out/float.a" && arm-none-eabi-ar rcs "$out/float.a" "$out/float.o"
}

# test_core CORE BOARD ISA: everything about one core on its board with much memory.
test_core() {
  local core=$1 board=$2 isa=$3 before=${#failed[@]} kernels=$3 result=passed way arguments
  expect "$core, build" build "$root" "$root/build/cortex-$core" all "-DCMAKE_TOOLCHAIN_FILE=$root/toolchains/cortex-$core.cmake" \
    -DCMAKE_BUILD_TYPE=Release -DBSM_WERROR=ON || {
    add_row "cortex-$core" "$board" - - - - failed
    return
  }
  expect "$core, needs memory functions and integer helpers alone, no heap and no floating point" \
    proof arm-none-eabi proofs.sh symbols "$root/build/cortex-$core/core/libbsm.a"
  expect "$core, no writable data, no constructors" proof arm-none-eabi proofs.sh sections "$root/build/cortex-$core/core/libbsm.a"
  # shellcheck disable=SC2046  # flags are words of their own
  expect "$core, no instruction that it lacks, no floating-point arithmetic" \
    proof arm-none-eabi objects.sh scan "$root/build/cortex-$core/core/libbsm.a" -mthumb $(instructions_of "$core")
  expect "$core, links freestanding" links_freestanding "$core"
  expect "$core, $board: the example's map is this computer's" example_map "$core" "$board" "$out/160/left.ppm" "$out/160/right.ppm"
  expect "$core, $board: sgm, rows, $isa" gives_hash "fast rgb24 refined left" "$isa" "$core" "$board" probe preset=fast
  expect "$core, $board: sgm, frame, $isa" gives_hash "fast rgb24 refined left" "$isa" "$core" "$board" probe preset=fast frame=1
  expect "$core, $board: local, rows, $isa" gives_hash "256 rgb24 refined left" "$isa" "$core" "$board" probe preset=paper bits=256
  expect "$core, $board: preset local, rows, $isa" gives_hash "local rgb24 refined left" "$isa" "$core" "$board" probe preset=local
  expect "$core, $board: local, frame, $isa" \
    gives_hash "256 rgb24 refined left" "$isa" "$core" "$board" probe preset=paper bits=256 frame=1
  if [ "$isa" != scalar ]; then
    kernels+=+scalar
    for way in rows frame; do
      arguments=(scalar=1)
      [ $way = rows ] || arguments+=(frame=1)
      expect "$core, $board: sgm, $way, scalar" \
        gives_hash "fast rgb24 refined left" scalar "$core" "$board" probe preset=fast "${arguments[@]}"
      expect "$core, $board: local, $way, scalar" \
        gives_hash "256 rgb24 refined left" scalar "$core" "$board" probe preset=paper bits=256 "${arguments[@]}"
    done
  fi
  [ "$isa" = scalar ] || test_kernels_on "$core" "$board" "$isa"
  [ ${#failed[@]} -eq "$before" ] || result=failed
  add_row "cortex-$core" "$board" "$kernels" "$(last_hash "$core 256")" "$(last_hash "$core fast")" frame+rows "$result"
}

# A library with parts left out, which the folder's name says.
test_small() {
  local core=m4-small board=mps2-an386
  expect "$core, build" build "$root" "$root/build/cortex-$core" "example-$board probe-$board" \
    "-DCMAKE_TOOLCHAIN_FILE=$root/toolchains/cortex-m4.cmake" -DCMAKE_BUILD_TYPE=Release -DBSM_WERROR=ON -DBSM_LOCAL=OFF \
    -DBSM_COLOR=OFF -DBSM_CONFIDENCE=OFF -DBSM_SCALAR=OFF -DBSM_TEXT=OFF || return
  expect "$core, within 20 KB of flash" flash_within "$core" 20480
  expect "$core, $board: the example's map is this computer's" example_map "$core" "$board" "$out/160/left.pgm" "$out/160/right.pgm"
  expect "$core, $board: scalar kernels, refused" refuses "bsm: -45" on_board "$core" "$board" probe format=gray8 preset=fast scalar=1
}

# The hash that a core's last run gave.
last_hash() { sed -nE 's/.*hash=0x([0-9a-f]+).*/\1/p' "$out/$1" 2> /dev/null | grep . || echo -; }

run_cortexm() {
  local out=$root/build/cortexm program=$root/build/tests/platform/host/bsm size
  if ! require_tools arm-none-eabi-g++ qemu-system-arm > /dev/null 2>&1; then
    skip_target cortexm - "arm-none-eabi-g++ or qemu-system-arm is not installed and cannot be installed here (Debian and Ubuntu: apt-get install --no-install-recommends gcc-arm-none-eabi qemu-system-arm)"
    return
  fi
  rm -rf "$out"
  mkdir -p "$out"
  echo "== cortexm: building in $root/build/cortex-*"
  expect "program for this computer" build "$root" "$root/build/tests" bsm_program -DCMAKE_BUILD_TYPE=Release -DBSM_WERROR=ON || return
  for size in 160:120:32 64:48:32 16:12:4; do
    IFS=: read -r width height disparities <<< "$size"
    expect "scene of $width x $height" "$program" demo "$out/$width" --width "$width" --height "$height" --disparities "$disparities" &&
      gray_pair "$out/$width"
  done

  test_core m0 mps2-an385 scalar
  expect "m0, mps2-an385: a misaligned access faults" refuses "hard fault" on_board m0 mps2-an385 probe fault=1
  expect "m0, microbit: a misaligned access faults" refuses "hard fault" on_board m0 microbit probe fault=1
  expect "m0, microbit: the map is this computer's" microbit_map
  test_core m3 mps2-an385 scalar
  expect "m3, lm3s6965evb: the example's map is this computer's" example_map m3 lm3s6965evb "$out/64/left.pgm" "$out/64/right.pgm"
  test_core m4 mps2-an386 dsp
  expect "m4, netduinoplus2: the example's map is this computer's" \
    example_map m4 netduinoplus2 "$out/160/left.pgm" "$out/160/right.pgm"
  expect "m4, netduinoplus2: sgm, rows" gives_hash "fast gray8 without speckle filter left" dsp m4 netduinoplus2 \
    probe format=gray8 preset=fast speckle=0
  expect "m4, netduinoplus2: local, rows" gives_hash "256 rgb24 refined left" dsp m4 netduinoplus2 probe preset=paper bits=256
  expect "m4, within 48 KB of flash" flash_within m4 49152
  test_small
  test_core m7 mps2-an500 dsp
  test_core m33 mps2-an505 dsp
  test_core m55 mps3-an547 mve
  expect "a library with floating point" make_float_library
  expect "floating point, refused" refuses "__aeabi_fmul" proof arm-none-eabi proofs.sh symbols "$out/float.a"
}
