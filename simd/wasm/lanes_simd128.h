// Vectors of 16 pixels or 8 levels for the kernels of simd/x86 that name their operations: the names of lanes_sse42.h and
// levels_sse42.h in WebAssembly's instructions.
#ifndef BSM_SIMD_WASM_LANES_SIMD128_H
#define BSM_SIMD_WASM_LANES_SIMD128_H

#include <stddef.h>
#include <stdint.h>
#include <wasm_simd128.h>

#include "platform/compiler.h"

namespace bsm {
namespace {

using Bytes = v128_t;
constexpr int32_t kLanes = 16;  // bytes in a vector
using Word = uint16_t;          // a bit for each

inline Bytes load(const void* from) {
  return wasm_v128_load(from);
}
inline void store(void* to, Bytes value) {
  wasm_v128_store(to, value);
}
inline Bytes set8(int32_t value) {
  return wasm_i8x16_splat(static_cast<int8_t>(value));
}
inline Bytes set16(int32_t value) {
  return wasm_i16x8_splat(static_cast<int16_t>(value));
}
inline Bytes zero() {
  return set8(0);
}
inline Bytes table16(const uint8_t* table) {
  return load(table);
}
inline Bytes max8(Bytes a, Bytes b) {
  return wasm_u8x16_max(a, b);
}
inline Bytes min8(Bytes a, Bytes b) {
  return wasm_u8x16_min(a, b);
}
inline Bytes add8(Bytes a, Bytes b) {
  return wasm_i8x16_add(a, b);
}
inline Bytes sub8(Bytes a, Bytes b) {
  return wasm_i8x16_sub(a, b);
}
inline Bytes add8_saturated(Bytes a, Bytes b) {
  return wasm_u8x16_add_sat(a, b);
}
inline Bytes sub8_saturated(Bytes a, Bytes b) {
  return wasm_u8x16_sub_sat(a, b);
}
inline Bytes equal8(Bytes a, Bytes b) {
  return wasm_i8x16_eq(a, b);
}
inline Bytes equal16(Bytes a, Bytes b) {
  return wasm_i16x8_eq(a, b);
}
inline Bytes max16(Bytes a, Bytes b) {
  return wasm_u16x8_max(a, b);
}
inline Bytes min16(Bytes a, Bytes b) {
  return wasm_u16x8_min(a, b);
}
inline Bytes add16(Bytes a, Bytes b) {
  return wasm_i16x8_add(a, b);
}
inline Bytes sub16(Bytes a, Bytes b) {
  return wasm_i16x8_sub(a, b);
}
inline Bytes add16_saturated(Bytes a, Bytes b) {
  return wasm_u16x8_add_sat(a, b);
}
inline Bytes multiply16_low(Bytes a, Bytes b) {
  return wasm_i16x8_mul(a, b);
}
inline Bytes multiply16_high(Bytes a, Bytes b) {
  const Bytes low = wasm_u32x4_extmul_low_u16x8(a, b);
  const Bytes high = wasm_u32x4_extmul_high_u16x8(a, b);
  return wasm_i16x8_shuffle(low, high, 1, 3, 5, 7, 9, 11, 13, 15);
}
// (a * b + 2^14) >> 15, signed.
inline Bytes multiply16_rounded(Bytes a, Bytes b) {
  return wasm_i16x8_q15mulr_sat(a, b);
}
inline Bytes average16(Bytes a, Bytes b) {
  return wasm_u16x8_avgr(a, b);
}
template <int kBits>
inline Bytes left16(Bytes a) {
  return wasm_i16x8_shl(a, kBits);
}
template <int kBits>
inline Bytes right16(Bytes a) {
  return wasm_u16x8_shr(a, kBits);
}
inline Bytes both(Bytes a, Bytes b) {
  return wasm_v128_and(a, b);
}
inline Bytes either(Bytes a, Bytes b) {
  return wasm_v128_or(a, b);
}
inline Bytes differ(Bytes a, Bytes b) {
  return wasm_v128_xor(a, b);
}
inline Bytes ones() {
  return set8(-1);
}
// The entry that the lower four bits of the index name; 0 where its top bit is set.
inline Bytes look_up(Bytes table, Bytes index) {
  return wasm_i8x16_swizzle(table, wasm_v128_and(index, set8(0x8f)));
}
inline Bytes choose(Bytes a, Bytes b, Bytes mask) {  // b where the mask is set
  return wasm_v128_bitselect(b, a, mask);
}
inline Word signs(Bytes a) {
  return static_cast<Word>(wasm_i8x16_bitmask(a));
}
// The first kLanes / 2 bytes at `from` as 16-bit values.
inline Bytes widen(const uint8_t* from) {
  return wasm_u16x8_load8x8(from);
}
// Masks of 16 bits, of pixels 0..7 and 8..15, to a mask of bytes in the order of kPackedByte.
inline Bytes pack(Bytes low, Bytes high) {
  return wasm_i8x16_narrow_i16x8(low, high);
}
constexpr int32_t kPackedByte[kLanes / 8] = {0, 1};  // where byte i of signs(pack(..)) lies

// Byte b of kLanes words goes to vector b, in the order of the words.
inline void split_bytes(const Word* words, Bytes out[kLanes / 8]) {
  const Bytes a = load(words);
  const Bytes b = load(words + 8);
  out[0] = wasm_i8x16_shuffle(a, b, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
  out[1] = wasm_i8x16_shuffle(a, b, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
}

constexpr int32_t kLevelLanes = 8;
alignas(16) constexpr uint16_t kLevelNumbers[kLevelLanes] = {0, 1, 2, 3, 4, 5, 6, 7};

// The least lane, in all lanes.
inline Bytes least_everywhere(Bytes a) {
  a = min16(a, wasm_i16x8_shuffle(a, a, 4, 5, 6, 7, 0, 1, 2, 3));
  a = min16(a, wasm_i16x8_shuffle(a, a, 2, 3, 0, 1, 6, 7, 4, 5));
  return min16(a, wasm_i16x8_shuffle(a, a, 1, 0, 3, 2, 5, 4, 7, 6));
}
// The least lane.
inline uint32_t least_lane(Bytes a) {
  return wasm_u16x8_extract_lane(least_everywhere(a), 0);
}
// Lane k of the result is lane k - 1 of `a`, lane 0 the last of `before`.
inline Bytes from_below(Bytes before, Bytes a) {
  return wasm_i16x8_shuffle(before, a, 7, 8, 9, 10, 11, 12, 13, 14);
}
// Lane k of the result is lane k + 1 of `a`, the last lane the first of `after`.
inline Bytes from_above(Bytes a, Bytes after) {
  return wasm_i16x8_shuffle(a, after, 1, 2, 3, 4, 5, 6, 7, 8);
}

// The first lanes of a pixel's last register: levels, the others are padding.
struct LastLanes {
  Bytes padding;

  explicit LastLanes(int32_t count) : padding(equal16(max16(load(kLevelNumbers), set16(count)), load(kLevelNumbers))) {}
  // Padding reads as ones and keeps what it holds.
  Bytes load_from(const uint16_t* from) const { return either(load(from), padding); }
  void store_to(uint16_t* to, Bytes value) const { store(to, choose(value, load(to), padding)); }
};

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_WASM_LANES_SIMD128_H
