// match_hamming, SVE: short descriptors as many candidates at once as a vector has 64-bit lanes, long ones one by one.
// A winner is the least of cost and level in one key, so that ties need no order. Long descriptors: their first bytes guess
// each pixel's winner, whose whole cost bounds the others, and counting of a candidate stops once neither view can win.
// Bound, per vector of a candidate and both views: 1 XOR, 2 ANDs, 2 population counts, 2 additions; 4 loads.
#include "platform/compiler.h"

#if BSM_ARCH_SVE
#include "simd/arm/hamming_sve.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr uint32_t kLevelBits = 12;      // of a key, below the cost
constexpr uint32_t kNone = 0xffffffffu;  // no candidate
constexpr int32_t kChunk = 64;           // bytes counted between two looks at the bounds, or a vector
constexpr int32_t kGuess = 64;           // bytes that a guess looks at
constexpr int32_t kLong = 128;           // descriptors of more bytes than this are guessed first

inline uint16_t level_of(uint32_t key) {
  return key == kNone ? kNoLevel : static_cast<uint16_t>((key & ((1u << kLevelBits) - 1)) << kLevelShift);
}

struct Pixel {
  const uint8_t* descriptor;
  const uint8_t* mask;
};

struct Costs {
  uint32_t left, right;
};

// Costs by the first `end` bytes; counting may stop when both are above their limits.
template <bool kMasked>
inline Costs hamming(Pixel left, Pixel right, int32_t end, Costs limits) {
  const svbool_t words = svptrue_b64();
  svuint64_t left_counts = svdup_u64(0);
  svuint64_t right_counts = left_counts;
  for (int32_t at = 0;;) {
    const int32_t stop = end - at < kChunk ? end : at + kChunk;
    for (; at < stop; at += lanes8()) {
      const svbool_t those = svwhilelt_b8(at, end);
      const svuint8_t differing = sveor_z(those, svld1(those, left.descriptor + at), svld1(those, right.descriptor + at));
      if (kMasked) {
        const svuint8_t left_bits = svand_x(svptrue_b8(), differing, svld1(those, left.mask + at));
        const svuint8_t right_bits = svand_x(svptrue_b8(), differing, svld1(those, right.mask + at));
        left_counts = svadd_x(words, left_counts, count_words(left_bits));
        right_counts = svadd_x(words, right_counts, count_words(right_bits));
      } else {
        left_counts = svadd_x(words, left_counts, count_words(differing));
      }
    }
    const uint32_t l = static_cast<uint32_t>(svaddv(words, left_counts));
    const uint32_t r = kMasked ? static_cast<uint32_t>(svaddv(words, right_counts)) : l;
    if (at >= end || (l > limits.left && r > limits.right)) return Costs{l, r};
  }
}

template <bool kMasked>
struct Row {
  const MatchHammingArgs& args;
  int32_t bytes;
  uint32_t* left_best;  // a key for each pixel
  uint32_t* right_best;

  Pixel left_pixel(int32_t x) const {
    const ptrdiff_t at = ptrdiff_t{x} * bytes;
    return Pixel{args.left + at, kMasked ? args.left_mask + at : nullptr};
  }
  Pixel right_pixel(int32_t x) const {
    const ptrdiff_t at = ptrdiff_t{x} * bytes;
    return Pixel{args.right + at, kMasked ? args.right_mask + at : nullptr};
  }

  // Right pixels begin..end-1 are the candidates of left pixel x, the last of them at the lowest level.
  struct Candidates {
    int32_t begin, end;
  };
  Candidates candidates(int32_t x) const {
    const int32_t farthest = x - args.min_disparity;
    const int32_t begin = farthest - args.num_disparities + 1;
    return Candidates{begin < 0 ? 0 : begin, farthest < args.width ? farthest + 1 : args.width};
  }

  void match_one(int32_t x, int32_t matched, int32_t end) const {
    const uint32_t level = static_cast<uint32_t>(x - args.min_disparity - matched);
    const Costs limits{left_best[x] >> kLevelBits, right_best[matched] >> kLevelBits};
    const Costs costs = hamming<kMasked>(left_pixel(x), right_pixel(matched), end, limits);
    const uint32_t left = costs.left << kLevelBits | level;
    const uint32_t right = costs.right << kLevelBits | level;
    if (left < left_best[x]) left_best[x] = left;
    if (right < right_best[matched]) right_best[matched] = right;
  }

  // All candidates by the first `end` bytes.
  void match(int32_t end) const {
    for (int32_t x = 0; x < args.width; ++x) {
      const Candidates those = candidates(x);
      for (int32_t matched = those.begin; matched < those.end; ++matched) match_one(x, matched, end);
    }
  }

  // The guessed winners' whole costs.
  void bound() const {
    constexpr uint32_t kLevel = (1u << kLevelBits) - 1;
    uint32_t* left_guess = right_best + args.width;
    uint32_t* right_guess = left_guess + args.width;
    for (int32_t x = 0; x < args.width; ++x) {
      left_guess[x] = left_best[x];
      right_guess[x] = right_best[x];
      left_best[x] = right_best[x] = kNone;
    }
    for (int32_t x = 0; x < args.width; ++x) {
      if (left_guess[x] != kNone) {
        match_one(x, x - args.min_disparity - static_cast<int32_t>(left_guess[x] & kLevel), bytes);
      }
      if (right_guess[x] != kNone) {
        match_one(x + args.min_disparity + static_cast<int32_t>(right_guess[x] & kLevel), x, bytes);
      }
    }
  }

  // All candidates of short descriptors, of 1 << kWords words.
  template <Fit kFit, int32_t kWords>
  void match_short() const {
    constexpr int32_t kBytes = 8 << kWords;
    const int32_t lanes = static_cast<int32_t>(svcntd());
    for (int32_t x = 0; x < args.width; ++x) {
      const Candidates those = candidates(x);
      const Pixel own = left_pixel(x);
      svuint64_t best = svdup_u64(kNone);
      for (int32_t first = those.begin; first < those.end; first += lanes) {
        const svbool_t valid = svwhilelt_b64(first, those.end);
        const Pixel other = right_pixel(first);
        const int32_t end = (those.end - first) * kBytes;
        const auto differing_at = [&](ptrdiff_t at, svbool_t inside) {
          return sveor_z(inside, load_own<kFit, kBytes>(own.descriptor, at), svld1(inside, other.descriptor + at));
        };
        const svuint64_t left = sum_words<kWords>(
            [&](ptrdiff_t at) {
              const svbool_t inside = svwhilelt_b8(static_cast<int32_t>(at), end);
              const svuint8_t differing = differing_at(at, inside);
              if (!kMasked) return count_words(differing);
              return count_words(svand_x(svptrue_b8(), differing, load_own<kFit, kBytes>(own.mask, at)));
            },
            0);
        svuint64_t right = left;
        if (kMasked) {
          right = sum_words<kWords>(
              [&](ptrdiff_t at) {
                const svbool_t inside = svwhilelt_b8(static_cast<int32_t>(at), end);
                return count_words(svand_z(inside, differing_at(at, inside), svld1(inside, other.mask + at)));
              },
              0);
        }
        const svuint64_t levels = svindex_u64(static_cast<uint64_t>(x - args.min_disparity - first), ~uint64_t{0});
        const svuint64_t left_key = svorr_x(valid, svlsl_x(valid, left, kLevelBits), levels);
        const svuint64_t right_key = svorr_x(valid, svlsl_x(valid, right, kLevelBits), levels);
        best = svmin_m(valid, best, left_key);
        svst1w(valid, right_best + first, svmin_x(valid, svld1uw_u64(valid, right_best + first), right_key));
      }
      left_best[x] = static_cast<uint32_t>(svminv(svptrue_b64(), best));
    }
  }

  template <int32_t kWords>
  void match_words() const {
    switch (fit_of(8 << kWords)) {
      case Fit::kSeveral:
        return match_short<Fit::kSeveral, kWords>();
      case Fit::kParts:
        return match_short<Fit::kParts, kWords>();
      default:
        return match(bytes);
    }
  }

  void match_all() const {
    if (bytes > kLong) {
      match(kGuess);
      bound();
    }
    switch (bytes / 8) {
      case 1:
        return match_words<0>();
      case 2:
        return match_words<1>();
      case 4:
        return match_words<2>();
      case 8:
        return match_words<3>();
      default:
        return match(bytes);
    }
  }
};

template <bool kMasked>
void match_row(const MatchHammingArgs& args) {
  uint32_t* best = static_cast<uint32_t*>(args.scratch);
  const Row<kMasked> row{args, args.bits / 8, best, best + args.width};
  for (int32_t x = 0; x < args.width; ++x) row.left_best[x] = row.right_best[x] = kNone;
  row.match_all();
  for (int32_t x = 0; x < args.width; ++x) {
    args.left_level[x] = level_of(row.left_best[x]);
    args.right_level[x] = level_of(row.right_best[x]);
  }
}

}  // namespace

uint64_t match_hamming_sve_scratch(const KernelShape& shape) {
  return uint64_t{4} * sizeof(uint32_t) * static_cast<uint32_t>(shape.width);
}

void match_hamming_sve(const MatchHammingArgs& args) {
  if (args.left_mask != nullptr) {
    match_row<true>(args);
  } else {
    match_row<false>(args);
  }
}

}  // namespace bsm
#endif
