// median_weighted, AVX-512 BW, VBMI: 64 neighbouring pixels at once, colours and weights in bytes, sums in 16 bits.
// Weights are looked up by colour difference in a table of their tap's distance. Blocks whose pixels all have flat
// neighbourhoods are copied. Pixels that move walk up or down the levels of their window, 32 at a time: a walk passes all
// taps once for each level between the old and the new. Bound, per tap and 64 pixels of three planes: 26 operations and the
// same again in loads, most of them across cache lines; per step of a walk, tap and 32 pixels: 5.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include <immintrin.h>

#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kPixelsAtOnce = 64;
constexpr int32_t kHalf = 32;
constexpr int32_t kSide = 2 * kMaxMedianRadius + 1;
constexpr int32_t kMaxTaps = (kSide * kSide + 1) / 2;
constexpr int32_t kMaxTables = (kMaxMedianRadius + 1) * (kMaxMedianRadius + 2) / 2;
constexpr int32_t kColors = 256;  // colour differences that weights tell apart

// A pixel of the window, inside the image's rows.
struct Tap {
  const uint16_t* levels;
  const uint8_t* lab;
  int32_t dx;
  int32_t table;
};

// Half a block: its levels, and the weights below, above and of all.
struct Sums {
  __m512i own, below, above, all;
  __m512i bonus;  // of the own level, part of all

  void add(__m512i level, __m512i weight) {
    below = _mm512_mask_add_epi16(below, _mm512_cmplt_epu16_mask(level, own), below, weight);
    above = _mm512_mask_add_epi16(above, _mm512_cmpgt_epu16_mask(level, own), above, weight);
    all = _mm512_add_epi16(all, weight);
  }
  // Where one side weighs more than half; without doubling, which 16 bits do not hold.
  __mmask32 below_wins() const { return _mm512_cmpgt_epu16_mask(below, _mm512_sub_epi16(all, below)); }
  __mmask32 above_wins() const { return _mm512_cmpgt_epu16_mask(above, _mm512_sub_epi16(all, above)); }
};

struct Scratch {
  Sums sums[2];                              // of the block
  uint16_t weight[kMaxTaps][kPixelsAtOnce];  // of the block's pixels, by tap
  uint8_t tables[kMaxTables][kColors];       // weight of a colour difference, by distance
  Tap taps[kMaxTaps];
};

// Pixels of a row, or of half a block, as bits begin..end-1 of 64.
inline uint64_t range(int32_t begin, int32_t end) {
  begin = begin < 0 ? 0 : begin;
  end = end > 64 ? 64 : end;
  return begin < end ? ~uint64_t{0} >> (64 - (end - begin)) << begin : 0;
}

inline __m512i set8(uint32_t value) {
  return _mm512_set1_epi8(static_cast<char>(value));
}
inline __m512i set16(uint32_t value) {
  return _mm512_set1_epi16(static_cast<int16_t>(value));
}

// What stays the same for all pixels of a row.
struct Window {
  const MedianWeightedArgs& args;
  Scratch& scratch;
  bool wide;      // colour differences above 127 weigh something more than the last weight
  int32_t count;  // taps
};

// Weights by colour difference below `colors` for one distance: weights[min(127, (c * color_scale >> 8) + steps)].
void make_table(const MedianWeightedArgs& args, uint32_t steps, int32_t colors, uint8_t* table) {
  const __m512i low = _mm512_loadu_si512(args.weights);
  const __m512i high = _mm512_loadu_si512(args.weights + 64);
  const __m512i scale = set16(args.color_scale);
  const __m512i order = _mm512_setr_epi64(0, 2, 4, 6, 1, 3, 5, 7);
  const __m512i place = _mm512_setr_epi64(0x0706050403020100, 0x0f0e0d0c0b0a0908, 0x1716151413121110, 0x1f1e1d1c1b1a1918,
                                          0x2726252423222120, 0x2f2e2d2c2b2a2928, 0x3736353433323130, 0x3f3e3d3c3b3a3938);
  for (int32_t i = 0; i < colors; i += 64) {
    const __m512i color = _mm512_add_epi8(place, set8(static_cast<uint32_t>(i)));
    const __m512i a = _mm512_slli_epi16(_mm512_cvtepu8_epi16(_mm512_castsi512_si256(color)), 8);
    const __m512i b = _mm512_slli_epi16(_mm512_cvtepu8_epi16(_mm512_extracti64x4_epi64(color, 1)), 8);
    const __m512i packed = _mm512_packus_epi16(_mm512_mulhi_epu16(a, scale), _mm512_mulhi_epu16(b, scale));
    const __m512i exponent = _mm512_adds_epu8(_mm512_permutexvar_epi64(order, packed), set8(steps));
    _mm512_storeu_si512(table + i, _mm512_permutex2var_epi8(low, _mm512_min_epu8(exponent, set8(127)), high));
  }
}

// The taps inside the image's rows and the tables of their distances.
void prepare(Window& window) {
  const MedianWeightedArgs& args = window.args;
  Scratch& scratch = window.scratch;
  const int32_t radius = args.radius;
  for (int32_t dy = 0; dy <= radius; ++dy) {
    for (int32_t dx = dy & 1; dx <= radius; dx += 2) {
      make_table(args, args.distance_steps[dy * (radius + 1) + dx], window.wide ? kColors : kColors / 2,
                 scratch.tables[(dy * (radius + 2) + dx) / 2]);
    }
  }
  window.count = 0;
  for (int32_t dy = -radius; dy <= radius; ++dy) {
    if (args.levels[dy + radius] == nullptr) continue;
    for (int32_t dx = -radius + ((dy + radius) & 1); dx <= radius; dx += 2) {
      const int32_t table = ((dy < 0 ? -dy : dy) * (radius + 2) + (dx < 0 ? -dx : dx)) / 2;
      scratch.taps[window.count++] = Tap{args.levels[dy + radius], args.lab[dy + radius], dx, table};
    }
  }
}

inline __m512i load_levels(const uint16_t* from, uint64_t inside) {
  return _mm512_maskz_loadu_epi16(static_cast<__mmask32>(inside), from);
}

// The same with kInside: all pixels are.
template <bool kInside>
inline __m512i load_tap_levels(const uint16_t* from, uint64_t inside) {
  return kInside ? _mm512_loadu_si512(from) : load_levels(from, inside);
}
template <bool kInside>
inline __m512i load_colors(const uint8_t* from, uint64_t inside) {
  return kInside ? _mm512_loadu_si512(from) : _mm512_maskz_loadu_epi8(inside, from);
}

// True when the windows of all pixels x..x+63 lie in the row.
inline bool is_inside(const MedianWeightedArgs& args, int32_t x) {
  return args.radius <= x && x + kPixelsAtOnce + args.radius <= args.width;
}

inline __m512i distance8(__m512i a, __m512i b) {
  return _mm512_sub_epi8(_mm512_max_epu8(a, b), _mm512_min_epu8(a, b));
}

// Weights of a tap by the colour differences to its 64 pixels, at most 255. kWide: differences above 127 weigh something.
template <bool kWide>
inline __m512i look_up(const uint8_t* table, __m512i color) {
  const __m512i a = _mm512_loadu_si512(table);
  const __m512i b = _mm512_loadu_si512(table + 64);
  if (!kWide) return _mm512_permutex2var_epi8(a, _mm512_min_epu8(color, set8(127)), b);
  const __m512i c = _mm512_loadu_si512(table + 128);
  const __m512i d = _mm512_loadu_si512(table + 192);
  return _mm512_mask_mov_epi8(_mm512_permutex2var_epi8(a, color, b), _mm512_movepi8_mask(color),
                              _mm512_permutex2var_epi8(c, color, d));
}

// Adds up the windows of the pixels x..x+63, as far as they are in the row, and keeps their weights.
template <int32_t kPlanes, bool kWide, bool kInside>
BSM_NOINLINE void weigh_block(const Window& window, int32_t x) {
  const MedianWeightedArgs& args = window.args;
  Sums(&sums)[2] = window.scratch.sums;
  const uint64_t pixels = range(0, args.width - x);
  __m512i center[kPlanes];
  BSM_UNROLL
  for (int32_t plane = 0; plane < kPlanes; ++plane) {
    center[plane] = _mm512_maskz_loadu_epi8(pixels, args.lab[args.radius] + plane * args.plane_stride + x);
  }
  BSM_UNROLL
  for (int32_t half = 0; half < 2; ++half) {
    const __mmask32 here = static_cast<__mmask32>(pixels >> (half * kHalf));
    const int32_t at = x + half * kHalf;
    const __m512i checked = _mm512_mask_loadu_epi16(set16(kNoLevel), here, args.checked + at);
    Sums& sum = sums[half];
    sum.own = load_levels(args.levels[args.radius] + at, here);
    sum.bonus = _mm512_maskz_mov_epi16(_mm512_cmplt_epu16_mask(checked, set16(kOccluded)), set16(args.own_bonus));
    sum.all = sum.bonus;
    sum.below = sum.above = _mm512_setzero_si512();
  }
  const ptrdiff_t plane_stride = args.plane_stride;
  Sums low = sums[0];
  Sums high = sums[1];
  for (int32_t i = 0; i < window.count; ++i) {
    const Tap& tap = window.scratch.taps[i];
    const int32_t at = x + tap.dx;
    const uint64_t inside = kInside ? ~uint64_t{0} : range(-at, args.width - at) & pixels;
    __m512i color = _mm512_setzero_si512();
    BSM_UNROLL
    for (int32_t plane = 0; plane < kPlanes; ++plane) {
      const __m512i other = load_colors<kInside>(tap.lab + plane * plane_stride + at, inside);
      color = _mm512_adds_epu8(color, distance8(center[plane], other));
    }
    __m512i weight = look_up<kWide>(window.scratch.tables[tap.table], color);
    if (!kInside) weight = _mm512_maskz_mov_epi8(inside, weight);
    const __m512i weight0 = _mm512_cvtepu8_epi16(_mm512_castsi512_si256(weight));
    const __m512i weight1 = _mm512_cvtepu8_epi16(_mm512_extracti64x4_epi64(weight, 1));
    _mm512_store_si512(window.scratch.weight[i], weight0);
    _mm512_store_si512(window.scratch.weight[i] + kHalf, weight1);
    low.add(load_tap_levels<kInside>(tap.levels + at, inside), weight0);
    high.add(load_tap_levels<kInside>(tap.levels + at + kHalf, inside >> kHalf), weight1);
  }
  sums[0] = low;
  sums[1] = high;
}

// The weighted medians of the pixels x..x+31 that `moving` holds, the own levels of the others; `down`: the median lies
// below. Levels of pixels that move down are complemented, so that all walk up, until the weight up to their level is at
// least half of all; walking down, more than half, as the median is the least level up to which at least half lies. The next
// level of the window is mostly a whole one away: that is tried first.
template <bool kInside>
BSM_NOINLINE __m512i walk(const Window& window, int32_t x, int32_t half, __mmask32 moving, __mmask32 down) {
  const MedianWeightedArgs& args = window.args;
  const Sums& sums = window.scratch.sums[half];
  const __m512i flip = _mm512_maskz_set1_epi16(down, -1);
  const __m512i more = _mm512_mask_mov_epi16(_mm512_and_si512(sums.all, set16(1)), down, set16(1));
  const __m512i wanted = _mm512_add_epi16(_mm512_srli_epi16(sums.all, 1), more);
  const __m512i step = set16(1 << kLevelShift);
  __m512i passed = _mm512_xor_si512(sums.own, flip);  // the median lies above
  __m512i level = _mm512_adds_epu16(passed, step);
  __m512i median = passed;
  while (true) {
    __m512i weight = sums.bonus;
    __m512i next = _mm512_set1_epi16(-1);
    for (int32_t i = 0; i < window.count; ++i) {
      const Tap& tap = window.scratch.taps[i];
      const int32_t at = x + tap.dx;
      const uint64_t inside = kInside ? ~uint64_t{0} : range(-at, args.width - at);
      const __m512i other = _mm512_xor_si512(load_tap_levels<kInside>(tap.levels + at, inside), flip);
      const __mmask32 within = _mm512_cmple_epu16_mask(other, level);
      weight = _mm512_mask_add_epi16(weight, within, weight, _mm512_load_si512(window.scratch.weight[i] + half * kHalf));
      next = _mm512_mask_min_epu16(next, _mm512_cmpgt_epu16_mask(other, passed), next, other);
    }
    // Where the level tried is not the next one, the next one is tried.
    const __mmask32 tried = _mm512_cmpeq_epi16_mask(next, level);
    const __mmask32 done = _mm512_mask_cmpge_epu16_mask(moving & tried, weight, wanted);
    median = _mm512_mask_mov_epi16(median, done, level);
    moving &= ~done;
    if (moving == 0) return _mm512_xor_si512(median, flip);
    passed = _mm512_mask_mov_epi16(passed, tried, level);
    level = _mm512_mask_adds_epu16(next, tried, level, step);
  }
}

// The pixels x..x+63 whose 3x3 neighbourhood, as far as it is in the image, holds one level.
uint64_t flat_pixels(const MedianWeightedArgs& args, int32_t x) {
  uint64_t uneven = 0;
  BSM_UNROLL
  for (int32_t half = 0; half < 2; ++half) {
    const int32_t at = x + half * kHalf;
    const __m512i own = load_levels(args.levels[args.radius] + at, range(0, args.width - at));
    for (int32_t dy = -1; dy <= 1; ++dy) {
      const uint16_t* levels = args.levels[args.radius + dy];
      if (levels == nullptr) continue;
      for (int32_t i = at - 1; i <= at + 1; ++i) {
        const __mmask32 inside = static_cast<__mmask32>(range(-i, args.width - i));
        const __mmask32 differs = _mm512_mask_cmpneq_epu16_mask(inside, _mm512_maskz_loadu_epi16(inside, levels + i), own);
        uneven |= uint64_t{differs} << (half * kHalf);
      }
    }
  }
  return ~uneven;
}

template <int32_t kPlanes, bool kWide>
void smooth_row(const Window& window) {
  const MedianWeightedArgs& args = window.args;
  for (int32_t x = 0; x < args.width; x += kPixelsAtOnce) {
    const uint64_t pixels = range(0, args.width - x);
    const uint64_t uneven = pixels & ~flat_pixels(args, x);
    const bool inside = is_inside(args, x);
    if (uneven != 0 && inside) weigh_block<kPlanes, kWide, true>(window, x);
    if (uneven != 0 && !inside) weigh_block<kPlanes, kWide, false>(window, x);
    for (int32_t half = 0; half < 2; ++half) {
      const int32_t at = x + half * kHalf;
      const __mmask32 here = static_cast<__mmask32>(pixels >> (half * kHalf));
      const __mmask32 uneven_here = static_cast<__mmask32>(uneven >> (half * kHalf));
      __m512i level = load_levels(args.levels[args.radius] + at, here);
      if (uneven_here != 0) {
        const __mmask32 down = uneven_here & window.scratch.sums[half].below_wins();
        const __mmask32 moving = down | (uneven_here & window.scratch.sums[half].above_wins());
        if (moving != 0) {
          level = inside ? walk<true>(window, at, half, moving, down) : walk<false>(window, at, half, moving, down);
        }
      }
      _mm512_mask_storeu_epi16(args.out + at, here, level);
    }
  }
}

template <int32_t kPlanes>
void smooth_row_of(const Window& window) {
  return window.wide ? smooth_row<kPlanes, true>(window) : smooth_row<kPlanes, false>(window);
}

}  // namespace

uint64_t median_weighted_avx512_scratch(const KernelShape&) {
  return sizeof(Scratch);
}

void median_weighted_avx512(const MedianWeightedArgs& args) {
  // Not wide when a difference of 127 reaches the last exponent.
  Window window{args, *static_cast<Scratch*>(args.scratch), 127 * args.color_scale >> 8 < 127, 0};
  prepare(window);
  return args.planes == 3 ? smooth_row_of<3>(window) : smooth_row_of<1>(window);
}

}  // namespace bsm
#endif
