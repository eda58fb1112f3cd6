// winner_sums, AVX-512 BW: the minimum of 32 levels a register, fractions for 16 pixels at once.
// Bound, per pixel of 64 levels: 2 loads, 15 operations for the minimum and its place, 2 loads of the neighbours.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include <immintrin.h>

#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 32;         // levels of a register
constexpr int32_t kPixelsAtOnce = 16;  // that get their fractions together

inline __m512i set(int32_t value) {
  return _mm512_set1_epi32(value);
}

// The least lane, in the first one.
inline __m128i least_lane(__m512i a) {
  const __m256i b = _mm256_min_epu16(_mm512_castsi512_si256(a), _mm512_extracti64x4_epi64(a, 1));
  return _mm_minpos_epu16(_mm_min_epu16(_mm256_castsi256_si128(b), _mm256_extracti128_si256(b, 1)));
}

// Winners of some pixels with the sums that their fractions need.
struct Winners {
  alignas(64) int32_t level[kPixelsAtOnce];
  alignas(64) int32_t below[kPixelsAtOnce];
  alignas(64) int32_t at[kPixelsAtOnce];  // in the lower halves; the upper ones hold anything
  alignas(64) int32_t above[kPixelsAtOnce];
};

// The levels of one pixel, kRegisters * 32 at most; 0: any number.
template <int32_t kRegisters>
struct Finder {
  int32_t num_disparities;
  int32_t registers;
  __mmask32 last;

  explicit Finder(int32_t count)
      : num_disparities(count),
        registers(kRegisters != 0 ? kRegisters : (count + kLanes - 1) / kLanes),
        last(static_cast<__mmask32>(~uint32_t{0} >> (registers * kLanes - count))) {}

  __m512i load(const uint16_t* sums, int32_t i) const {
    const __m512i none = _mm512_set1_epi32(-1);
    return _mm512_mask_loadu_epi16(none, i + 1 < registers ? ~__mmask32{0} : last, sums + ptrdiff_t{i} * kLanes);
  }

  void find(const uint16_t* sums, int32_t pixel, Winners* winners) const {
    __m512i least = load(sums, 0);
    BSM_UNROLL
    for (int32_t i = 1; i < registers; ++i) least = _mm512_min_epu16(least, load(sums, i));
    const __m128i smallest = least_lane(least);
    const __m512i wanted = _mm512_broadcastw_epi16(smallest);
    int32_t level = num_disparities;
    if constexpr (kRegisters == 1 || kRegisters == 2) {
      const __mmask64 low = _mm512_cmpeq_epi16_mask(load(sums, 0), wanted);
      const __mmask64 high = kRegisters == 2 ? _mm512_cmpeq_epi16_mask(load(sums, 1), wanted) : 0;
      const uint64_t places = _mm512_kunpackd(high, low);
      level = __builtin_ctzll(places);
    } else {
      for (int32_t i = 0; level == num_disparities; ++i) {
        const uint32_t places = _mm512_cmpeq_epi16_mask(load(sums, i), wanted);
        if (places != 0) level = i * kLanes + __builtin_ctz(places);
      }
    }
    winners->level[pixel] = level;
    _mm_storeu_si32(winners->at + pixel, smallest);
    winners->below[pixel] = sums[level == 0 ? 0 : level - 1];
    winners->above[pixel] = sums[level + 1 == num_disparities ? level : level + 1];
  }
};

// Equiangular fits in sixteenths: floor(8 (a - b) / larger + 1/2), at most 7; larger is not 0 in the lanes that count.
inline __m512i fractions(__m512i a, __m512i b) {
  const __m512i larger = _mm512_max_epu32(a, b);
  // The numerator 16 (a - b) + 17 larger is never negative and the quotient by 2 larger at most 16: five steps by hand.
  __m512i rest = _mm512_slli_epi32(_mm512_sub_epi32(a, b), 4);
  rest = _mm512_add_epi32(rest, _mm512_add_epi32(_mm512_slli_epi32(larger, 4), larger));
  __m512i quotient = _mm512_setzero_si512();
  BSM_UNROLL
  for (int32_t bit = 16; bit != 0; bit >>= 1) {
    const __m512i part = _mm512_mullo_epi32(larger, set(2 * bit));
    const __mmask16 fits = _mm512_cmpge_epu32_mask(rest, part);
    rest = _mm512_mask_sub_epi32(rest, fits, rest, part);
    quotient = _mm512_mask_add_epi32(quotient, fits, quotient, set(bit));
  }
  return _mm512_min_epi32(_mm512_sub_epi32(quotient, set(8)), set(7));
}

inline __m256i levels_of(const Winners& winners, int32_t num_disparities, bool subpixel) {
  const __m512i none = set(kNoCost);
  const __m512i level = _mm512_load_si512(winners.level);
  const __m512i below = _mm512_load_si512(winners.below);
  const __m512i at = _mm512_and_si512(_mm512_load_si512(winners.at), none);
  const __m512i above = _mm512_load_si512(winners.above);
  __m512i sixteenths = _mm512_slli_epi32(level, kLevelShift);
  if (subpixel) {
    const __mmask16 inside =
        _mm512_cmpgt_epi32_mask(level, set(0)) & _mm512_cmplt_epi32_mask(level, set(num_disparities - 1));
    const __mmask16 known = _mm512_cmpneq_epi32_mask(below, none) & _mm512_cmpneq_epi32_mask(above, none);
    const __m512i a = _mm512_sub_epi32(below, at);
    const __m512i b = _mm512_sub_epi32(above, at);
    const __mmask16 sloped = _mm512_test_epi32_mask(_mm512_or_si512(a, b), set(-1));
    sixteenths = _mm512_mask_add_epi32(sixteenths, inside & known & sloped, sixteenths, fractions(a, b));
  }
  sixteenths = _mm512_mask_mov_epi32(sixteenths, _mm512_cmpeq_epi32_mask(at, none), set(kNoLevel));
  return _mm512_cvtepi32_epi16(sixteenths);
}

template <int32_t kRegisters>
void find_row(const WinnerSumsArgs& args) {
  const Finder<kRegisters> finder(args.num_disparities);
  Winners winners;
  for (int32_t x = 0; x < args.width; x += kPixelsAtOnce) {
    const int32_t pixels = args.width - x < kPixelsAtOnce ? args.width - x : kPixelsAtOnce;
    for (int32_t i = 0; i < pixels; ++i) finder.find(args.sum + ptrdiff_t{x + i} * args.stride, i, &winners);
    for (int32_t i = pixels; i < kPixelsAtOnce; ++i)
      winners.level[i] = winners.below[i] = winners.at[i] = winners.above[i] = 0;
    const __mmask16 kept = static_cast<__mmask16>((1u << pixels) - 1);
    _mm256_mask_storeu_epi16(args.level + x, kept, levels_of(winners, args.num_disparities, args.subpixel != 0));
  }
}

}  // namespace

uint64_t winner_sums_avx512_scratch(const KernelShape&) {
  return 0;
}

void winner_sums_avx512(const WinnerSumsArgs& args) {
  switch ((args.num_disparities + kLanes - 1) / kLanes) {
    case 1:
      return find_row<1>(args);
    case 2:
      return find_row<2>(args);
    default:
      return find_row<0>(args);
  }
}

}  // namespace bsm
#endif
