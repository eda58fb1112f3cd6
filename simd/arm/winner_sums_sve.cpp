// winner_sums, SVE: the least of a vector of sums at once, then the first vector that holds it.
// Bound, per vector of levels: 1 load, 1 minimum; 1 load and 1 comparison until the winner is found.
#include "platform/compiler.h"

#if BSM_ARCH_SVE
#include "simd/arm/sve.h"
#include "simd/arm/winner_fraction.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

inline uint16_t least_sum(const uint16_t* sums, int32_t levels) {
  svuint16_t least = svdup_u16(kNoCost);
  for (int32_t level = 0; level < levels; level += lanes16()) {
    const svbool_t those = svwhilelt_b16(level, levels);
    least = svmin_m(those, least, svld1(those, sums + level));
  }
  return svminv(svptrue_b16(), least);
}

// The first level that holds the least sum: one of them does.
inline int32_t find(const uint16_t* sums, int32_t levels, uint16_t least) {
  for (int32_t level = 0;; level += lanes16()) {
    const svbool_t those = svwhilelt_b16(level, levels);
    const svbool_t equal = svcmpeq(those, svld1(those, sums + level), least);
    if (!svptest_any(those, equal)) continue;
    return level + static_cast<int32_t>(svcntp_b16(svptrue_b16(), svbrkb_z(those, equal)));
  }
}

}  // namespace

uint64_t winner_sums_sve_scratch(const KernelShape&) {
  return 0;
}

void winner_sums_sve(const WinnerSumsArgs& args) {
  for (int32_t x = 0; x < args.width; ++x) {
    const uint16_t* sums = args.sum + ptrdiff_t{x} * args.stride;
    const uint16_t least = least_sum(sums, args.num_disparities);
    args.level[x] = kNoLevel;
    if (least == kNoCost) continue;
    args.level[x] = winning_level(args, sums, find(sums, args.num_disparities, least));
  }
}

}  // namespace bsm
#endif
