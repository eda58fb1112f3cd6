// NEON for the kernels of both word sizes: one name for what AArch64 does in one instruction and ARMv7 in several.
#ifndef BSM_SIMD_ARM_NEON_H
#define BSM_SIMD_ARM_NEON_H

#include <arm_neon.h>
#include <stddef.h>
#include <stdint.h>

#include "platform/compiler.h"

// Before a loop of a constant few rounds: unrolled for the 32 registers of AArch64. With the 16 of ARMv7 it stays a loop,
// since clang would load for all rounds first and keep that on the stack.
#if defined(__aarch64__)
#define BSM_UNROLL_A64 BSM_UNROLL
#else
#define BSM_UNROLL_A64 BSM_KEEP_LOOP
#endif

namespace bsm {
namespace {

// An address as it stands: loads at constant distances from it share it, two of them in one instruction.
template <class T>
inline const T* one_address(const T* address) {
  __asm__("" : "+r"(address));
  return address;
}

// A vector after a branch: its lanes are not taken out before.
inline uint16x8_t taken_here(uint16x8_t vector) {
  __asm__ volatile("" : "+w"(vector));
  return vector;
}

// Sums of neighbouring lanes: those of a in the lower half of the result, those of b in the upper one.
inline uint8x16_t add_pairs8(uint8x16_t a, uint8x16_t b) {
#if defined(__aarch64__)
  return vpaddq_u8(a, b);
#else
  return vcombine_u8(vpadd_u8(vget_low_u8(a), vget_high_u8(a)), vpadd_u8(vget_low_u8(b), vget_high_u8(b)));
#endif
}

inline uint16x8_t add_pairs16(uint16x8_t a, uint16x8_t b) {
#if defined(__aarch64__)
  return vpaddq_u16(a, b);
#else
  return vcombine_u16(vpadd_u16(vget_low_u16(a), vget_high_u16(a)), vpadd_u16(vget_low_u16(b), vget_high_u16(b)));
#endif
}

inline uint8_t least8(uint8x16_t a) {
#if defined(__aarch64__)
  return vminvq_u8(a);
#else
  uint8x8_t least = vpmin_u8(vget_low_u8(a), vget_high_u8(a));
  least = vpmin_u8(least, least);
  least = vpmin_u8(least, least);
  return vget_lane_u8(vpmin_u8(least, least), 0);
#endif
}

inline uint8_t most8(uint8x16_t a) {
#if defined(__aarch64__)
  return vmaxvq_u8(a);
#else
  uint8x8_t most = vpmax_u8(vget_low_u8(a), vget_high_u8(a));
  most = vpmax_u8(most, most);
  most = vpmax_u8(most, most);
  return vget_lane_u8(vpmax_u8(most, most), 0);
#endif
}

inline uint16_t least16(uint16x8_t a) {
#if defined(__aarch64__)
  return vminvq_u16(a);
#else
  uint16x4_t least = vpmin_u16(vget_low_u16(a), vget_high_u16(a));
  least = vpmin_u16(least, least);
  return vget_lane_u16(vpmin_u16(least, least), 0);
#endif
}

inline uint16_t most16(uint16x8_t a) {
#if defined(__aarch64__)
  return vmaxvq_u16(a);
#else
  uint16x4_t most = vpmax_u16(vget_low_u16(a), vget_high_u16(a));
  most = vpmax_u16(most, most);
  return vget_lane_u16(vpmax_u16(most, most), 0);
#endif
}

inline uint32_t least32(uint32x4_t a) {
#if defined(__aarch64__)
  return vminvq_u32(a);
#else
  const uint32x2_t least = vpmin_u32(vget_low_u32(a), vget_high_u32(a));
  return vget_lane_u32(vpmin_u32(least, least), 0);
#endif
}

inline uint32_t most32(uint32x4_t a) {
#if defined(__aarch64__)
  return vmaxvq_u32(a);
#else
  const uint32x2_t most = vpmax_u32(vget_low_u32(a), vget_high_u32(a));
  return vget_lane_u32(vpmax_u32(most, most), 0);
#endif
}

inline uint32_t sum16(uint16x8_t a) {
#if defined(__aarch64__)
  return vaddlvq_u16(a);
#else
  const uint64x2_t sums = vpaddlq_u32(vpaddlq_u16(a));
  return static_cast<uint32_t>(vgetq_lane_u64(sums, 0) + vgetq_lane_u64(sums, 1));
#endif
}

// The lower byte of each lane, those of a in the lower half.
inline uint8x16_t low_bytes(uint16x8_t a, uint16x8_t b) {
#if defined(__aarch64__)
  return vuzp1q_u8(vreinterpretq_u8_u16(a), vreinterpretq_u8_u16(b));
#else
  return vcombine_u8(vmovn_u16(a), vmovn_u16(b));
#endif
}

// Four bits for each of sixteen flags, the first lowest.
inline uint64_t flag_nibbles(uint8x16_t flags) {
  return vget_lane_u64(vreinterpret_u64_u8(vshrn_n_u16(vreinterpretq_u16_u8(flags), 4)), 0);
}

// The first `count` bytes all ones, the others zeros.
inline uint8x16_t first_lanes(int32_t count) {
  alignas(16) static constexpr uint8_t kLane[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  return vcltq_u8(vld1q_u8(kLane), vdupq_n_u8(static_cast<uint8_t>(count)));
}

// A table of 16 bytes; 0 for indices from 16 on.
#if defined(__aarch64__)
using Table16 = uint8x16_t;

inline Table16 load_table16(const uint8_t* from) {
  return vld1q_u8(from);
}

inline uint8x16_t look_up(Table16 table, uint8x16_t index) {
  return vqtbl1q_u8(table, index);
}
#else
using Table16 = uint8x8x2_t;

inline Table16 load_table16(const uint8_t* from) {
  return Table16{{vld1_u8(from), vld1_u8(from + 8)}};
}

inline uint8x16_t look_up(Table16 table, uint8x16_t index) {
  return vcombine_u8(vtbl2_u8(table, vget_low_u8(index)), vtbl2_u8(table, vget_high_u8(index)));
}
#endif

// A table of 64 bytes; 0 for indices from 64 on. In memory ARMv7 interleaves the bytes, which its compilers load as they
// are.
#if defined(__aarch64__)
using Table64 = uint8x16x4_t;

inline void store_table64(const uint8x16_t (&bytes)[4], uint8_t* to) {
  for (int32_t i = 0; i < 4; ++i) vst1q_u8(to + 16 * i, bytes[i]);
}

inline Table64 load_table64(const uint8_t* from) {
  return vld1q_u8_x4(from);
}

inline uint8x16_t look_up(const Table64& table, uint8x16_t index) {
  return vqtbl4q_u8(table, index);
}
#else
struct Table64 {
  uint8x8x4_t low, high;
};

inline void store_table64(const uint8x16_t (&bytes)[4], uint8_t* to) {
  for (int32_t i = 0; i < 2; ++i) {
    const uint8x16_t a = bytes[2 * i], b = bytes[2 * i + 1];
    const uint8x8x4_t eights = {{vget_low_u8(a), vget_high_u8(a), vget_low_u8(b), vget_high_u8(b)}};
    vst4_u8(to + 32 * i, eights);
  }
}

inline Table64 load_table64(const uint8_t* from) {
  return Table64{vld4_u8(from), vld4_u8(from + 32)};
}

inline uint8x8_t look_up_half(const Table64& table, uint8x8_t index) {
  const uint8x8_t low = vtbl4_u8(table.low, index);  // 0 from 32 on
  return vtbx4_u8(low, table.high, vsub_u8(index, vdup_n_u8(32)));
}

inline uint8x16_t look_up(const Table64& table, uint8x16_t index) {
  return vcombine_u8(look_up_half(table, vget_low_u8(index)), look_up_half(table, vget_high_u8(index)));
}
#endif

// A table of 128 bytes; indices are below 128.
#if defined(__aarch64__)
struct Table128 {
  uint8x16x4_t low, high;
};

inline Table128 load_table128(const uint8_t* from) {
  Table128 table;
  for (int32_t i = 0; i < 4; ++i) {
    table.low.val[i] = vld1q_u8(from + 16 * i);
    table.high.val[i] = vld1q_u8(from + 64 + 16 * i);
  }
  return table;
}

inline uint8x16_t look_up(const Table128& table, uint8x16_t index) {
  const uint8x16_t low = vqtbl4q_u8(table.low, index);  // 0 from 64 on
  return vqtbx4q_u8(low, table.high, vsubq_u8(index, vdupq_n_u8(64)));
}
#else
struct Table128 {
  uint8x8x4_t quarters[4];
};

inline Table128 load_table128(const uint8_t* from) {
  Table128 table;
  for (int32_t i = 0; i < 16; ++i) table.quarters[i / 4].val[i % 4] = vld1_u8(from + 8 * i);
  return table;
}

inline uint8x8_t look_up_half(const Table128& table, uint8x8_t index) {
  uint8x8_t value = vtbl4_u8(table.quarters[0], index);  // 0 from 32 on
  for (int32_t i = 1; i < 4; ++i) {
    index = vsub_u8(index, vdup_n_u8(32));
    value = vtbx4_u8(value, table.quarters[i], index);
  }
  return value;
}

inline uint8x16_t look_up(const Table128& table, uint8x16_t index) {
  return vcombine_u8(look_up_half(table, vget_low_u8(index)), look_up_half(table, vget_high_u8(index)));
}
#endif

// Eight bytes, zeros above them.
inline uint8x16_t load_half(const uint8_t* from) {
  return vcombine_u8(vld1_u8(from), vdup_n_u8(0));
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_NEON_H
