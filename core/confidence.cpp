// Confidence of one row.
#include "core/confidence.h"

#include "core/refine.h"

namespace bsm {
namespace {

constexpr int32_t kAgreeing = 24;     // sixteenths within which a neighbour's winner agrees
constexpr int32_t kKept = 16;         // sixteenths within which a pixel's own winner counts as kept
constexpr int32_t kMostMargin = 249;  // where a margin stops to count
constexpr int32_t kAgreementWeight = 1000;
constexpr int32_t kKeptWeight = 500;
constexpr int32_t kMostScore = kAgreementWeight + kKeptWeight + 2 * kMostMargin;

bool near(int32_t a, int32_t b, int32_t most) {
  return a - b <= most && b - a <= most;
}

// Least sum at least two levels away from the winner, less the winner's.
int32_t margin(const uint16_t* sums, int32_t count) {
  int32_t winner = 0;
  for (int32_t level = 1; level < count; ++level) winner = sums[level] < sums[winner] ? level : winner;
  uint16_t second = kNoCost;
  for (int32_t level = 0; level < count; ++level) {
    if ((level < winner - 1 || level > winner + 1) && sums[level] < second) second = sums[level];
  }
  return second - sums[winner];
}

struct Agreement {
  int32_t agreeing, asked;
};

// Neighbours inside the image, and those of them whose valid winner is near the level.
Agreement ask_neighbours(const bsm_context& context, int32_t x, int32_t y, int32_t level) {
  Agreement agreement{0, 0};
  for (int32_t dy = -kConfidenceRadius; dy <= kConfidenceRadius; dy += 2) {
    if (y + dy < 0 || y + dy >= context.height) continue;
    const uint16_t* levels = ring_row<const uint16_t>(context, context.plan.level[kLeft], y + dy);
    const Columns measured = measured_columns(context, kLeft, y + dy);
    for (int32_t i = x - kConfidenceRadius; i <= x + kConfidenceRadius; i += 2) {
      if (i < 0 || i >= context.config.width) continue;
      ++agreement.asked;
      const bool valid = levels[i] < kOccluded && measured.begin <= i && i < measured.end;
      if (valid && near(levels[i], level, kAgreeing)) ++agreement.agreeing;
    }
  }
  return agreement;
}

}  // namespace

void measure_margins(const bsm_context& context, int32_t y) {
  const uint16_t* sums = ring_row<const uint16_t>(context, context.plan.sum, y);
  uint8_t* margins = ring_row<uint8_t>(context, context.plan.margin, y);
  for (int32_t x = 0; x < context.config.width; ++x, sums += context.plan.level_stride) {
    // Scaled to the same fraction of the bits for any length.
    const int32_t scaled = margin(sums, context.config.num_disparities) * 512 / context.config.bits;
    margins[x] = static_cast<uint8_t>(scaled < kMostMargin ? scaled : kMostMargin);
  }
}

void confidence_row(const bsm_context& context, int32_t y, const int16_t* disparity, uint8_t* out) {
  const bsm_config& config = context.config;
  const uint16_t* levels = ring_row<const uint16_t>(context, context.plan.level[kLeft], y);
  const bool has_margins = context.plan.margin.rows != 0;
  const uint8_t* margins = has_margins ? ring_row<const uint8_t>(context, context.plan.margin, y) : nullptr;
  const Columns measured = measured_columns(context, kLeft, y);
  const int32_t invalid = bsm_invalid_disparity(&config);
  for (int32_t x = 0; x < config.width; ++x) {
    out[x] = 0;
    if (disparity[x] == invalid) continue;
    const int32_t level = disparity[x] - config.min_disparity * BSM_DISPARITY_SCALE;
    const Agreement agreement = ask_neighbours(context, x, y, level);
    int32_t score = kAgreementWeight * agreement.agreeing / agreement.asked;
    const bool valid = levels[x] < kOccluded && measured.begin <= x && x < measured.end;
    if (valid && near(levels[x], level, kKept)) score += kKeptWeight;
    if (has_margins) score += 2 * margins[x];
    out[x] = static_cast<uint8_t>(score * 255 / kMostScore);
  }
}

}  // namespace bsm
