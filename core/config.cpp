// Defaults and limits of a configuration.
#include "core/config.h"

#include <stddef.h>

#include "platform/compiler.h"
#include "simd/build.h"

namespace bsm {
namespace {

bool within(int32_t value, int32_t least, int32_t most) {
  return least <= value && value <= most;
}

// A field whose range depends on no other field.
struct Range {
  uint8_t field;  // its place, in words
  int8_t refused;
  int16_t least, most;
};

#define BSM_RANGE(field, least, most, refused)                                                \
  Range {                                                                                     \
    static_cast<uint8_t>(offsetof(bsm_config, field) / sizeof(int32_t)), refused, least, most \
  }
constexpr Range kRanges[] = {
    BSM_RANGE(width, 1, BSM_MAX_SIZE, BSM_ERROR_WIDTH),
    BSM_RANGE(height, 1, BSM_MAX_SIZE, BSM_ERROR_HEIGHT),
    BSM_RANGE(min_disparity, BSM_MIN_DISPARITY, BSM_MAX_DISPARITY, BSM_ERROR_MIN_DISPARITY),
    BSM_RANGE(method, kHasLocal ? BSM_METHOD_LOCAL : BSM_METHOD_SGM, kHasSgm ? BSM_METHOD_SGM : BSM_METHOD_LOCAL,
              BSM_ERROR_METHOD),
    BSM_RANGE(sigma, 3, 4, BSM_ERROR_SIGMA),
    // The stages before the aggregation are the local method's.
    BSM_RANGE(stage, kHasLocal ? BSM_STAGE_COST : BSM_STAGE_AGGREGATED,
              kHasRefinement ? BSM_STAGE_REFINED : BSM_STAGE_CHECKED, BSM_ERROR_STAGE),
    BSM_RANGE(format, BSM_FORMAT_GRAY8, kHasColor ? BSM_FORMAT_YUYV : BSM_FORMAT_GRAY8, BSM_ERROR_FORMAT),
    BSM_RANGE(p1, 1, 16384, BSM_ERROR_PENALTY),
    BSM_RANGE(p2, 1, 16384, BSM_ERROR_PENALTY),
    BSM_RANGE(edge_threshold, 1, 255, BSM_ERROR_EDGE),
    BSM_RANGE(edge_divisor, 1, 64, BSM_ERROR_EDGE),
    BSM_RANGE(right_costs, BSM_RIGHT_COSTS_OWN, BSM_RIGHT_COSTS_LEFT, BSM_ERROR_RIGHT_COSTS),
    BSM_RANGE(subpixel, 0, 1, BSM_ERROR_SUBPIXEL),
    BSM_RANGE(lr_tolerance, 0, 255, BSM_ERROR_TOLERANCE),
    BSM_RANGE(speckle, 0, 100, BSM_ERROR_SPECKLE),
    BSM_RANGE(border, 0, 1, BSM_ERROR_BORDER),
    BSM_RANGE(vote_radius, 1, BSM_MAX_VOTE_RADIUS, BSM_ERROR_VOTE_RADIUS),
    BSM_RANGE(vote_step, 1, BSM_MAX_VOTE_RADIUS, BSM_ERROR_VOTE_STEP),
    BSM_RANGE(vote_color, 1, 64, BSM_ERROR_VOTE_COLOR),
    BSM_RANGE(vote_distance, 1, 64, BSM_ERROR_VOTE_DISTANCE),
    BSM_RANGE(vote_cap, 0, 1, BSM_ERROR_VOTE_CAP),
    BSM_RANGE(smooth_radius, 1, BSM_MAX_SMOOTH_RADIUS, BSM_ERROR_SMOOTH_RADIUS),
    BSM_RANGE(smooth_passes, 0, BSM_MAX_SMOOTH_PASSES, BSM_ERROR_SMOOTH_PASSES),
    BSM_RANGE(smooth_color, 1, 64, BSM_ERROR_SMOOTH_COLOR),
    BSM_RANGE(smooth_distance, 2, 64, BSM_ERROR_SMOOTH_DISTANCE),
    BSM_RANGE(median, 0, 1, BSM_ERROR_MEDIAN),
    BSM_RANGE(right_map, 0, 1, BSM_ERROR_RIGHT_MAP),
    BSM_RANGE(confidence, 0, kHasConfidence ? 1 : 0, BSM_ERROR_CONFIDENCE),
    BSM_RANGE(max_jobs, 1, BSM_MAX_JOBS, BSM_ERROR_JOBS),
};
#undef BSM_RANGE

}  // namespace

int32_t chroma_row_bytes(const bsm_config& config) {
  return config.width + (config.width & 1);
}

int32_t row_bytes(const bsm_config& config) {
  if (!kHasColor) return config.width;
  switch (config.format) {
    case BSM_FORMAT_GRAY8:
    case BSM_FORMAT_NV12:
    case BSM_FORMAT_NV21:
      return config.width;
    case BSM_FORMAT_RGB565:
      return 2 * config.width;
    case BSM_FORMAT_YUYV:
      return 2 * (config.width + (config.width & 1));
    case BSM_FORMAT_RGB24:
    case BSM_FORMAT_BGR24:
      return 3 * config.width;
    default:
      return 4 * config.width;
  }
}

bsm_status validate_config(const bsm_config* config) {
  if (config == nullptr) return BSM_ERROR_NULL;
  if (config->struct_size != sizeof(bsm_config)) return BSM_ERROR_STRUCT_SIZE;
  for (const uint32_t reserved : config->reserved) {
    if (reserved != 0) return BSM_ERROR_RESERVED;
  }
  for (const Range& range : kRanges) {
    int32_t value;
    BSM_MEMCPY(&value, reinterpret_cast<const uint8_t*>(config) + sizeof value * range.field, sizeof value);
    if (!within(value, range.least, range.most)) return static_cast<bsm_status>(range.refused);
  }
  if (!within(config->num_disparities, 1, BSM_MAX_DISPARITY - config->min_disparity + 1)) return BSM_ERROR_NUM_DISPARITIES;
  const bool sgm = config->method == BSM_METHOD_SGM;
  const int32_t most_bits = sgm ? BSM_MAX_SGM_BITS : BSM_MAX_BITS;
  if (!within(config->bits, BSM_MIN_BITS, most_bits) || config->bits % BSM_MIN_BITS != 0) return BSM_ERROR_BITS;
  if (config->stage == BSM_STAGE_AGGREGATED && !sgm) return BSM_ERROR_STAGE;
  if (!within(config->paths, 3, 5) && config->paths != 8) return BSM_ERROR_PATHS;
  if (config->p1 > config->p2) return BSM_ERROR_PENALTY;
  if (config->vote_radius % config->vote_step != 0) return BSM_ERROR_VOTE_STEP;
  return BSM_OK;
}

}  // namespace bsm

extern "C" bsm_status bsm_config_init(bsm_config* config, int32_t width, int32_t height) {
  if (config == nullptr) return BSM_ERROR_NULL;
  BSM_MEMSET(config, 0, sizeof *config);
  config->struct_size = sizeof *config;
  config->width = width;
  config->height = height;
  config->format = BSM_FORMAT_RGB24;
  config->num_disparities = 64;
  config->stage = BSM_STAGE_REFINED;
  config->max_jobs = 1;
  config->isa_mask = BSM_ISA_ALL;
  return bsm_config_preset(config, BSM_PRESET_BALANCED);
}

extern "C" bsm_status bsm_config_preset(bsm_config* config, bsm_preset preset) {
  if (config == nullptr) return BSM_ERROR_NULL;
  if (preset < BSM_PRESET_PAPER || preset > BSM_PRESET_LOCAL) return BSM_ERROR_PRESET;
  const bool paper = preset == BSM_PRESET_PAPER;
  const bool local = bsm::kHasLocal && preset == BSM_PRESET_LOCAL;
  config->method = paper || local ? BSM_METHOD_LOCAL : BSM_METHOD_SGM;
  switch (preset) {
    case BSM_PRESET_FAST:
      config->bits = 128;
      break;
    case BSM_PRESET_BALANCED:
    case BSM_PRESET_LOCAL:
      config->bits = 256;
      break;
    case BSM_PRESET_BEST:
      config->bits = BSM_MAX_SGM_BITS;
      break;
    default:
      config->bits = BSM_MAX_BITS;
  }
  config->sigma = paper ? 4 : 3;
  config->paths = preset == BSM_PRESET_BEST ? 8 : 4;
  // One set for each method, whatever the length and the paths. Luma alone tells less: sgm weighs its differences more, and
  // jumps cost more.
  const bool gray = !paper && !local && config->format == BSM_FORMAT_GRAY8;
  config->p1 = gray ? 125 : 80;
  config->p2 = gray ? 700 : 650;
  config->edge_threshold = gray ? 13 : 24;
  config->edge_divisor = 12;
  config->right_costs = BSM_RIGHT_COSTS_OWN;
  config->subpixel = paper ? 0 : 1;
  config->lr_tolerance = 1;
  // Drops what agrees by chance: with masked costs alone, and with sums where the views differ in exposure.
  config->speckle = paper ? 0 : local ? 10 : 16;
  config->border = paper ? 0 : 1;
  config->vote_radius = 24;
  config->vote_step = paper ? 1 : 6;
  config->vote_color = paper ? 9 : local ? 2 : gray ? 3 : 4;
  config->vote_distance = paper ? 16 : local || gray ? 8 : 12;  // more holes to fill: the vote keeps closer to its pixel
  config->vote_cap = paper ? 0 : 1;
  config->smooth_radius = 4;
  config->smooth_passes = paper ? 0 : local ? 2 : 3;
  config->smooth_color = local ? 6 : gray ? 3 : 7;
  config->smooth_distance = local ? 7 : gray ? 9 : 12;
  config->median = 1;
  return BSM_OK;
}

extern "C" int16_t bsm_invalid_disparity(const bsm_config* config) {
  return static_cast<int16_t>((config->min_disparity - 1) * BSM_DISPARITY_SCALE);
}
