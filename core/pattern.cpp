// Makes the pair table: a fixed generator and an integer inverse Gaussian, evaluated by the compiler.
#include "core/pattern.h"

#include "bsm/bsm.h"
#include "simd/build.h"

#ifndef BSM_PATTERN_SEED
#define BSM_PATTERN_SEED 1
#endif

namespace bsm {
namespace {

// P(|X| < k + 1 given |X| < 13) in 2^-16 for X normal with sigma 4, k = 0..12.
constexpr uint32_t kSigma4[kMaxPatternRadius + 1] = {12953, 25124, 35873, 44792, 51748, 56845, 60355,
                                                     62626, 64008, 64797, 65221, 65435, 65536};

// P(|X| < k + 1 given |X| < 9) in 2^-16 for sigma 2.5, k = 0..8.
constexpr int32_t kSgmRadius = 8;
constexpr uint32_t kSigma2_5[kSgmRadius + 1] = {20378, 37780, 50470, 58372, 62574, 64482, 65222, 65467, 65536};

// Random numbers as a mixed counter: each step of the mix is a bijection of 32-bit words.
// Distribution[k] = P(|X| < k + 1) in 2^-16.
struct Generator {
  uint32_t counter;
  const uint32_t* distribution;

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
    while (uniform >= distribution[magnitude]) ++magnitude;
    return static_cast<int8_t>((random & 0x8000u) != 0 ? -magnitude : magnitude);
  }
};

template <int32_t kPairs>
struct PairTable {
  PixelPair pairs[kPairs];
};

template <int32_t kPairs>
constexpr PairTable<kPairs> make_pair_table(const uint32_t* distribution, uint32_t seed) {
  PairTable<kPairs> table{};
  Generator generator{seed << 16, distribution};
  for (PixelPair& pair : table.pairs) {
    do {
      pair.px = generator.offset();
      pair.py = generator.offset();
      pair.qx = generator.offset();
      pair.qy = generator.offset();
    } while (pair.px == pair.qx && pair.py == pair.qy);
  }
  return table;
}

constexpr auto kLocalPairs = make_pair_table<kMostLocalBits>(kSigma4, BSM_PATTERN_SEED);
constexpr auto kSgmPairs = make_pair_table<kMostSgmBits>(kSigma2_5, BSM_PATTERN_SEED);

}  // namespace

Pattern local_pattern(int32_t bits) {
  return Pattern{kLocalPairs.pairs, bits, kMaxPatternRadius};
}

Pattern sgm_pattern(int32_t bits) {
  return Pattern{kSgmPairs.pairs, bits, kSgmRadius};
}

}  // namespace bsm
