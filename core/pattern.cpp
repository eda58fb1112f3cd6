// Makes the pairs: a fixed generator and an integer inverse Gaussian, evaluated by the compiler or when a context opens.
#include "core/pattern.h"

#include "bsm/bsm.h"

#ifndef BSM_PATTERN_SEED
#define BSM_PATTERN_SEED 1
#endif

namespace bsm {
namespace {

// P(|X| < k + 1 given |X| < 13) in 2^-16 for X normal with sigma 4, k = 0..11; all 16-bit numbers lie below k = 12.
constexpr uint16_t kSigma4[kLocalRadius] = {12953, 25124, 35873, 44792, 51748, 56845,
                                            60355, 62626, 64008, 64797, 65221, 65435};

// P(|X| < k + 1 given |X| < 11) in 2^-16 for sigma 3, k = 0..9.
constexpr uint16_t kSigma3[kNarrowRadius] = {17117, 32449, 44752, 53594, 59287, 62569, 64265, 65050, 65375, 65496};

// P(|X| < k + 1 given |X| < 9) in 2^-16 for sigma 2.5, k = 0..7.
constexpr uint16_t kSigma2_5[kSgmRadius] = {20378, 37780, 50470, 58372, 62574, 64482, 65222, 65467};

// Random offsets, from a mixed counter: each step of the mix is a bijection of 32-bit words.
struct Generator {
  uint32_t counter;
  const uint16_t* distribution;  // [k] = P(|X| < k + 1) in 2^-16, k below radius
  int32_t radius;

  constexpr uint32_t next() {
    uint32_t word = counter++;
    word = (word ^ (word >> 16)) * 0x7feb352du;
    word = (word ^ (word >> 15)) * 0x846ca68bu;
    return word ^ (word >> 16);
  }

  // One coordinate: the magnitude by inverting the distribution, then a sign.
  constexpr int8_t offset() {
    const uint32_t random = next();
    const uint32_t uniform = random >> 16;
    int32_t magnitude = 0;
    while (magnitude < radius && uniform >= distribution[magnitude]) ++magnitude;
    return static_cast<int8_t>((random & 0x8000u) != 0 ? -magnitude : magnitude);
  }
};

constexpr void make_pairs(const uint16_t* distribution, int32_t radius, int32_t bits, PixelPair* pairs) {
  Generator generator{uint32_t{BSM_PATTERN_SEED} << 16, distribution, radius};
  for (PixelPair* pair = pairs; pair != pairs + bits; ++pair) {
    do {
      pair->px = generator.offset();
      pair->py = generator.offset();
      pair->qx = generator.offset();
      pair->qy = generator.offset();
    } while (pair->px == pair->qx && pair->py == pair->qy);
  }
}

template <int32_t kPairs>
struct PairTable {
  PixelPair pairs[kPairs];
};

template <int32_t kPairs>
constexpr PairTable<kPairs> make_table(const uint16_t* distribution, int32_t radius) {
  PairTable<kPairs> table{};
  make_pairs(distribution, radius, kPairs, table.pairs);
  return table;
}

template <const uint16_t* kDistribution, int32_t kRadius, int32_t kMostBits>
Pattern pattern(int32_t bits, PixelPair* pairs) {
  if constexpr (kHasPatternTables) {
    static constexpr PairTable<kMostBits> kTable = make_table<kMostBits>(kDistribution, kRadius);
    return Pattern{kTable.pairs, bits, kRadius, nullptr};
  } else {
    make_pairs(kDistribution, kRadius, bits, pairs);
    return Pattern{pairs, bits, kRadius, nullptr};
  }
}

}  // namespace

Pattern local_pattern(int32_t bits, PixelPair* pairs) {
  return pattern<kSigma4, kLocalRadius, BSM_MAX_BITS>(bits, pairs);
}

Pattern narrow_pattern(int32_t bits, PixelPair* pairs) {
  return pattern<kSigma3, kNarrowRadius, BSM_MAX_BITS>(bits, pairs);
}

Pattern sgm_pattern(int32_t bits, PixelPair* pairs) {
  return pattern<kSigma2_5, kSgmRadius, BSM_MAX_SGM_BITS>(bits, pairs);
}

}  // namespace bsm
