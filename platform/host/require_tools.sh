# shellcheck shell=bash
# Sourced by demo.sh and tests/run.sh: makes sure that programs are there, and installs them on Debian and Ubuntu.
#
#   require_tools TOOL...   returns 0 when every TOOL can be run, after installing what was missing where that is allowed (as
#                           root, or with a sudo that asks for no password); otherwise says what to install and returns 1.
#   missing_tools TOOL...   prints those that cannot be run, one a line; installs nothing.
#
# A TOOL is the name of a command. "c++" and "cc" stand for any compiler: the one that CXX or CC names, else the usual ones.

# True when the command, or a compiler for "c++" and "cc", can be run.
have_tool() {
  # shellcheck disable=SC2086  # unquoted: CXX and CC may hold options after the command
  case $1 in
    c++) set -- ${CXX:-c++ g++ clang++} ;;
    cc) set -- ${CC:-cc gcc clang} ;;
  esac
  local name
  for name in "$@"; do
    command -v "$name" > /dev/null 2>&1 && return 0
  done
  return 1
}

# The Debian package that holds a command.
package_of() {
  case $1 in
    c++ | g++) echo g++ ;;
    cc | gcc) echo gcc ;;
    clang++ | clang) echo clang ;;
    javac | java) echo openjdk-17-jdk-headless ;;
    ninja) echo ninja-build ;;
    *-linux-gnu*-g++) echo "g++-${1%-g++}" ;;
    clang++-16) echo clang-16 ;;
    wasm-ld-16) echo lld-16 ;;
    node) echo nodejs ;;
    llvm-mca-16 | llvm-ar-16) echo llvm-16 ;;
    qemu-aarch64 | qemu-arm | qemu-riscv64 | qemu-s390x | qemu-x86_64) echo qemu-user ;;
    arm-none-eabi-*) echo gcc-arm-none-eabi ;;
    *) echo "$1" ;;
  esac
}

missing_tools() {
  local tool
  for tool in "$@"; do
    have_tool "$tool" || echo "$tool"
  done
}

# Installs Debian packages; returns 1 when that is not possible or not allowed.
install_packages() {
  command -v apt-get > /dev/null 2>&1 || return 1
  local prefix=()
  if [ "$(id -u)" != 0 ]; then
    command -v sudo > /dev/null 2>&1 && sudo -n true 2> /dev/null || return 1
    prefix=(sudo -n)
  fi
  local apt=("${prefix[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300)
  echo "installing $*" >&2
  "${apt[@]}" install -y --no-install-recommends "$@" > /dev/null 2>&1 && return 0
  # A package list that is missing or old is the usual reason.
  "${apt[@]}" update > /dev/null || return 1
  "${apt[@]}" install -y --no-install-recommends "$@" >&2
}

require_tools() {
  local missing tool packages=()
  missing=$(missing_tools "$@")
  [ -z "$missing" ] && return 0
  for tool in $missing; do
    packages+=("$(package_of "$tool")")
  done
  install_packages "${packages[@]}" && missing=$(missing_tools "$@")
  [ -z "$missing" ] && return 0
  {
    echo "missing: ${missing//$'\n'/ }"
    if command -v apt-get > /dev/null 2>&1; then
      echo "install with: sudo apt-get install --no-install-recommends ${packages[*]}"
    else
      echo "install a C and C++17 compiler, CMake 3.16 or later and make with your system's package manager, then try again"
    fi
  } >&2
  return 1
}
