// Speckle filter of one row.
#include "core/speckle.h"

#include "platform/compiler.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kSameSurface = 24;  // sixteenths
// Where the compiler has vectors, pixels are taken together. Without, each stops on its own.
#if defined(__SSE2__) || defined(__ARM_NEON) || BSM_ARCH_SIMD128
constexpr bool kTakesBlocks = true;
#else
constexpr bool kTakesBlocks = false;
#endif
constexpr int32_t kBlock = 16;
constexpr int32_t kAskedColumns = kSpeckleRadius + 1;
constexpr int8_t kAsked[] = {0, -2, 2, -4, 4};  // rows, the nearest first: they agree soonest

// The rows that are asked and lie in the image.
struct AskedRows {
  const uint16_t* row[sizeof kAsked];
  int32_t count;
};

// Levels of one surface are near each other. An invalid level is near none: not even in the arithmetic of 16 bits.
bool is_near(uint16_t level, uint16_t other) {
  return static_cast<uint16_t>(other - level + kSameSurface) <= 2 * kSameSurface && other < kOccluded;
}

// Whether at least `percent` of the asked pixels inside the image are near the level of pixel x.
bool is_supported(const AskedRows& asked, uint16_t level, int32_t x, int32_t width, int32_t percent) {
  int32_t begin = x - kSpeckleRadius;
  int32_t last = x + kSpeckleRadius;
  while (begin < 0) begin += 2;
  while (last >= width) last -= 2;
  int32_t missing = percent * asked.count * ((last - begin) / 2 + 1);  // in 1/100 pixel
  for (int32_t row = 0; row < asked.count && missing > 0; ++row) {
    for (int32_t i = begin; i <= last; i += 2) {
      if (is_near(level, asked.row[row][i])) missing -= 100;
    }
  }
  return missing <= 0;
}

// The same for the pixels from x on, of which all that are asked lie inside the image. Stops when each of them is supported,
// which the first row often shows.
void remove_block(const AskedRows& asked, const uint16_t* levels, int32_t x, int32_t percent, uint16_t* out) {
  const uint16_t least = static_cast<uint16_t>((percent * asked.count * kAskedColumns + 99) / 100);
  uint16_t support[kBlock] = {};
  uint16_t removed[kBlock] = {};
  for (int32_t row = 0; row < asked.count; ++row) {
    for (int32_t dx = -kSpeckleRadius; dx <= kSpeckleRadius; dx += 2) {
      for (int32_t i = 0; i < kBlock; ++i) {
        support[i] = static_cast<uint16_t>(support[i] + (is_near(levels[x + i], asked.row[row][x + dx + i]) ? 1 : 0));
      }
    }
    uint16_t any = 0;
    for (int32_t i = 0; i < kBlock; ++i) {
      removed[i] = static_cast<uint16_t>(support[i] < least && levels[x + i] < kOccluded ? 0xffff : 0);
      any = static_cast<uint16_t>(any | removed[i]);
    }
    if (any == 0) break;
  }
  for (int32_t i = 0; i < kBlock; ++i) out[x + i] = static_cast<uint16_t>(levels[x + i] | removed[i]);
}

}  // namespace

void remove_speckles(const uint16_t* const* rows, int32_t width, int32_t percent, uint16_t* out) {
  const uint16_t* levels = rows[kSpeckleRadius];
  AskedRows asked{};
  for (const int8_t offset : kAsked) {
    const uint16_t* row = rows[kSpeckleRadius + offset];
    if (row != nullptr) asked.row[asked.count++] = row;
  }
  int32_t x = 0;
  while (x < width) {
    if (kTakesBlocks && x >= kSpeckleRadius && x + kBlock + kSpeckleRadius <= width) {
      remove_block(asked, levels, x, percent, out);
      x += kBlock;
    } else {
      const bool removed = levels[x] < kOccluded && !is_supported(asked, levels[x], x, width, percent);
      out[x] = removed ? kNoLevel : levels[x];
      ++x;
    }
  }
}

}  // namespace bsm
