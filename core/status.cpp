// Words for people: status sentences and the version.
#include <stdint.h>

#include "bsm/bsm.h"
#include "simd/build.h"

#define BSM_TEXT_OF(token) #token
#define BSM_VERSION_TEXT(major, minor, patch) BSM_TEXT_OF(major) "." BSM_TEXT_OF(minor) "." BSM_TEXT_OF(patch)

namespace bsm {
namespace {

// The number of every status as text, for builds without text.
constexpr int32_t kFirstStatus = BSM_ERROR_SIGMA;
constexpr int32_t kStatuses = BSM_END - kFirstStatus + 1;

struct Numbers {
  char text[kStatuses][4];
};

constexpr Numbers make_numbers() {
  Numbers numbers{};
  for (int32_t i = 0; i < kStatuses; ++i) {
    const int32_t status = kFirstStatus + i;
    const int32_t magnitude = status < 0 ? -status : status;
    char* end = numbers.text[i];
    if (status < 0) *end++ = '-';
    if (magnitude >= 10) *end++ = static_cast<char>('0' + magnitude / 10);
    *end = static_cast<char>('0' + magnitude % 10);
  }
  return numbers;
}

constexpr Numbers kNumbers = make_numbers();

const char* number_of(int32_t status) {
  return kFirstStatus <= status && status <= BSM_END ? kNumbers.text[status - kFirstStatus] : "unknown status";
}

}  // namespace
}  // namespace bsm

using namespace bsm;

extern "C" const char* bsm_version(void) {
  return BSM_VERSION_TEXT(BSM_VERSION_MAJOR, BSM_VERSION_MINOR, BSM_VERSION_PATCH);
}

extern "C" const char* bsm_status_string(bsm_status status) {
  if (!kHasText) return number_of(status);
  switch (status) {
    case BSM_OK:
      return "done";
    case BSM_NEED_ROWS:
      return "no row is finished yet: push more rows or finish the image";
    case BSM_END:
      return "every row of the image has been pulled";
    case BSM_ERROR_NULL:
      return "a required pointer is null";
    case BSM_ERROR_STRUCT_SIZE:
      return "the configuration was not filled by bsm_config_init of this library version";
    case BSM_ERROR_RESERVED:
      return "a reserved field of the configuration is not zero";
    case BSM_ERROR_PRESET:
      return "the preset is unknown";
    case BSM_ERROR_WIDTH:
      return "the width is not within 1..16384";
    case BSM_ERROR_HEIGHT:
      return "the height is not within 1..16384";
    case BSM_ERROR_MIN_DISPARITY:
      return "the smallest disparity is not within -2047..2046";
    case BSM_ERROR_NUM_DISPARITIES:
      return "the number of disparities is below 1, or the largest disparity above 2046";
    case BSM_ERROR_BITS:
      return "the number of bits is not a multiple of 64 within 64..4096 (sgm: 64..1024)";
    case BSM_ERROR_METHOD:
      return "the method is unknown or was not built";
    case BSM_ERROR_STAGE:
      return "the stage is unknown, not one of the method's or was not built";
    case BSM_ERROR_FORMAT:
      return "the pixel format is unknown or was not built";
    case BSM_ERROR_PATHS:
      return "paths is not 3, 4, 5 or 8";
    case BSM_ERROR_PENALTY:
      return "a penalty is not within 1..16384, or p1 is above p2";
    case BSM_ERROR_EDGE:
      return "edge_threshold is not within 1..255, or edge_divisor not within 1..64";
    case BSM_ERROR_RIGHT_COSTS:
      return "the source of the right view's costs is unknown";
    case BSM_ERROR_SUBPIXEL:
      return "subpixel is neither 0 nor 1";
    case BSM_ERROR_TOLERANCE:
      return "the left/right tolerance is not within 0..255";
    case BSM_ERROR_SPECKLE:
      return "speckle is not within 0..100";
    case BSM_ERROR_BORDER:
      return "border is neither 0 nor 1";
    case BSM_ERROR_VOTE_RADIUS:
      return "the vote radius is not within 1..32";
    case BSM_ERROR_VOTE_STEP:
      return "the vote step is below 1 or does not divide the vote radius";
    case BSM_ERROR_VOTE_COLOR:
      return "the vote's colour scale is not within 1..64";
    case BSM_ERROR_VOTE_DISTANCE:
      return "the vote's distance scale is not within 1..64";
    case BSM_ERROR_VOTE_CAP:
      return "vote_cap is neither 0 nor 1";
    case BSM_ERROR_SMOOTH_RADIUS:
      return "the smoothing radius is not within 1..8";
    case BSM_ERROR_SMOOTH_PASSES:
      return "the number of smoothing passes is not within 0..3";
    case BSM_ERROR_SMOOTH_COLOR:
      return "the smoothing's colour scale is not within 1..64";
    case BSM_ERROR_SMOOTH_DISTANCE:
      return "the smoothing's distance scale is not within 2..64";
    case BSM_ERROR_MEDIAN:
      return "median is neither 0 nor 1";
    case BSM_ERROR_RIGHT_MAP:
      return "right_map is neither 0 nor 1";
    case BSM_ERROR_CONFIDENCE:
      return "confidence is neither 0 nor 1, or was not built";
    case BSM_ERROR_JOBS:
      return "max_jobs is not within 1..64";
    case BSM_ERROR_MEMORY_SIZE:
      return "the configuration needs more memory than this machine can address";
    case BSM_ERROR_ARENA:
      return "the arena is smaller than bsm_memory_required says";
    case BSM_ERROR_CONTEXT:
      return "the pointer is not an open context";
    case BSM_ERROR_SIGMA:
      return "sigma is neither 3 nor 4";
    case BSM_ERROR_STRIDE:
      return "a stride is shorter than a row, so that rows would overlap";
    case BSM_ERROR_ALIGNMENT:
      return "an output pointer or stride is not a multiple of 2 bytes";
    case BSM_ERROR_NO_RIGHT_MAP:
      return "a right map was asked for, but the configuration has right_map = 0";
    case BSM_ERROR_NO_CONFIDENCE:
      return "a confidence map was asked for, but the configuration has confidence = 0";
    case BSM_ERROR_STREAM_OPEN:
      return "rows are in flight: pull them to the end or reset the context";
    case BSM_ERROR_ROW_MODE:
      return "8 paths need the whole frame: process frames, or use fewer paths";
    case BSM_ERROR_ROW_COUNT:
      return "every row of the image has already been pushed";
    case BSM_ERROR_PULL_FIRST:
      return "a finished row waits: pull it before the next push";
    case BSM_ERROR_ISA:
      return "isa_mask leaves no kernels: this build has no scalar ones";
  }
  return "unknown status";
}
