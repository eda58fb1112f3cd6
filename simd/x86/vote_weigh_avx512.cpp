// vote_weigh, AVX-512 BW, VBMI: windows whose taps lie apart take 32 taps of a row at once; full windows go by groups.
// Only pixels without a level are looked at. Distances, exponents and weights are 16-bit lanes; the table of weights is
// looked up in bytes, 128 entries at a time by permutations, three instructions each.
// Full windows go by groups of pixels, see vote_group_avx512.h.
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
#include "simd/x86/vote_group_avx512.h"
#include "simd/x86/vote_sparse_avx512.h"

namespace bsm {
namespace {

// Votes of the taps from `tap` on in one row of the window; kStrided: taps lie apart.
template <int32_t kPlanes, bool kStrided>
inline void collect_taps(const Window& window, int32_t x, int32_t dy, int32_t tap, const __m256i (&center)[kPlanes]) {
  const VoteWeighArgs& args = window.args;
  Scratch& scratch = window.scratch;
  const int32_t begin = x - args.radius + tap * args.step;  // column of the first tap
  const uint16_t* levels = args.levels[dy + args.radius] + begin;
  const uint8_t* lab = args.lab[dy + args.radius] + begin;
  const int32_t first = -begin;
  const int32_t last = args.width - begin;
  const __m512i none = _mm512_set1_epi16(-1);
  __m512i level = _mm512_mask_loadu_epi16(none, static_cast<__mmask32>(range(first, last, 32)), levels);
  __m512i positions = _mm512_setzero_si512();
  if (kStrided) {
    const __m512i high =
        _mm512_mask_loadu_epi16(none, static_cast<__mmask32>(range(first - 32, last - 32, 32)), levels + 32);
    const __m512i lanes = _mm512_maskz_permutexvar_epi8(
        0x5555555555555555u,
        _mm512_set_epi8(0, 31, 0, 30, 0, 29, 0, 28, 0, 27, 0, 26, 0, 25, 0, 24, 0, 23, 0, 22, 0, 21, 0, 20, 0, 19, 0, 18, 0,
                        17, 0, 16, 0, 15, 0, 14, 0, 13, 0, 12, 0, 11, 0, 10, 0, 9, 0, 8, 0, 7, 0, 6, 0, 5, 0, 4, 0, 3, 0, 2,
                        0, 1, 0, 0),
        _mm512_set_epi64(0, 0, 0, 0, 0x1f1e1d1c1b1a1918, 0x1716151413121110, 0x0f0e0d0c0b0a0908, 0x0706050403020100));
    positions = _mm512_mullo_epi16(lanes, _mm512_set1_epi16(static_cast<int16_t>(args.step)));
    level = _mm512_permutex2var_epi16(level, positions, high);
  }
  const int32_t count = window.taps - tap < window.at_once ? window.taps - tap : window.at_once;
  const __mmask32 valid = _mm512_mask_cmplt_epu16_mask(static_cast<__mmask32>(range(0, count, kLanes)), level,
                                                       _mm512_set1_epi16(static_cast<int16_t>(kOccluded)));
  if (valid == 0) return;

  const __mmask64 inside = range(first, last, kStrided ? 64 : 32);
  __m512i sad = _mm512_setzero_si512();
  BSM_UNROLL
  for (int32_t plane = 0; plane < kPlanes; ++plane) {
    const uint8_t* row = lab + plane * args.plane_stride;
    __m256i color;
    if (kStrided) {
      const __m512i packed = _mm512_maskz_loadu_epi8(inside, row);
      color =
          _mm512_castsi512_si256(_mm512_permutexvar_epi8(_mm512_castsi256_si512(_mm512_cvtepi16_epi8(positions)), packed));
    } else {
      color = _mm256_maskz_loadu_epi8(static_cast<__mmask32>(inside), row);
    }
    const __m256i distance = _mm256_sub_epi8(_mm256_max_epu8(color, center[plane]), _mm256_min_epu8(color, center[plane]));
    sad = _mm512_add_epi16(sad, _mm512_cvtepu8_epi16(distance));
  }
  const __m512i distance = _mm512_loadu_si512(scratch.distance[dy < 0 ? -dy : dy] + kColumns - args.radius + tap);
  const __m512i exponent = _mm512_adds_epu16(color_exponent(sad, args.color_scale), distance);
  __m512i weight[2];
  weigh(window, exponent, _mm512_set1_epi16(-1), weight);
  const __m512i whole = _mm512_srli_epi16(_mm512_add_epi16(level, _mm512_set1_epi16(8)), kLevelShift);
  _mm512_store_si512(scratch.weight, _mm512_maskz_mov_epi16(valid, weight[0]));
  _mm512_store_si512(scratch.level, _mm512_maskz_mov_epi16(valid, whole));
  uint32_t* even = window.votes;
  uint32_t* odd = window.votes + window.levels;
  for (int32_t i = 0; i < count; i += 2) {
    even[scratch.level[i]] += scratch.weight[i];
    odd[scratch.level[i + 1]] += scratch.weight[i + 1];
  }
}

template <int32_t kPlanes, bool kStrided>
void collect_votes(const Window& window, int32_t x) {
  const VoteWeighArgs& args = window.args;
  BSM_MEMSET(window.votes, 0, 2 * sizeof(uint32_t) * static_cast<size_t>(window.levels));
  __m256i center[kPlanes];
  for (int32_t plane = 0; plane < kPlanes; ++plane) {
    center[plane] = _mm256_set1_epi8(static_cast<char>(args.lab[args.radius][x + plane * args.plane_stride]));
  }
  for (int32_t dy = -args.radius; dy <= args.radius; dy += args.step) {
    if (args.levels[dy + args.radius] == nullptr) continue;
    for (int32_t tap = 0; tap < window.taps; tap += window.at_once)
      collect_taps<kPlanes, kStrided>(window, x, dy, tap, center);
  }
  for (int32_t i = 0; i < window.levels; i += 16) {
    uint32_t* votes = window.votes + i;
    _mm512_store_si512(votes, _mm512_add_epi32(_mm512_load_si512(votes), _mm512_load_si512(votes + window.levels)));
  }
}

// Whole levels of a row; pixels without a level follow.
void copy_whole(const VoteWeighArgs& args) {
  const uint16_t* levels = args.levels[args.radius];
  for (int32_t x = 0; x < args.width; x += kLanes) {
    const __mmask32 kept = static_cast<__mmask32>(range(0, args.width - x, kLanes));
    const __m512i level = _mm512_maskz_loadu_epi16(kept, levels + x);
    const __m512i whole = _mm512_srli_epi16(_mm512_add_epi16(level, _mm512_set1_epi16(8)), kLevelShift);
    _mm512_mask_storeu_epi16(args.out + x, kept, _mm512_slli_epi16(whole, kLevelShift));
  }
}

// The first pixel from x on without a level, width when there is none.
int32_t next_missing(const VoteWeighArgs& args, int32_t x) {
  const uint16_t* levels = args.levels[args.radius];
  for (; x < args.width; x += kLanes) {
    const __mmask32 kept = static_cast<__mmask32>(range(0, args.width - x, kLanes));
    const __m512i level = _mm512_maskz_loadu_epi16(kept, levels + x);
    const uint32_t missing = _mm512_mask_cmpge_epu16_mask(kept, level, _mm512_set1_epi16(static_cast<int16_t>(kOccluded)));
    if (missing != 0) return x + __builtin_ctz(missing);
  }
  return args.width;
}

template <int32_t kPlanes>
BSM_NOINLINE void vote_row(const Window& window) {
  const VoteWeighArgs& args = window.args;
  copy_whole(args);
  const bool grouped = args.step == 1 && args.radius <= kMaxGroupRadius && args.num_disparities <= kMaxGroupLevels;
  for (int32_t x = next_missing(args, 0); x < args.width;) {
    if (grouped) {
      const Group group = next_group(window, x);
      vote_group<kPlanes>(window, group);
      x = next_missing(args, group.x[group.count - 1] + 1);
      continue;
    }
    if (args.step == 1) {
      collect_votes<kPlanes, false>(window, x);
    } else {
      collect_votes<kPlanes, true>(window, x);
    }
    args.out[x] = vote_of(args, window.votes, x);
    x = next_missing(args, x + 1);
  }
}

template <int32_t kPlanes>
BSM_NOINLINE void vote_sparse_row(const VoteWeighArgs& args) {
  const int32_t taps = 2 * args.radius / args.step + 1;
  const SparseWindow window{args, *static_cast<SparseScratch*>(args.scratch), taps, kColumns / taps,
                            sparse_columns(args, taps)};
  prepare(window);
  copy_whole(args);
  for (int32_t x = next_missing(args, 0); x < args.width; x = next_missing(args, x + 1)) {
    args.out[x] = vote_sparse<kPlanes>(window, x);
  }
}

}  // namespace

uint64_t vote_weigh_avx512_scratch(const KernelShape& shape) {
  const uint64_t sparse = sparse_scratch_bytes(shape);
  const uint64_t other = sizeof(Scratch) + votes_bytes(shape.num_disparities);
  return sparse < other ? other : sparse;
}

void vote_weigh_avx512(const VoteWeighArgs& args) {
  if (is_sparse(args)) return args.planes == 3 ? vote_sparse_row<3>(args) : vote_sparse_row<1>(args);
  Scratch& scratch = *static_cast<Scratch*>(args.scratch);
  Window window{args,
                scratch,
                reinterpret_cast<uint32_t*>(&scratch + 1),
                (args.num_disparities + 15) / 16 * 16,
                2 * args.radius / args.step + 1,
                63 / args.step + 1 < kLanes ? 63 / args.step + 1 : kLanes,
                {0, 0}};
  prepare(window);
  return args.planes == 3 ? vote_row<3>(window) : vote_row<1>(window);
}

}  // namespace bsm
#endif
