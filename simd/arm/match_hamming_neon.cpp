// match_hamming, NEON: four candidates of a left pixel at once, the XOR shared by both views.
// A winner is the least of cost and level in one 32-bit key, so that ties need no order. Long descriptors: the first bits of
// all candidates guess each pixel's winner, whose whole cost bounds the others, and counting of four candidates stops once
// none of them can win in either view. Bound, per 128 bits of a candidate and both views: 1 XOR, 2 ANDs, 2 population
// counts, 2 additions; 2.5 loads.
#include "platform/compiler.h"

#if BSM_ARCH_NEON
#include "simd/arm/neon.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kGroup = 4;            // candidates at once
constexpr int32_t kLevelBits = 12;       // of a key, below the cost
constexpr uint32_t kNone = 0xffffffffu;  // no candidate
constexpr ptrdiff_t kChunk = 64;         // bytes counted between two looks at the bounds; bytes count within 255 / 4 bits
constexpr ptrdiff_t kGuess = 16;         // bytes that a guess looks at
constexpr ptrdiff_t kLong = 96;          // descriptors of more bytes than this are guessed first

struct View {
  const uint8_t* descriptors;
  const uint8_t* masks;
};

struct Counts {
  uint8x16_t left[kGroup], right[kGroup];
};

template <bool kMasked>
inline void add_vector(Counts& counts, const View& own, const View& other, ptrdiff_t bytes, ptrdiff_t at) {
  const uint8x16_t descriptor = vld1q_u8(own.descriptors + at);
  const uint8x16_t mask = kMasked ? vld1q_u8(own.masks + at) : descriptor;
  BSM_UNROLL
  for (int32_t i = 0; i < kGroup; ++i) {
    const uint8x16_t differing = veorq_u8(descriptor, vld1q_u8(other.descriptors + i * bytes + at));
    if (kMasked) {
      counts.left[i] = vaddq_u8(counts.left[i], vcntq_u8(vandq_u8(differing, mask)));
      counts.right[i] = vaddq_u8(counts.right[i], vcntq_u8(vandq_u8(differing, vld1q_u8(other.masks + i * bytes + at))));
    } else {
      counts.left[i] = vaddq_u8(counts.left[i], vcntq_u8(differing));
    }
  }
}

// The last eight bytes of a descriptor.
template <bool kMasked>
inline void add_half(Counts& counts, const View& own, const View& other, ptrdiff_t bytes, ptrdiff_t at) {
  BSM_UNROLL
  for (int32_t i = 0; i < kGroup; ++i) {
    const uint8x16_t differing = veorq_u8(load_half(own.descriptors + at), load_half(other.descriptors + i * bytes + at));
    if (kMasked) {
      counts.left[i] = vaddq_u8(counts.left[i], vcntq_u8(vandq_u8(differing, load_half(own.masks + at))));
      counts.right[i] = vaddq_u8(counts.right[i], vcntq_u8(vandq_u8(differing, load_half(other.masks + i * bytes + at))));
    } else {
      counts.left[i] = vaddq_u8(counts.left[i], vcntq_u8(differing));
    }
  }
}

// Sums of the candidates: lanes 0..3 of the left view, 4..7 of the right one.
template <bool kMasked>
inline uint16x8_t add_up(const Counts& c) {
  const uint8x16_t left = add_pairs8(add_pairs8(c.left[0], c.left[1]), add_pairs8(c.left[2], c.left[3]));
  const uint16x8_t l = vpaddlq_u8(left);
  if (!kMasked) return add_pairs16(l, l);
  const uint8x16_t right = add_pairs8(add_pairs8(c.right[0], c.right[1]), add_pairs8(c.right[2], c.right[3]));
  return add_pairs16(l, vpaddlq_u8(right));
}

// Counts of kChunk bytes from `at` on: candidate by candidate, so that each has one address.
template <bool kMasked>
inline uint16x8_t count_chunk(const View& own, const View& other, ptrdiff_t bytes, ptrdiff_t at) {
  constexpr int32_t kVectors = kChunk / 16;
  uint8x16_t descriptor[kVectors], mask[kVectors];
  const uint8_t* own_descriptor = one_address(own.descriptors + at);
  const uint8_t* own_mask = kMasked ? one_address(own.masks + at) : own_descriptor;
  BSM_UNROLL
  for (int32_t v = 0; v < kVectors; ++v) {
    descriptor[v] = vld1q_u8(own_descriptor + 16 * v);
    mask[v] = kMasked ? vld1q_u8(own_mask + 16 * v) : descriptor[v];
  }
  Counts counts;
  BSM_UNROLL
  for (int32_t i = 0; i < kGroup; ++i) {
    const uint8_t* descriptors = one_address(other.descriptors + i * bytes + at);
    const uint8_t* masks = kMasked ? one_address(other.masks + i * bytes + at) : descriptors;
    BSM_UNROLL
    for (int32_t v = 0; v < kVectors; ++v) {
      const uint8x16_t differing = veorq_u8(descriptor[v], vld1q_u8(descriptors + 16 * v));
      const uint8x16_t left = vcntq_u8(kMasked ? vandq_u8(differing, mask[v]) : differing);
      counts.left[i] = v == 0 ? left : vaddq_u8(counts.left[i], left);
      if (!kMasked) continue;
      const uint8x16_t right = vcntq_u8(vandq_u8(differing, vld1q_u8(masks + 16 * v)));
      counts.right[i] = v == 0 ? right : vaddq_u8(counts.right[i], right);
    }
  }
  return add_up<kMasked>(counts);
}

// Bytes begin..end-1 of the descriptors of four candidates, `bytes` apart; at most kChunk.
template <bool kMasked>
inline uint16x8_t count(const View& own, const View& other, ptrdiff_t bytes, ptrdiff_t begin, ptrdiff_t end) {
  if (end - begin == kChunk) return count_chunk<kMasked>(own, other, bytes, begin);
  Counts counts;
  BSM_UNROLL
  for (int32_t i = 0; i < kGroup; ++i) counts.left[i] = counts.right[i] = vdupq_n_u8(0);
  ptrdiff_t at = begin;
  for (; at + 16 <= end; at += 16) add_vector<kMasked>(counts, own, other, bytes, at);
  if (at < end) add_half<kMasked>(counts, own, other, bytes, at);
  return add_up<kMasked>(counts);
}

struct Keys {
  uint32x4_t left, right;
};

inline Keys make_keys(uint16x8_t sums, uint32x4_t levels) {
  return Keys{vorrq_u32(vshll_n_u16(vget_low_u16(sums), kLevelBits), levels),
              vorrq_u32(vshll_n_u16(vget_high_u16(sums), kLevelBits), levels)};
}

// Costs above which no candidate wins, in the lanes of add_up: those of the winners so far; a key may win at its own cost.
inline uint16x8_t limits_of(uint32x4_t left, uint32x4_t right) {
  return vcombine_u16(vshrn_n_u32(left, kLevelBits), vshrn_n_u32(right, kLevelBits));
}

inline uint16_t level_of(uint32_t key) {
  return key == kNone ? kNoLevel : static_cast<uint16_t>((key & ((1u << kLevelBits) - 1)) << kLevelShift);
}

template <bool kMasked>
struct Row {
  const MatchHammingArgs& args;
  ptrdiff_t bytes;
  uint32_t* left_best;  // a key for each pixel
  uint32_t* right_best;

  View left_pixel(int32_t x) const { return View{args.left + x * bytes, kMasked ? args.left_mask + x * bytes : nullptr}; }
  View right_pixel(int32_t x) const { return View{args.right + x * bytes, kMasked ? args.right_mask + x * bytes : nullptr}; }

  // Left pixel x at levels level..level + 3 by the first `end` bytes.
  void match_four(int32_t x, int32_t level, ptrdiff_t end, uint32x4_t& best) const {
    alignas(16) static constexpr uint32_t kDown[4] = {3, 2, 1, 0};
    const int32_t first = x - args.min_disparity - level - (kGroup - 1);
    const View own = left_pixel(x);
    const View other = right_pixel(first);
    const uint32x4_t levels = vaddq_u32(vdupq_n_u32(static_cast<uint32_t>(level)), vld1q_u32(kDown));
    const uint32x4_t right = vld1q_u32(right_best + first);
    const uint32x4_t left = vdupq_n_u32(least32(best));
    const uint16x8_t limits = limits_of(left, right);
    uint16x8_t sums = vdupq_n_u16(0);
    ptrdiff_t at = 0;
    do {
      const ptrdiff_t next = end - at < kChunk ? end : at + kChunk;
      sums = vaddq_u16(sums, count<kMasked>(own, other, bytes, at, next));
      at = next;
    } while (at < end && least16(vcgtq_u16(sums, limits)) == 0);
    const Keys keys = make_keys(sums, levels);
    best = vminq_u32(best, keys.left);
    vst1q_u32(right_best + first, vminq_u32(right, keys.right));
  }

  // One candidate by the first `end` bytes.
  void match_one(int32_t x, int32_t level, ptrdiff_t end) const {
    const int32_t matched = x - args.min_disparity - level;
    const View own = left_pixel(x);
    const View other = right_pixel(matched);
    uint16x8_t left_sums = vdupq_n_u16(0);
    uint16x8_t right_sums = left_sums;
    for (ptrdiff_t at = 0; at < end; at += 16) {
      const auto load = [whole = at + 16 <= end](const uint8_t* from) { return whole ? vld1q_u8(from) : load_half(from); };
      const uint8x16_t differing = veorq_u8(load(own.descriptors + at), load(other.descriptors + at));
      left_sums = vpadalq_u8(left_sums, vcntq_u8(kMasked ? vandq_u8(differing, load(own.masks + at)) : differing));
      if (kMasked) right_sums = vpadalq_u8(right_sums, vcntq_u8(vandq_u8(differing, load(other.masks + at))));
    }
    const uint32_t number = static_cast<uint32_t>(level);
    const uint32_t left = sum16(left_sums) << kLevelBits | number;
    const uint32_t right = sum16(kMasked ? right_sums : left_sums) << kLevelBits | number;
    if (left < left_best[x]) left_best[x] = left;
    if (right < right_best[matched]) right_best[matched] = right;
  }

  // All candidates by the first `end` bytes.
  void match(ptrdiff_t end) const {
    for (int32_t x = 0; x < args.width; ++x) {
      // Candidates are right pixels x - min_disparity - level within the row.
      const int32_t farthest = x - args.min_disparity;
      const int32_t first = farthest < args.width ? 0 : farthest - args.width + 1;
      const int32_t last = farthest < args.num_disparities - 1 ? farthest : args.num_disparities - 1;
      if (last - first < kGroup - 1) {
        for (int32_t level = first; level <= last; ++level) match_one(x, level, end);
        continue;
      }
      uint32x4_t best = vdupq_n_u32(left_best[x]);
      int32_t level = first;
      for (; level + kGroup <= last + 1; level += kGroup) match_four(x, level, end, best);
      // What is left: four that end with the last, some of them for the second time.
      if (level <= last) match_four(x, last - (kGroup - 1), end, best);
      left_best[x] = least32(best);
    }
  }

  // The guessed winners' whole costs.
  void bound() const {
    uint32_t* left_guess = right_best + args.width;
    uint32_t* right_guess = left_guess + args.width;
    for (int32_t x = 0; x < args.width; ++x) {
      left_guess[x] = left_best[x];
      right_guess[x] = right_best[x];
      left_best[x] = right_best[x] = kNone;
    }
    constexpr uint32_t kLevel = (1u << kLevelBits) - 1;
    for (int32_t x = 0; x < args.width; ++x) {
      if (left_guess[x] != kNone) match_one(x, static_cast<int32_t>(left_guess[x] & kLevel), bytes);
      if (right_guess[x] == kNone) continue;
      const int32_t level = static_cast<int32_t>(right_guess[x] & kLevel);
      const int32_t matched = x + args.min_disparity + level;
      if (left_guess[matched] == kNone || (left_guess[matched] & kLevel) != (right_guess[x] & kLevel)) {
        match_one(matched, level, bytes);
      }
    }
  }
};

template <bool kMasked>
void match_row(const MatchHammingArgs& args) {
  uint32_t* best = static_cast<uint32_t*>(args.scratch);
  const Row<kMasked> row{args, args.bits / 8, best, best + args.width};
  for (int32_t x = 0; x < args.width; ++x) row.left_best[x] = row.right_best[x] = kNone;
  if (row.bytes > kLong) {
    row.match(kGuess);
    row.bound();
  }
  row.match(row.bytes);
  for (int32_t x = 0; x < args.width; ++x) {
    args.left_level[x] = level_of(row.left_best[x]);
    args.right_level[x] = level_of(row.right_best[x]);
  }
}

}  // namespace

uint64_t match_hamming_neon_scratch(const KernelShape& shape) {
  return uint64_t{4} * sizeof(uint32_t) * static_cast<uint32_t>(shape.width);
}

void match_hamming_neon(const MatchHammingArgs& args) {
  if (args.left_mask != nullptr) {
    match_row<true>(args);
  } else {
    match_row<false>(args);
  }
}

}  // namespace bsm
#endif
