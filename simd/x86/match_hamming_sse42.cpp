// match_hamming, POPCNT: 64-bit words, the XOR shared by both views.
// Counting of a long candidate stops, eight words at a time, once neither view can win. Bound, per word of a candidate and
// both views: 1 XOR, 2 ANDs, 2 population counts, 2 additions; 4 loads.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include <nmmintrin.h>

#include "simd/x86/match_row.h"

namespace bsm {
namespace {

constexpr int32_t kStopWords = 8;

template <bool kMasked, int32_t kWords>
inline Costs count(Pixel left, Pixel right, ptrdiff_t at) {
  uint64_t left_count = 0, right_count = 0;
  BSM_UNROLL
  for (int32_t i = 0; i < kWords; ++i, at += 8) {
    const uint64_t differing = load_word(left.descriptor + at) ^ load_word(right.descriptor + at);
    if (kMasked) {
      left_count += static_cast<uint64_t>(_mm_popcnt_u64(differing & load_word(left.mask + at)));
      right_count += static_cast<uint64_t>(_mm_popcnt_u64(differing & load_word(right.mask + at)));
    } else {
      left_count += static_cast<uint64_t>(_mm_popcnt_u64(differing));
    }
  }
  return Costs{static_cast<uint32_t>(left_count), static_cast<uint32_t>(kMasked ? right_count : left_count)};
}

// Descriptors of exactly kWords words.
template <bool kMasked, int32_t kWords>
void match_short(const MatchHammingArgs& args) {
  match_row<kMasked>(args,
                     [](Pixel left, Pixel right, uint32_t, uint32_t) { return count<kMasked, kWords>(left, right, 0); });
}

template <bool kMasked>
void match_any(const MatchHammingArgs& args) {
  const int32_t words = args.bits / 64;
  match_row<kMasked>(args, [words](Pixel left, Pixel right, uint32_t left_limit, uint32_t right_limit) {
    Costs costs{0, 0};
    int32_t i = 0;
    for (; i + kStopWords <= words; i += kStopWords) {
      const Costs more = count<kMasked, kStopWords>(left, right, ptrdiff_t{i} * 8);
      costs.left += more.left;
      costs.right += more.right;
      if (costs.left > left_limit && costs.right > right_limit) return costs;
    }
    for (; i < words; ++i) {
      const Costs more = count<kMasked, 1>(left, right, ptrdiff_t{i} * 8);
      costs.left += more.left;
      costs.right += more.right;
    }
    return costs;
  });
}

template <bool kMasked>
void match(const MatchHammingArgs& args) {
  switch (args.bits / 64) {
    case 1:
      return match_short<kMasked, 1>(args);
    case 2:
      return match_short<kMasked, 2>(args);
    case 4:
      return match_short<kMasked, 4>(args);
    default:
      return match_any<kMasked>(args);
  }
}

}  // namespace

uint64_t match_hamming_sse42_scratch(const KernelShape& shape) {
  return match_scratch_bytes(shape);
}

void match_hamming_sse42(const MatchHammingArgs& args) {
  if (args.left_mask != nullptr) {
    match<true>(args);
  } else {
    match<false>(args);
  }
}

}  // namespace bsm
#endif
