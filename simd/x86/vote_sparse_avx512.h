// Votes of windows with few taps on AVX-512: the taps of several rows are gathered into one register by permutations.
// Levels become bytes once a row. Weights are looked up and added one by one, to four sets of sums in turn, so that taps of
// one level do not wait for each other. Bound, for each pixel: a load that crosses cache lines and a permutation for each
// row and plane, four loads and a store for each tap.
#ifndef BSM_SIMD_X86_VOTE_SPARSE_AVX512_H
#define BSM_SIMD_X86_VOTE_SPARSE_AVX512_H

#include "simd/x86/vote_window_avx512.h"

namespace bsm {
namespace {

constexpr int32_t kSparseTaps = 9;             // in a row or a column of the window, at most
constexpr int32_t kSparseLevels = 255;         // that bytes hold
constexpr uint8_t kNoVote = 255;               // byte of a pixel without a level
constexpr uint32_t kSparseColorScale = 32767;  // at most: exponents of colours by one signed multiplication
constexpr int32_t kRegisters = 2;              // that the taps take at most
constexpr int32_t kSets = 4;                   // of sums
constexpr int32_t kWeights = kMaxTables * kTableEntries;

struct alignas(64) SparseScratch {
  uint32_t votes[kSets][kSparseLevels + 1];
  // Of the taps of a register, even ones first.
  uint16_t distance[kRegisters][2][kLanes];  // their exponents
  uint16_t exponent[2][kLanes];
  uint8_t level[kColumns];
  uint16_t weights[kWeights + kLanes];  // 0 from the last exponent on
  const uint8_t* levels[kSparseTaps];   // rows of level bytes, followed and preceded by kColumns without a level
  const uint8_t* lab[kSparseTaps];
};

uint64_t sparse_row_bytes(int32_t width) {
  return static_cast<uint64_t>((width + kColumns - 1) / kColumns + 2) * kColumns;
}

uint64_t sparse_scratch_bytes(const KernelShape& shape) {
  return shape.num_disparities > kSparseLevels ? 0 : sizeof(SparseScratch) + kSparseTaps * sparse_row_bytes(shape.width);
}

bool is_sparse(const VoteWeighArgs& args) {
  return args.step > 1 && 2 * args.radius < kSparseTaps * args.step && args.radius < kColumns / 2 &&
         args.num_disparities <= kSparseLevels && args.color_scale <= kSparseColorScale;
}

// What stays the same for all pixels of a row.
struct SparseWindow {
  const VoteWeighArgs& args;
  SparseScratch& scratch;
  int32_t taps;     // in a row or a column
  int32_t rows;     // of taps in a register
  __m512i columns;  // of the taps in a register, from the window's first column on
};

// Whole levels of a row as bytes; nullptr: a row without any.
void take_levels(const uint16_t* levels, int32_t width, uint8_t* out) {
  const __m512i none = _mm512_set1_epi8(static_cast<char>(kNoVote));
  const __m512i missing = _mm512_set1_epi16(static_cast<int16_t>(kOccluded));
  if (levels == nullptr) {
    BSM_MEMSET(out, kNoVote, static_cast<size_t>(sparse_row_bytes(width)));
    return;
  }
  _mm512_store_si512(out, none);
  out += kColumns;
  for (int32_t x = 0; x < width; x += kColumns, out += kColumns) {
    const uint64_t inside = range(0, width - x, kColumns);
    const __m512i low = _mm512_mask_loadu_epi16(missing, static_cast<__mmask32>(inside), levels + x);
    const __m512i high = _mm512_mask_loadu_epi16(missing, static_cast<__mmask32>(inside >> kLanes), levels + x + kLanes);
    const auto whole = [](__m512i level) {
      return _mm512_cvtepi16_epi8(_mm512_srli_epi16(_mm512_add_epi16(level, _mm512_set1_epi16(8)), kLevelShift));
    };
    const __m512i bytes = _mm512_inserti64x4(_mm512_castsi256_si512(whole(low)), whole(high), 1);
    const __mmask64 valid = _mm512_kunpackd(_mm512_cmplt_epu16_mask(high, missing), _mm512_cmplt_epu16_mask(low, missing));
    _mm512_store_si512(out, _mm512_mask_mov_epi8(none, valid, bytes));
  }
  _mm512_store_si512(out, none);
}

void prepare(const SparseWindow& window) {
  const VoteWeighArgs& args = window.args;
  SparseScratch& scratch = window.scratch;
  BSM_MEMSET(scratch.weights + args.weights_count, 0,
             sizeof(uint16_t) * static_cast<size_t>(kWeights + kLanes - args.weights_count));
  BSM_MEMCPY(scratch.weights, args.weights, sizeof(uint16_t) * static_cast<size_t>(args.weights_count));
  uint8_t* levels = reinterpret_cast<uint8_t*>(&scratch + 1);
  for (int32_t i = 0; i < window.taps; ++i, levels += sparse_row_bytes(args.width)) {
    const int32_t row = i * args.step;
    const int32_t dy = row - args.radius;
    take_levels(args.levels[row], args.width, levels);
    scratch.levels[i] = levels + kColumns;
    scratch.lab[i] = args.lab[args.levels[row] == nullptr ? args.radius : row];
    const uint16_t* steps = args.distance_steps + ptrdiff_t{dy < 0 ? -dy : dy} * (args.radius + 1);
    for (int32_t tap = 0; tap < window.taps; ++tap) {
      const int32_t dx = tap * args.step - args.radius;
      const int32_t lane = i % window.rows * window.taps + tap;
      scratch.distance[i / window.rows][lane & 1][lane >> 1] = steps[dx < 0 ? -dx : dx];
    }
  }
}

// Adds the votes of the taps of rows first..last - 1.
template <int32_t kPlanes>
inline void add_votes(const SparseWindow& window, int32_t first, int32_t last, int32_t x, uint64_t inside,
                      const __m512i (&center)[kPlanes]) {
  const VoteWeighArgs& args = window.args;
  SparseScratch& scratch = window.scratch;
  __m512i level = _mm512_set1_epi8(static_cast<char>(kNoVote));
  __m512i color[kPlanes];
  BSM_UNROLL
  for (int32_t plane = 0; plane < kPlanes; ++plane) color[plane] = _mm512_setzero_si512();
  uint64_t lanes = range(0, window.taps, kColumns);
  for (int32_t i = first; i < last; ++i, lanes <<= window.taps) {
    const __m512i levels = _mm512_loadu_si512(scratch.levels[i] + x - args.radius);
    level = _mm512_mask_permutexvar_epi8(level, lanes, window.columns, levels);
    const uint8_t* lab = scratch.lab[i] + x - args.radius;
    BSM_UNROLL
    for (int32_t plane = 0; plane < kPlanes; ++plane) {
      const __m512i colors = _mm512_maskz_loadu_epi8(inside, lab + plane * args.plane_stride);
      color[plane] = _mm512_mask_permutexvar_epi8(color[plane], lanes, window.columns, colors);
    }
  }
  __m512i even = _mm512_setzero_si512();
  __m512i odd = _mm512_setzero_si512();
  BSM_UNROLL
  for (int32_t plane = 0; plane < kPlanes; ++plane) {
    const __m512i distance =
        _mm512_sub_epi8(_mm512_max_epu8(color[plane], center[plane]), _mm512_min_epu8(color[plane], center[plane]));
    even = _mm512_add_epi16(even, _mm512_and_si512(distance, _mm512_set1_epi16(255)));
    odd = _mm512_add_epi16(odd, _mm512_srli_epi16(distance, 8));
  }
  const uint16_t(&distances)[2][kLanes] = scratch.distance[first / window.rows];
  const __m512i scale = _mm512_set1_epi16(static_cast<int16_t>(args.color_scale));
  const auto exponent = [&](__m512i sad, const uint16_t* distance) {
    // (32 sad * scale + 2^14) >> 15 is (sad * scale + 512) >> 10; 32 * kMaxSad fits 15 bits.
    const __m512i color_steps = _mm512_mulhrs_epi16(_mm512_slli_epi16(sad, 5), scale);
    const __m512i sum = _mm512_adds_epu16(color_steps, _mm512_load_si512(distance));
    return _mm512_min_epu16(sum, _mm512_set1_epi16(kWeights));
  };
  _mm512_store_si512(scratch.level, level);
  _mm512_store_si512(scratch.exponent[0], exponent(even, distances[0]));
  _mm512_store_si512(scratch.exponent[1], exponent(odd, distances[1]));
  const int32_t count = (last - first) * window.taps;  // the lanes beyond have no level
  for (int32_t i = 0; 2 * i < count; i += 2) {
    scratch.votes[0][scratch.level[2 * i]] += scratch.weights[scratch.exponent[0][i]];
    scratch.votes[1][scratch.level[2 * i + 1]] += scratch.weights[scratch.exponent[1][i]];
    scratch.votes[2][scratch.level[2 * i + 2]] += scratch.weights[scratch.exponent[0][i + 1]];
    scratch.votes[3][scratch.level[2 * i + 3]] += scratch.weights[scratch.exponent[1][i + 1]];
  }
}

template <int32_t kPlanes>
uint16_t vote_sparse(const SparseWindow& window, int32_t x) {
  const VoteWeighArgs& args = window.args;
  uint32_t(&votes)[kSets][kSparseLevels + 1] = window.scratch.votes;
  for (int32_t level = 0; level < args.num_disparities; level += 16) {
    BSM_UNROLL
    for (int32_t set = 0; set < kSets; ++set) _mm512_store_si512(votes[set] + level, _mm512_setzero_si512());
  }
  __m512i center[kPlanes];
  BSM_UNROLL
  for (int32_t plane = 0; plane < kPlanes; ++plane) {
    center[plane] = _mm512_set1_epi8(static_cast<char>(args.lab[args.radius][x + plane * args.plane_stride]));
  }
  const uint64_t inside = range(args.radius - x, args.width + args.radius - x, kColumns);
  for (int32_t first = 0; first < window.taps; first += window.rows) {
    const int32_t last = first + window.rows < window.taps ? first + window.rows : window.taps;
    add_votes<kPlanes>(window, first, last, x, inside, center);
  }
  for (int32_t level = 0; level < args.num_disparities; level += 16) {
    const __m512i a = _mm512_add_epi32(_mm512_load_si512(votes[0] + level), _mm512_load_si512(votes[1] + level));
    const __m512i b = _mm512_add_epi32(_mm512_load_si512(votes[2] + level), _mm512_load_si512(votes[3] + level));
    _mm512_store_si512(votes[0] + level, _mm512_add_epi32(a, b));
  }
  return vote_of(args, votes[0], x);
}

// The columns of the taps that a register holds.
inline __m512i sparse_columns(const VoteWeighArgs& args, int32_t taps) {
  alignas(64) uint8_t columns[kColumns];
  for (int32_t lane = 0; lane < kColumns; ++lane) columns[lane] = static_cast<uint8_t>(lane % taps * args.step);
  return _mm512_load_si512(columns);
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_VOTE_SPARSE_AVX512_H
