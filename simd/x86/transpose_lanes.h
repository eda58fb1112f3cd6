// Words of kLanes pixels to descriptors, for AVX2 and SSE4.2: bit x of word i becomes bit i of pixel x. The signs of a
// vector of one byte of kLanes words are kLanes bits of one pixel: two instructions and a store for each. Include after the
// lanes of one instruction set.
#ifndef BSM_SIMD_X86_TRANSPOSE_LANES_H
#define BSM_SIMD_X86_TRANSPOSE_LANES_H

namespace bsm {
namespace {

// `count` words (a multiple of kLanes) to the descriptors of `pixels` pixels, `stride` bytes apart. byte_of[i]: where in a
// word the bits of pixels 8 i .. 8 i + 7 lie. kInverted: the words hold the opposite of the bits.
template <bool kInverted>
BSM_NOINLINE void store_descriptors(const Word* words, int32_t count, const int32_t (&byte_of)[kLanes / 8], int32_t pixels,
                                    uint8_t* out, ptrdiff_t stride) {
  for (int32_t first = 0; first < count; first += kLanes, out += kLanes / 8) {
    Bytes bytes[kLanes / 8];
    split_bytes(words + first, bytes);
    BSM_UNROLL
    for (int32_t octet = 0; octet < kLanes / 8; ++octet) {
      Bytes bits = bytes[byte_of[octet]];
      if (kInverted) bits = differ(bits, set8(-1));
      BSM_UNROLL
      for (int32_t x = 7; x >= 0; --x) {
        const Word word = signs(bits);
        bits = add8(bits, bits);
        if (8 * octet + x < pixels) BSM_MEMCPY(out + (8 * octet + x) * stride, &word, sizeof word);
      }
    }
  }
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_TRANSPOSE_LANES_H
