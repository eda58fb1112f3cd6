// test_tables.cpp - the tables and fixed-point arithmetic against doubles: CIELAB of every colour, luma, the weights of the
// vote, and the pair pattern with its distribution.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <tuple>
#include <vector>

#include "bsm/bsm.h"
#include "check.h"
#include "core/pattern.h"
#include "core/weights.h"
#include "simd/kernels.h"
#include "simd/lab.h"
#include "simd/yuv.h"

using namespace bsm::test;

namespace {

// The stored format: one unit is 0.8 CIELAB, a and b are shifted to be positive.
constexpr double kUnit = 0.8;
constexpr double kOffsetA = 108, kOffsetB = 135;

// What rounding alone reaches is half a unit. Fixed point adds at most this: colours whose exact value lies this close to
// the middle between two units may be rounded to the farther one.
constexpr double kErrorBound = 0.5 + 0.02;

// Steps of the exponent per factor of e.
constexpr double kVoteSteps = 64;
constexpr double kSmoothSteps = 16;

// The pair patterns.
struct PatternKind {
  const char* name;
  bsm::Pattern (*make)(int32_t bits, bsm::PixelPair* pairs);
  int bits;  // of the longest descriptor
  double sigma;
};
constexpr PatternKind kPatterns[] = {{"local", bsm::local_pattern, BSM_MAX_BITS, 4},
                                     {"narrow", bsm::narrow_pattern, BSM_MAX_BITS, 3},
                                     {"sgm", bsm::sgm_pattern, BSM_MAX_SGM_BITS, 2.5}};

bsm::Pattern make_pattern(const PatternKind& kind, int bits, std::vector<bsm::PixelPair>* pairs) {
  pairs->resize(static_cast<size_t>(bits));
  bsm::Pattern pattern = kind.make(bits, pairs->data());
  if (pattern.pairs != pairs->data()) std::copy_n(pattern.pairs, bits, pairs->begin());
  pattern.pairs = pairs->data();
  return pattern;
}

double linear_light(int value) {
  const double c = value / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double lab_curve(double t) {
  return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
}

struct ExactLab {
  double l, a, b;
};

// Cube roots of 2^24 colours take seconds; the curve is tabulated once, finely enough that interpolation adds less than
// 1e-6.
class ExactCurve {
 public:
  ExactCurve() : table_(kCount + 2) {
    for (size_t i = 0; i < table_.size(); ++i) table_[i] = lab_curve(static_cast<double>(i) / kCount);
  }
  double operator()(double t) const {
    if (t < 0.02) return lab_curve(t);
    const double position = t * kCount;
    const size_t i = static_cast<size_t>(position);
    return table_[i] + (table_[i + 1] - table_[i]) * (position - static_cast<double>(i));
  }

 private:
  static constexpr size_t kCount = 1 << 16;
  std::vector<double> table_;
};

// sRGB primaries and D65 white, each row divided by its white so that grays have a = b = 0.
struct Matrix {
  double row[3][3];
};
constexpr Matrix kFromRgb = {
    {{0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}}};

template <typename Curve>
ExactLab exact_lab(const double linear[3], const Curve& curve) {
  double f[3];
  for (int i = 0; i < 3; ++i) {
    const double* m = kFromRgb.row[i];
    f[i] = curve((m[0] * linear[0] + m[1] * linear[1] + m[2] * linear[2]) / (m[0] + m[1] + m[2]));
  }
  return {(116 * f[1] - 16) / kUnit, 500 * (f[0] - f[1]) / kUnit + kOffsetA, 200 * (f[1] - f[2]) / kUnit + kOffsetB};
}

}  // namespace

TEST_CASE(lab_of_every_color) {
  const ExactCurve curve;
  std::array<double, 256> linear{};
  for (int i = 0; i < 256; ++i) linear[static_cast<size_t>(i)] = linear_light(i);
  // A build that runs slowly looks at every fifth green; the full set is looked at in optimized builds.
  const int step = repeats(100) >= 100 ? 1 : 5;
  double worst = 0;
  int worst_color[3] = {};
  std::array<double, 3> worst_channel{};
  int least[3] = {255, 255, 255}, most[3] = {0, 0, 0};
  for (int r = 0; r < 256; ++r) {
    for (int g = 0; g < 256; g += step) {
      for (int b = 0; b < 256; ++b) {
        const double light[3] = {linear[static_cast<size_t>(r)], linear[static_cast<size_t>(g)],
                                 linear[static_cast<size_t>(b)]};
        const ExactLab exact = exact_lab(light, curve);
        const bsm::Lab lab = bsm::lab_from_rgb(static_cast<uint8_t>(r), static_cast<uint8_t>(g), static_cast<uint8_t>(b));
        const double error[3] = {std::fabs(lab.l - exact.l), std::fabs(lab.a - exact.a), std::fabs(lab.b - exact.b)};
        const int stored[3] = {lab.l, lab.a, lab.b};
        for (size_t i = 0; i < 3; ++i) {
          worst_channel[i] = std::max(worst_channel[i], error[i]);
          least[i] = std::min(least[i], stored[i]);
          most[i] = std::max(most[i], stored[i]);
          if (error[i] > worst) worst = error[i], worst_color[0] = r, worst_color[1] = g, worst_color[2] = b;
        }
      }
    }
  }
  std::printf("  largest CIELAB error over %s: %.4f units of %.1f (L %.4f, a %.4f, b %.4f), at R G B = %d %d %d\n",
              step == 1 ? "all 2^24 colours" : "a fifth of all colours", worst, kUnit, worst_channel[0], worst_channel[1],
              worst_channel[2], worst_color[0], worst_color[1], worst_color[2]);
  std::printf("  stored L %d..%d, a %d..%d, b %d..%d\n", least[0], most[0], least[1], most[1], least[2], most[2]);
  CHECK_LE(worst, kErrorBound);
  CHECK(worst > 0.4);  // the reference is another computation, not a copy
  // Nothing wraps: the stored range stays off the ends of a byte, and L uses it from 0.
  CHECK_EQ(least[0], 0);
  CHECK_EQ(most[0], 125);
}

TEST_CASE(lab_of_grays_has_no_color) {
  int before = -1;
  for (int v = 0; v < 256; ++v) {
    const uint8_t value = static_cast<uint8_t>(v);
    const bsm::Lab lab = bsm::lab_from_rgb(value, value, value);
    CHECK_EQ(lab.a, static_cast<int>(kOffsetA));
    CHECK_EQ(lab.b, static_cast<int>(kOffsetB));
    CHECK_EQ(lab.l, bsm::lab_l_from_gray(value));
    CHECK(lab.l >= before);
    before = lab.l;
  }
  CHECK_EQ(before, 125);
}

TEST_CASE(interpolated_reference_is_exact_enough) {
  const ExactCurve curve;
  Rng rng(seed());
  for (int i = 0; i < 100000; ++i) {
    const double t = static_cast<double>(rng.next() >> 11) / 9007199254740992.0;
    CHECK(std::fabs(curve(t) - lab_curve(t)) * 500 / kUnit < 1e-4);
  }
}

TEST_CASE(luma_is_the_undivided_sum) {
  for (int r = 0; r < 256; r += 3) {
    for (int g = 0; g < 256; g += 3) {
      for (int b = 0; b < 256; b += 3) {
        const int expected = 76 * r + 150 * g + 29 * b;
        CHECK_EQ(bsm::luma_from_rgb(static_cast<uint8_t>(r), static_cast<uint8_t>(g), static_cast<uint8_t>(b)), expected);
      }
    }
  }
  CHECK_EQ(bsm::luma_from_rgb(255, 255, 255), 65025);
}

TEST_CASE(rgb_of_every_yuv_color) {
  const int step = repeats(100) >= 100 ? 1 : 5;
  double worst = 0;
  for (int u = 0; u < 256; ++u) {
    for (int v = 0; v < 256; v += step) {
      // BT.601: R weighs 0.299 of Y and B 0.114; B - Y is 1.772 (U - 128), R - Y is 1.402 (V - 128).
      const double red = 2 * (1 - 0.299) * (v - 128), blue = 2 * (1 - 0.114) * (u - 128);
      const double exact[3] = {red, -(0.299 * red + 0.114 * blue) / 0.587, blue};
      const bsm::ChromaTerms terms = bsm::chroma_terms(static_cast<uint8_t>(u), static_cast<uint8_t>(v));
      for (int y = 0; y < 256; ++y) {
        const uint8_t luma = static_cast<uint8_t>(y);
        const int channels[3] = {bsm::channel_from_yuv(luma, terms.r), bsm::channel_from_yuv(luma, terms.g),
                                 bsm::channel_from_yuv(luma, terms.b)};
        for (int c = 0; c < 3; ++c) worst = std::max(worst, std::fabs(channels[c] - std::clamp(y + exact[c], 0.0, 255.0)));
      }
    }
  }
  std::printf("  largest RGB error: %.5f\n", worst);
  CHECK_LE(worst, 0.5 + 0.001);
  for (int y = 0; y < 256; ++y) {
    const bsm::ChromaTerms none = bsm::chroma_terms(128, 128);
    for (const int32_t term : {none.r, none.g, none.b}) CHECK_EQ(bsm::channel_from_yuv(static_cast<uint8_t>(y), term), y);
    CHECK_EQ(bsm::luma_from_y(static_cast<uint8_t>(y)),
             bsm::luma_from_rgb(static_cast<uint8_t>(y), static_cast<uint8_t>(y), static_cast<uint8_t>(y)));
  }
}

TEST_CASE(vote_weights_are_exponentials) {
  for (int i = 0; i < bsm::VoteWeights::kCount; ++i) {
    const Scope scope("step " + text_of(i));
    CHECK_LE(std::fabs(bsm::kVoteWeights.weight[i] - 65535 * std::exp(-i / kVoteSteps)), 1.0);
  }
  CHECK_LE(65535 * std::exp(-bsm::VoteWeights::kCount / kVoteSteps), 1.5);  // what is left out
}

TEST_CASE(vote_distance_steps_are_rounded_distances) {
  for (int divisor = 1; divisor <= 64; ++divisor) {
    for (int dy = 0; dy <= BSM_MAX_VOTE_RADIUS; ++dy) {
      for (int dx = 0; dx <= BSM_MAX_VOTE_RADIUS; ++dx) {
        const double exact = kVoteSteps * std::sqrt(dx * dx + dy * dy) / divisor;
        const Scope scope("dx = " + text_of(dx) + ", dy = " + text_of(dy) + ", divisor " + text_of(divisor));
        // Lengths are in 1/256 pixel, rounded down: a quarter of a step at divisor 1.
        CHECK_LE(std::fabs(bsm::vote_distance_steps(dx, dy, divisor) - exact), 0.5 + 0.25 / divisor);
      }
    }
  }
}

TEST_CASE(vote_color_scale_is_the_exponent) {
  for (int divisor = 1; divisor <= 64; ++divisor) {
    for (int sad = 0; sad <= bsm::kMaxSad; ++sad) {
      const uint64_t steps = (uint64_t{bsm::vote_color_scale(divisor)} * static_cast<uint64_t>(sad) + 512) >> 10;
      const double exact = kVoteSteps * sad * kUnit / divisor;
      const Scope scope("SAD " + text_of(sad) + ", divisor " + text_of(divisor));
      CHECK_LE(std::fabs(static_cast<double>(steps) - exact), 0.5 + 0.7 * sad / 1024 + 1e-9);
    }
  }
}

TEST_CASE(smooth_weights_are_exponentials) {
  int total = 0;
  for (int i = 0; i < 128; ++i) {
    const Scope scope("step " + text_of(i));
    CHECK_LE(std::fabs(bsm::kSmoothWeights.weight[i] - 255 * std::exp(-i / kSmoothSteps)), 0.51);
  }
  for (int divisor = 2; divisor <= 64; ++divisor) {
    total = 0;
    for (int dy = -BSM_MAX_SMOOTH_RADIUS; dy <= BSM_MAX_SMOOTH_RADIUS; ++dy) {
      for (int dx = -BSM_MAX_SMOOTH_RADIUS; dx <= BSM_MAX_SMOOTH_RADIUS; ++dx) {
        const double exact = std::fmin(127, kSmoothSteps * std::sqrt(dx * dx + dy * dy) / divisor);
        const int steps = bsm::smooth_distance_steps(std::abs(dx), std::abs(dy), divisor);
        const Scope scope("dx = " + text_of(dx) + ", dy = " + text_of(dy) + ", divisor " + text_of(divisor));
        CHECK_LE(std::fabs(steps - exact), 0.6);
        if ((dx + dy) % 2 == 0) total += bsm::kSmoothWeights.weight[steps];
      }
    }
    CHECK_LE(total, 65535);  // the weights of a window fit 16 bits
  }
  for (int divisor = 1; divisor <= 64; ++divisor) {
    for (int sad = 0; sad <= 255; ++sad) {
      const double steps = static_cast<double>((static_cast<uint32_t>(sad) * bsm::smooth_color_scale(divisor)) >> 8);
      const Scope scope("SAD " + text_of(sad) + ", divisor " + text_of(divisor));
      CHECK_LE(std::fabs(steps - kSmoothSteps * sad * kUnit / divisor), 1.0 + 0.5 * sad / 256);
    }
  }
}

TEST_CASE(pattern_stays_in_the_window) {
  for (const PatternKind& kind : kPatterns) {
    const Scope scope(kind.name);
    std::vector<bsm::PixelPair> pairs;
    const bsm::Pattern pattern = make_pattern(kind, kind.bits, &pairs);
    CHECK_EQ(pattern.bits, kind.bits);
    CHECK(pattern.radius <= bsm::kMaxPatternRadius);
    CHECK_LE(2 * pattern.radius + 1, 26);  // the paper's S
    int reach = 0;
    for (int i = 0; i < pattern.bits; ++i) {
      const bsm::PixelPair& p = pattern.pairs[i];
      for (const int v : {p.px, p.py, p.qx, p.qy}) reach = std::max(reach, std::abs(v));
      CHECK(p.px != p.qx || p.py != p.qy);
    }
    CHECK_EQ(reach, pattern.radius);  // the stated radius is no larger than needed
  }
}

TEST_CASE(pattern_is_nested) {
  for (const PatternKind& kind : kPatterns) {
    const Scope scope(kind.name);
    std::vector<bsm::PixelPair> full_pairs, pairs;
    const bsm::Pattern full = make_pattern(kind, kind.bits, &full_pairs);
    for (int bits = BSM_MIN_BITS; bits <= kind.bits; bits += 64) {
      const bsm::Pattern prefix = make_pattern(kind, bits, &pairs);
      CHECK_EQ(prefix.bits, bits);
      CHECK(prefix.radius <= full.radius);
      for (int i = 0; i < bits; ++i) {
        const bsm::PixelPair &a = prefix.pairs[i], &b = full.pairs[i];
        CHECK(a.px == b.px && a.py == b.py && a.qx == b.qx && a.qy == b.qy);
      }
    }
  }
}

// Each coordinate is a Gaussian truncated toward zero and cut at the window: checked by chi-square, by the moments and by
// the independence of the four coordinates. Bounds are five standard deviations and more: the pairs are fixed, so that the
// case passes for good or fails for good.
static void check_gaussian(const PatternKind& kind, int bits) {
  const Scope scope(std::string(kind.name) + ", " + text_of(bits) + " pairs");
  std::vector<bsm::PixelPair> pairs;
  const bsm::Pattern pattern = make_pattern(kind, bits, &pairs);
  const auto phi = [&kind](double t) { return std::erf(t / kind.sigma / std::sqrt(2.0)); };  // P(|X| < t)
  const int radius = pattern.radius;
  std::vector<double> expected(static_cast<size_t>(radius) + 1);
  double variance = 0;
  for (int k = 0; k <= radius; ++k) {
    expected[static_cast<size_t>(k)] = (phi(k + 1) - phi(k)) / phi(radius + 1);
    variance += expected[static_cast<size_t>(k)] * k * k;
  }
  std::vector<int> count(static_cast<size_t>(radius) + 1);
  double sum = 0, squares = 0, product[4][4] = {};
  int positive = 0, nonzero = 0;
  for (int i = 0; i < bits; ++i) {
    const bsm::PixelPair& p = pattern.pairs[i];
    const int v[4] = {p.px, p.py, p.qx, p.qy};
    for (int j = 0; j < 4; ++j) {
      ++count[static_cast<size_t>(std::abs(v[j]))];
      sum += v[j];
      squares += v[j] * v[j];
      positive += v[j] > 0;
      nonzero += v[j] != 0;
      for (int k = 0; k < j; ++k) product[j][k] += v[j] * v[k];
    }
  }
  const double samples = 4.0 * bits;
  double chi_square = 0;
  for (size_t k = 0; k < count.size(); ++k) {
    const double e = expected[k] * samples;
    chi_square += (count[k] - e) * (count[k] - e) / e;
  }
  std::printf("  %s, %d pairs: variance %.3f (Gaussian %.3f), chi-square %.1f with %d degrees of freedom\n", kind.name, bits,
              squares / samples, variance, chi_square, radius);
  CHECK_LE(chi_square, radius + 5 * std::sqrt(2.0 * radius));
  CHECK_LE(std::fabs(squares / samples / variance - 1), 5 * std::sqrt(2.0 / samples));
  CHECK_LE(std::fabs(sum / samples), 5 * std::sqrt(variance / samples));
  CHECK_LE(std::fabs(positive - nonzero / 2.0), 2.5 * std::sqrt(nonzero));
  for (int j = 0; j < 4; ++j) {
    for (int k = 0; k < j; ++k)
      CHECK_LE(std::fabs(product[j][k] / bits / variance), 5 / std::sqrt(static_cast<double>(bits)));
  }
}

TEST_CASE(pattern_is_gaussian) {
  for (const PatternKind& kind : kPatterns) {
    for (const int bits : {kind.bits / 4, kind.bits}) check_gaussian(kind, bits);
  }
}

// Pairs are drawn independently, so that near the centre some come twice. A pair and its reverse carry the same information.
static int repeated_pairs(const std::vector<bsm::PixelPair>& pairs) {
  std::set<std::tuple<int, int, int, int>> seen;
  int repeated = 0;
  for (const bsm::PixelPair& p : pairs) {
    const std::tuple<int, int, int, int> forward{p.px, p.py, p.qx, p.qy}, reverse{p.qx, p.qy, p.px, p.py};
    repeated += !seen.insert(std::min(forward, reverse)).second;
  }
  return repeated;
}

TEST_CASE(pattern_repeats_pairs_no_more_than_chance) {
  Rng rng(seed());
  for (const PatternKind& kind : kPatterns) {
    std::vector<bsm::PixelPair> pairs;
    const bsm::Pattern pattern = make_pattern(kind, kind.bits, &pairs);
    const int repeated = repeated_pairs(pairs);
    // The same draw with another generator, many times.
    const auto offset = [&] {
      for (;;) {
        double sum = 0;  // twelve uniform numbers are near enough to a Gaussian
        for (int i = 0; i < 12; ++i) sum += rng.range(0, 65535) / 65536.0;
        const int v = static_cast<int>((sum - 6) * kind.sigma);
        if (std::abs(v) <= pattern.radius) return static_cast<int8_t>(v);
      }
    };
    constexpr int kDraws = 20;
    double mean = 0;
    for (int draw = 0; draw < kDraws; ++draw) {
      std::vector<bsm::PixelPair> drawn;
      while (drawn.size() < static_cast<size_t>(kind.bits)) {
        const bsm::PixelPair p{offset(), offset(), offset(), offset()};
        if (p.px != p.qx || p.py != p.qy) drawn.push_back(p);
      }
      mean += repeated_pairs(drawn) / double{kDraws};
    }
    std::printf("  %s: %d of %d pairs repeat an earlier one; %.0f by chance\n", kind.name, repeated, pattern.bits, mean);
    CHECK_LE(repeated, mean * 1.25);
  }
}
