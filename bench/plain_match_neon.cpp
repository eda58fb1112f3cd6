// The plain forms of match_hamming_neon, made of the kernel's own parts.
#include "bench/plain_forms.h"
#include "platform/compiler.h"

#if BSM_ARCH_NEON
// The kernel once more, under a name of its own.
#define match_hamming_neon match_hamming_neon_again
#define match_hamming_neon_scratch match_hamming_neon_again_scratch
#include "simd/arm/match_hamming_neon.cpp"

namespace bsm::bench {
namespace {

struct WholeRow : Row<true> {
  // Row::match_four, whatever the limits.
  void match_four(int32_t x, int32_t level, uint32x4_t& best) const {
    alignas(16) static constexpr uint32_t kDown[4] = {3, 2, 1, 0};
    const int32_t first = x - args.min_disparity - level - (kGroup - 1);
    const View own = left_pixel(x);
    const View other = right_pixel(first);
    const uint32x4_t levels = vaddq_u32(vdupq_n_u32(static_cast<uint32_t>(level)), vld1q_u32(kDown));
    uint16x8_t sums = vdupq_n_u16(0);
    for (ptrdiff_t at = 0; at < bytes; at += kChunk) {
      sums = vaddq_u16(sums, count<true>(own, other, bytes, at, bytes - at < kChunk ? bytes : at + kChunk));
    }
    const Keys keys = make_keys(sums, levels);
    best = vminq_u32(best, keys.left);
    vst1q_u32(right_best + first, vminq_u32(vld1q_u32(right_best + first), keys.right));
  }

  // Row::match of all bytes.
  void match_whole() const {
    for (int32_t x = 0; x < args.width; ++x) {
      const int32_t farthest = x - args.min_disparity;
      const int32_t first = farthest < args.width ? 0 : farthest - args.width + 1;
      const int32_t last = farthest < args.num_disparities - 1 ? farthest : args.num_disparities - 1;
      if (last - first < kGroup - 1) {
        for (int32_t level = first; level <= last; ++level) match_one(x, level, bytes);
        continue;
      }
      uint32x4_t best = vdupq_n_u32(left_best[x]);
      int32_t level = first;
      for (; level + kGroup <= last + 1; level += kGroup) match_four(x, level, best);
      if (level <= last) match_four(x, last - (kGroup - 1), best);
      left_best[x] = least32(best);
    }
  }
};

template <class Match>
void match_masked_row(const MatchHammingArgs& args, const Match& match) {
  uint32_t* best = static_cast<uint32_t*>(args.scratch);
  const WholeRow row{{args, args.bits / 8, best, best + args.width}};
  for (int32_t x = 0; x < args.width; ++x) row.left_best[x] = row.right_best[x] = kNone;
  match(row);
  for (int32_t x = 0; x < args.width; ++x) {
    args.left_level[x] = level_of(row.left_best[x]);
    args.right_level[x] = level_of(row.right_best[x]);
  }
}

}  // namespace

void match_all_bits_neon(const MatchHammingArgs& args) {
  match_masked_row(args, [](const WholeRow& row) { row.match_whole(); });
}

void match_without_guess_neon(const MatchHammingArgs& args) {
  match_masked_row(args, [](const WholeRow& row) { row.match(row.bytes); });
}

}  // namespace bsm::bench
#endif
