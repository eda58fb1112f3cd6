// Votes of full windows on AVX-512: up to four close pixels look at the same 64 columns of a row.
// Neighbours mostly hold the same level, so the levels of a row are taken as runs: the weights of a run are added lane by
// lane to sixteen partial sums of its level, which are added up once a window. Bound: about 60 instructions for the weights
// of a row's columns, 4 for each run of up to 16 pixels.
#ifndef BSM_SIMD_X86_VOTE_GROUP_AVX512_H
#define BSM_SIMD_X86_VOTE_GROUP_AVX512_H

#include "simd/x86/vote_window_avx512.h"

namespace bsm {
namespace {

// Pixels of a row without a level, close to each other: lanes of 64 columns from `begin` on.
struct Group {
  int32_t begin;
  int32_t count;
  int32_t x[kGroup];
};

// Weights that the 64 columns of row dy have for pixel x.
template <int32_t kPlanes>
inline void weigh_columns(const Window& window, const uint8_t* lab, uint64_t inside, int32_t dy, int32_t x, int32_t begin,
                          __m512i out[2]) {
  const VoteWeighArgs& args = window.args;
  const uint8_t* center = args.lab[args.radius] + x;
  __m512i low = _mm512_setzero_si512();
  __m512i high = _mm512_setzero_si512();
  BSM_UNROLL
  for (int32_t plane = 0; plane < kPlanes; ++plane) {
    const ptrdiff_t offset = plane * args.plane_stride;
    const __m512i color = _mm512_maskz_loadu_epi8(inside, lab + offset);
    const __m512i own = _mm512_set1_epi8(static_cast<char>(center[offset]));
    const __m512i distance = _mm512_sub_epi8(_mm512_max_epu8(color, own), _mm512_min_epu8(color, own));
    low = _mm512_add_epi16(low, _mm512_cvtepu8_epi16(_mm512_castsi512_si256(distance)));
    high = _mm512_add_epi16(high, _mm512_cvtepu8_epi16(_mm512_extracti64x4_epi64(distance, 1)));
  }
  const uint16_t* distances = window.scratch.distance[dy < 0 ? -dy : dy] + kColumns - (x - begin);
  low = _mm512_adds_epu16(color_exponent(low, args.color_scale), _mm512_loadu_si512(distances));
  high = _mm512_adds_epu16(color_exponent(high, args.color_scale), _mm512_loadu_si512(distances + kLanes));
  weigh(window, low, high, out);
}

// Adds row dy to the sixteen partial sums of each pixel and level of a group.
template <int32_t kPlanes>
void add_row(const Window& window, const Group& group, int32_t dy) {
  const VoteWeighArgs& args = window.args;
  Scratch& scratch = window.scratch;
  const int32_t first = -group.begin;
  const int32_t last = args.width - group.begin;
  const uint16_t* row = args.levels[dy + args.radius] + group.begin;
  const uint64_t inside = range(first, last, kColumns);
  const __m512i missing = _mm512_set1_epi16(static_cast<int16_t>(kOccluded));
  // Whole levels, all ones where there is none.
  __m512i level[2];
  uint64_t valid = 0;
  for (int32_t i = 0; i < 2; ++i) {
    const __m512i value = _mm512_mask_loadu_epi16(missing, static_cast<__mmask32>(inside >> 32 * i), row + kLanes * i);
    const __mmask32 has = _mm512_cmplt_epu16_mask(value, missing);
    const __m512i whole = _mm512_srli_epi16(_mm512_add_epi16(value, _mm512_set1_epi16(8)), kLevelShift);
    level[i] = _mm512_mask_mov_epi16(_mm512_set1_epi16(-1), has, whole);
    valid |= static_cast<uint64_t>(has) << 32 * i;
    _mm512_store_si512(scratch.row_levels + kLanes * i, level[i]);
  }
  if (valid == 0) return;
  const uint8_t* lab = args.lab[dy + args.radius] + group.begin;
  __m512i weights[kGroup][2];
  BSM_UNROLL
  for (int32_t i = 0; i < kGroup; ++i) {
    weights[i][0] = weights[i][1] = _mm512_setzero_si512();
    if (i < group.count) weigh_columns<kPlanes>(window, lab, inside, dy, group.x[i], group.begin, weights[i]);
  }
  // A run begins where the level differs from the one before.
  const __m512i one_up = _mm512_setr_epi64(0x0002000100000000, 0x0006000500040003, 0x000a000900080007, 0x000e000d000c000b,
                                           0x001200110010000f, 0x0016001500140013, 0x001a001900180017, 0x001e001d001c001b);
  const __m512i before_low = _mm512_permutexvar_epi16(one_up, level[0]);
  const __m512i carried = _mm512_permutexvar_epi16(_mm512_set1_epi16(31), level[0]);
  const __m512i before_high = _mm512_mask_mov_epi16(_mm512_permutexvar_epi16(one_up, level[1]), 1, carried);
  const uint64_t low = _mm512_cmpneq_epi16_mask(level[0], before_low);
  const uint64_t high = _mm512_cmpneq_epi16_mask(level[1], before_high);
  const uint64_t begins = low | high << 32 | 1;
  const ptrdiff_t sums_of_pixel = ptrdiff_t{window.levels} * 16;
  const __m256i first_columns = _mm256_setr_epi16(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  for (uint64_t runs = begins & valid; runs != 0; runs &= runs - 1) {
    const int32_t begin = __builtin_ctzll(runs);
    const uint64_t later = begins & ~(~uint64_t{0} >> (63 - begin));
    const int32_t end = later == 0 ? kColumns : __builtin_ctzll(later);
    uint32_t* sums = window.votes + ptrdiff_t{scratch.row_levels[begin]} * 16;
    for (int32_t at = begin; at < end; at += 16) {
      const __mmask16 kept = static_cast<__mmask16>(range(0, end - at, 16));
      const __m512i from =
          _mm512_add_epi16(_mm512_castsi256_si512(first_columns), _mm512_set1_epi16(static_cast<int16_t>(at)));
      BSM_UNROLL
      for (int32_t i = 0; i < kGroup; ++i) {
        if (i >= group.count) break;
        const __m512i moved = _mm512_permutex2var_epi16(weights[i][0], from, weights[i][1]);
        uint32_t* to = sums + i * sums_of_pixel;
        const __m512i more = _mm512_maskz_cvtepu16_epi32(kept, _mm512_castsi512_si256(moved));
        _mm512_store_si512(to, _mm512_add_epi32(_mm512_load_si512(to), more));
      }
    }
  }
}

// Sixteen vectors of partial sums to sixteen sums.
inline __m512i add_partial_sums(const uint32_t* sums) {
  __m512i four[4];
  BSM_UNROLL
  for (int32_t i = 0; i < 4; ++i) {
    const __m512i a = _mm512_load_si512(sums + 64 * i);
    const __m512i b = _mm512_load_si512(sums + 64 * i + 16);
    const __m512i c = _mm512_load_si512(sums + 64 * i + 32);
    const __m512i d = _mm512_load_si512(sums + 64 * i + 48);
    const __m512i ab = _mm512_add_epi32(_mm512_unpacklo_epi32(a, b), _mm512_unpackhi_epi32(a, b));
    const __m512i cd = _mm512_add_epi32(_mm512_unpacklo_epi32(c, d), _mm512_unpackhi_epi32(c, d));
    four[i] = _mm512_add_epi32(_mm512_unpacklo_epi64(ab, cd), _mm512_unpackhi_epi64(ab, cd));
  }
  // Each 128 bits of four[i] hold partial sums of levels 4 i .. 4 i + 3.
  const __m512i a =
      _mm512_add_epi32(_mm512_shuffle_i32x4(four[0], four[1], 0x44), _mm512_shuffle_i32x4(four[0], four[1], 0xee));
  const __m512i b =
      _mm512_add_epi32(_mm512_shuffle_i32x4(four[2], four[3], 0x44), _mm512_shuffle_i32x4(four[2], four[3], 0xee));
  return _mm512_add_epi32(_mm512_shuffle_i32x4(a, b, 0x88), _mm512_shuffle_i32x4(a, b, 0xdd));
}

template <int32_t kPlanes>
void vote_group(const Window& window, const Group& group) {
  const VoteWeighArgs& args = window.args;
  const ptrdiff_t sums_of_pixel = ptrdiff_t{window.levels} * 16;
  BSM_MEMSET(window.votes, 0, sizeof(uint32_t) * static_cast<size_t>(group.count * sums_of_pixel));
  for (int32_t dy = -args.radius; dy <= args.radius; ++dy) {
    if (args.levels[dy + args.radius] == nullptr) continue;
    add_row<kPlanes>(window, group, dy);
  }
  for (int32_t i = 0; i < group.count; ++i) {
    uint32_t* votes = window.votes + i * sums_of_pixel;
    for (int32_t level = 0; level < window.levels; level += 16) {
      _mm512_store_si512(votes + level, add_partial_sums(votes + ptrdiff_t{level} * 16));
    }
    args.out[group.x[i]] = vote_of(args, votes, group.x[i]);
  }
}

// The next pixels without a level from x on that fit a group.
Group next_group(const Window& window, int32_t x) {
  const VoteWeighArgs& args = window.args;
  const uint16_t* levels = args.levels[args.radius];
  Group group{x - args.radius, 0, {}};
  const int32_t end = x + kColumns - 2 * args.radius < args.width ? x + kColumns - 2 * args.radius : args.width;
  for (; x < end && group.count < kGroup; ++x) {
    if (levels[x] >= kOccluded) group.x[group.count++] = x;
  }
  return group;
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_VOTE_GROUP_AVX512_H
