// What the two ways of vote_weigh on AVX-512 share: the tables of a row's call, weights of exponents, the winner.
#ifndef BSM_SIMD_X86_VOTE_WINDOW_AVX512_H
#define BSM_SIMD_X86_VOTE_WINDOW_AVX512_H

#include <immintrin.h>

#include "platform/compiler.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kLanes = 32;
constexpr int32_t kTableEntries = 128;  // bytes of weights in a pair of registers
constexpr int32_t kMaxTables = 8;
constexpr int32_t kColumns = 64;          // that a group looks at
constexpr int32_t kGroup = 4;             // pixels in a group
constexpr int32_t kMaxGroupRadius = 31;   // a pixel's window fits the columns
constexpr int32_t kMaxGroupLevels = 256;  // more levels than that go without groups, for the memory of their sums

struct alignas(64) Scratch {
  // Exponents by |dy| and tap, the first tap at kColumns - radius; no weight outside the window.
  uint16_t distance[BSM_MAX_VOTE_RADIUS + 1][2 * kColumns + kLanes];
  uint8_t weights[2][kMaxTables * kTableEntries];  // lower bytes, upper bytes
  uint16_t weight[kLanes];
  uint16_t level[kLanes];
  uint16_t row_levels[kColumns];
};

// Sums of a window, of even and odd taps or of a group.
uint64_t votes_bytes(int32_t num_disparities) {
  const uint64_t levels = (static_cast<uint64_t>(num_disparities) + 15) / 16 * 16;
  return sizeof(uint32_t) * levels * (num_disparities <= kMaxGroupLevels ? 16 * kGroup : 2);
}

// What stays the same for all pixels of a row.
struct Window {
  const VoteWeighArgs& args;
  Scratch& scratch;
  uint32_t* votes;    // even taps, then odd taps
  int32_t levels;     // num_disparities rounded up to whole registers
  int32_t taps;       // of a row
  int32_t at_once;    // taps whose pixels lie within 64
  int32_t tables[2];  // of lower and of upper bytes that are not all 0
};

void prepare(Window& window) {
  const VoteWeighArgs& args = window.args;
  Scratch& scratch = window.scratch;
  for (int32_t dy = 0; dy <= args.radius; dy += args.step) {
    const uint16_t* steps = args.distance_steps + ptrdiff_t{dy} * (args.radius + 1);
    BSM_MEMSET(scratch.distance[dy], 0xff, sizeof scratch.distance[dy]);
    for (int32_t tap = 0; tap < window.taps; ++tap) {
      const int32_t dx = tap * args.step - args.radius;
      scratch.distance[dy][kColumns - args.radius + tap] = steps[dx < 0 ? -dx : dx];
    }
  }
  BSM_MEMSET(scratch.weights, 0, sizeof scratch.weights);
  for (int32_t i = 0; i < args.weights_count; ++i) {
    for (int32_t half = 0; half < 2; ++half) {
      const uint8_t byte = static_cast<uint8_t>(args.weights[i] >> 8 * half);
      scratch.weights[half][i] = byte;
      if (byte != 0) window.tables[half] = i / kTableEntries + 1;
    }
  }
}

// Bits of the elements 0..count-1 that lie within begin..end-1.
inline uint64_t range(int32_t begin, int32_t end, int32_t count) {
  begin = begin < 0 ? 0 : begin;
  end = end > count ? count : end;
  if (begin >= end) return 0;
  return (~uint64_t{0} >> (64 - (end - begin))) << begin;
}

// Byte `half` of the weights of 64 exponents, given by their table and their place in it.
inline __m512i weigh_half(const Window& window, int32_t half, __m512i table, __m512i place) {
  __m512i weight = _mm512_setzero_si512();
  const uint8_t* weights = window.scratch.weights[half];
  for (int32_t i = 0; i < window.tables[half]; ++i, weights += kTableEntries) {
    const __mmask64 here = _mm512_cmpeq_epi8_mask(table, _mm512_set1_epi8(static_cast<char>(i)));
    const __m512i low = _mm512_load_si512(weights);
    const __m512i high = _mm512_load_si512(weights + kTableEntries / 2);
    weight = _mm512_or_si512(weight, _mm512_maskz_permutex2var_epi8(here, low, place, high));
  }
  return weight;
}

// Weights of 64 exponents; 0 from weights_count on.
inline void weigh(const Window& window, __m512i low, __m512i high, __m512i out[2]) {
  const __m512i last = _mm512_set1_epi16(kMaxTables * kTableEntries);
  low = _mm512_min_epu16(low, last);
  high = _mm512_min_epu16(high, last);
  const __m512i place = _mm512_inserti64x4(_mm512_castsi256_si512(_mm512_cvtepi16_epi8(low)), _mm512_cvtepi16_epi8(high), 1);
  const __m256i low_table = _mm512_cvtepi16_epi8(_mm512_srli_epi16(low, 7));
  const __m256i high_table = _mm512_cvtepi16_epi8(_mm512_srli_epi16(high, 7));
  const __m512i table = _mm512_inserti64x4(_mm512_castsi256_si512(low_table), high_table, 1);
  const __m512i lower = weigh_half(window, 0, table, place);
  const __m512i upper = weigh_half(window, 1, table, place);
  const auto widen = [](__m256i a, __m256i b) {
    return _mm512_or_si512(_mm512_cvtepu8_epi16(a), _mm512_slli_epi16(_mm512_cvtepu8_epi16(b), 8));
  };
  out[0] = widen(_mm512_castsi512_si256(lower), _mm512_castsi512_si256(upper));
  out[1] = widen(_mm512_extracti64x4_epi64(lower, 1), _mm512_extracti64x4_epi64(upper, 1));
}

// (sad * scale + 512) >> 10 of a 32-bit product in two halves.
inline __m512i color_exponent(__m512i sad, uint32_t color_scale) {
  const __m512i scale = _mm512_set1_epi16(static_cast<int16_t>(color_scale));
  const __m512i high = _mm512_slli_epi16(_mm512_mulhi_epu16(sad, scale), 6);
  const __m512i low = _mm512_avg_epu16(_mm512_srli_epi16(_mm512_mullo_epi16(sad, scale), 9), _mm512_setzero_si512());
  return _mm512_add_epi16(high, low);
}

// The level below `end` with the most votes, in 1/16 pixel.
uint16_t winning_level(const uint32_t* votes, int32_t end) {
  __m512i most = _mm512_setzero_si512();
  for (int32_t i = 0; i < end; i += 16) {
    const __mmask16 kept = static_cast<__mmask16>(range(0, end - i, 16));
    most = _mm512_max_epu32(most, _mm512_maskz_loadu_epi32(kept, votes + i));
  }
  const uint32_t wanted = _mm512_reduce_max_epu32(most);
  if (wanted == 0) return kNoLevel;
  const __m512i value = _mm512_set1_epi32(static_cast<int32_t>(wanted));
  int32_t i = 0;
  uint32_t found = 0;
  while ((found = _mm512_cmpeq_epi32_mask(_mm512_load_si512(votes + i), value)) == 0) i += 16;
  return static_cast<uint16_t>((i + __builtin_ctz(found)) << kLevelShift);
}

uint16_t vote_of(const VoteWeighArgs& args, const uint32_t* votes, int32_t x) {
  const bool capped = args.cap != nullptr && args.cap[x] < args.num_disparities - 1;
  const uint16_t level = winning_level(votes, capped ? args.cap[x] + 1 : args.num_disparities);
  return capped && level == kNoLevel ? winning_level(votes, args.num_disparities) : level;
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_VOTE_WINDOW_AVX512_H
