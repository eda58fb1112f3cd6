// Compiler facts: the machine's family, memory intrinsics without libc headers. Includes nothing of ours.
#ifndef BSM_PLATFORM_COMPILER_H
#define BSM_PLATFORM_COMPILER_H

#include <stddef.h>
#include <stdint.h>

#if defined(__x86_64__) || defined(__i386__) || defined(_M_X64) || defined(_M_IX86)
#define BSM_ARCH_X86 1
#else
#define BSM_ARCH_X86 0
#endif
#if (defined(__x86_64__) || defined(_M_X64)) && (defined(__GNUC__) || defined(__clang__))
#define BSM_ARCH_X86_64 1  // with the kernels' intrinsics and flags
#else
#define BSM_ARCH_X86_64 0
#endif
#if defined(__aarch64__) || defined(__arm__) || defined(_M_ARM64) || defined(_M_ARM)
#define BSM_ARCH_ARM 1
#else
#define BSM_ARCH_ARM 0
#endif
// NEON with the kernels' intrinsics and flags: AArch64, or an ARMv7 that passes arguments to them; little-endian.
#if (defined(__GNUC__) || defined(__clang__)) && !defined(__ARM_BIG_ENDIAN) && defined(__aarch64__)
#define BSM_ARCH_NEON 1
#elif (defined(__GNUC__) || defined(__clang__)) && !defined(__ARM_BIG_ENDIAN) && defined(__arm__) && \
    defined(__ARM_ARCH_PROFILE) && !defined(__SOFTFP__)
#define BSM_ARCH_NEON (__ARM_ARCH_PROFILE == 'A')
#else
#define BSM_ARCH_NEON 0
#endif

#if defined(__ARM_ARCH_PROFILE)
#define BSM_ARCH_CORTEX_M (__ARM_ARCH_PROFILE == 'M')
#else
#define BSM_ARCH_CORTEX_M 0
#endif
// M-profile processors, little-endian: vectors of integers, or else SIMD in core registers. Such a processor reports nothing
// at run time; what the compiler targets is what it has.
#if (defined(__GNUC__) || defined(__clang__)) && !defined(__ARM_BIG_ENDIAN) && defined(__ARM_FEATURE_MVE)
#define BSM_ARCH_MVE (__ARM_FEATURE_MVE & 1)
#else
#define BSM_ARCH_MVE 0
#endif
#if (defined(__GNUC__) || defined(__clang__)) && !defined(__ARM_BIG_ENDIAN) && defined(__ARM_FEATURE_SIMD32) && !BSM_ARCH_MVE
#define BSM_ARCH_DSP BSM_ARCH_CORTEX_M
#else
#define BSM_ARCH_DSP 0
#endif

// WebAssembly's vectors of 128 bits: a module that holds them runs on no engine without.
#if defined(__wasm_simd128__)
#define BSM_ARCH_SIMD128 1
#else
#define BSM_ARCH_SIMD128 0
#endif

// SVE: on Linux and Android, which report it.
#if BSM_ARCH_NEON && defined(__aarch64__) && defined(__linux__)
#define BSM_ARCH_SVE 1
#else
#define BSM_ARCH_SVE 0
#endif

// Before a loop of a constant few rounds: unrolled whole, so that arrays indexed in it live in registers; or left a loop.
#if defined(__clang__)
#define BSM_UNROLL _Pragma("unroll")
#define BSM_KEEP_LOOP _Pragma("nounroll")
#elif defined(__GNUC__)
#define BSM_UNROLL _Pragma("GCC unroll 16")
#define BSM_KEEP_LOOP _Pragma("GCC unroll 1")
#else
#define BSM_UNROLL
#define BSM_KEEP_LOOP
#endif

#if defined(__GNUC__) || defined(__clang__)
#define BSM_MEMCPY(to, from, bytes) __builtin_memcpy((to), (from), (bytes))
#define BSM_MEMSET(to, byte, bytes) __builtin_memset((to), (byte), (bytes))
#define BSM_RESTRICT __restrict__
#define BSM_NOINLINE __attribute__((noinline))
#define BSM_COLD __attribute__((noinline, cold))            // made for size
#define BSM_KEEP_ORDER() __asm__ volatile("" ::: "memory")  // loads below stay below: fewer values wait in registers
#define BSM_INLINE inline __attribute__((always_inline))
#else
#include <string.h>
#define BSM_MEMCPY(to, from, bytes) memcpy((to), (from), (bytes))
#define BSM_MEMSET(to, byte, bytes) memset((to), (byte), (bytes))
#define BSM_RESTRICT __restrict
#define BSM_NOINLINE __declspec(noinline)
#define BSM_COLD BSM_NOINLINE
#define BSM_KEEP_ORDER()
#define BSM_INLINE __forceinline
#endif

// Adds one to a count and gives the count before. With BSM_HAS_ATOMICS several threads may: what a thread did before its
// turn is seen by those whose turn comes later.
#if defined(__GCC_HAVE_SYNC_COMPARE_AND_SWAP_4)
#define BSM_HAS_ATOMICS 1
#define BSM_COUNT_UP(count) __atomic_fetch_add((count), 1u, __ATOMIC_ACQ_REL)
#elif defined(_MSC_VER)
#include <intrin.h>
#define BSM_HAS_ATOMICS 1
#define BSM_COUNT_UP(count) (static_cast<uint32_t>(_InterlockedIncrement(reinterpret_cast<volatile long*>(count))) - 1u)
#else
#define BSM_HAS_ATOMICS 0
#define BSM_COUNT_UP(count) ((*(count))++)
#endif
// Before a function that counts up: made of the first AArch64's instructions, instead of a call into the compiler's library,
// which asks the operating system for newer ones.
#if defined(__aarch64__) && !defined(__APPLE__) && \
    ((defined(__clang__) && __clang_major__ >= 12) || (!defined(__clang__) && defined(__GNUC__) && __GNUC__ >= 10))
#define BSM_COUNTS __attribute__((noinline, target("no-outline-atomics")))
#else
#define BSM_COUNTS
#endif

#endif  // BSM_PLATFORM_COMPILER_H
