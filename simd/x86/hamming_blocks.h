// Counts of descriptors by 64-bit words, and blocks of neighbours, a lane for each, that meet pixels of the other view one
// after the other: what does not depend on the length of vectors.
#ifndef BSM_SIMD_X86_HAMMING_BLOCKS_H
#define BSM_SIMD_X86_HAMMING_BLOCKS_H

#include <stddef.h>
#include <stdint.h>

#include "platform/compiler.h"

namespace bsm {
namespace {

// Descriptors and masks of neighbours in a row.
struct View {
  const uint8_t* descriptors;
  const uint8_t* masks;

  View from(ptrdiff_t bytes) const { return View{descriptors + bytes, masks == nullptr ? nullptr : masks + bytes}; }
};

inline uint64_t load_word(const uint8_t* bytes) {
  uint64_t word;
  BSM_MEMCPY(&word, bytes, sizeof word);
  return word;
}

// A number of words that is known when compiling; 0 for any number.
template <int32_t kWords>
struct Words {
  static constexpr int32_t kCount = kWords;
};

// Calls run(Words<n>{}) for descriptors of n words up to kMost, run(Words<0>{}) for longer ones.
template <int32_t kMost, class Run>
inline void with_words(int32_t words, const Run& run) {
  if constexpr (kMost == 0) {
    run(Words<0>{});
  } else if (words == kMost) {
    run(Words<kMost>{});
  } else {
    with_words<kMost - 1>(words, run);
  }
}

// The pixels begin .. end - 1 of a row that meet a block; all of the block's pixels are candidates of those from all_begin
// to all_end - 1.
struct Span {
  int32_t begin, all_begin, all_end, end;

  // least: the first pixel of an endless row that meets one of the `lanes`, of which `pixels` lie in the other view's row.
  Span(int32_t width, int32_t least, int32_t num_disparities, int32_t pixels, int32_t lanes)
      : begin(within(least, width)),
        all_begin(within(least + lanes - 1, width)),
        all_end(within(least + num_disparities, width)),
        end(within(least + num_disparities + lanes - 1, width)) {
    if (pixels < lanes || all_begin >= all_end) all_begin = all_end = end;
  }

 private:
  static int32_t within(int32_t x, int32_t width) { return x < 0 ? 0 : x < width ? x : width; }
};

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_HAMMING_BLOCKS_H
