// The stages of core/ that spare themselves work, as kernels are called, and the same without what they spare.
#ifndef BSM_BENCH_PLAIN_STAGES_H
#define BSM_BENCH_PLAIN_STAGES_H

#include <cstdint>

namespace bsm::bench {

// remove_speckles of core/speckle.h.
struct RemoveSpecklesArgs {
  const uint16_t* const* rows;
  int32_t width;
  int32_t percent;
  uint16_t* out;
};

// fill_holes of core/holes.h.
struct FillHolesArgs {
  const uint16_t* checked;
  const uint16_t* above;
  const uint16_t* voted;
  int32_t width;
  uint16_t* out;  // voted, filled
};

// median_3x3 of core/median.h.
struct MedianArgs {
  const uint16_t* rows[3];
  int32_t width;
  uint16_t* out;
};

void run_stage(const RemoveSpecklesArgs& args);
void run_stage(const FillHolesArgs& args);
void run_stage(const MedianArgs& args);

// remove_speckles, but all neighbours of a pixel are asked.
void speckles_of_all_neighbours(const RemoveSpecklesArgs& args);

// fill_holes, but every pixel looks for its nearest valid ones itself.
void fill_by_pixel(const FillHolesArgs& args);

// median_3x3, but every pixel sorts its neighbourhood.
void median_by_sorting_nine(const MedianArgs& args);

}  // namespace bsm::bench

#endif  // BSM_BENCH_PLAIN_STAGES_H
