// Runs the library on a pair.
#include "bench/match_pair.h"

#include <utility>

#include "host/config_options.h"
#include "host/run_match.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

// Takes the confidence map where the result has one.
template <typename Result>
auto take_confidence(Result& result, Match* match, int) -> decltype(void(result.confidence)) {
  match->confidence = std::move(result.confidence);
}
template <typename Result>
void take_confidence(Result&, Match*, long) {}

}  // namespace

bool match_pair(const Pair& pair, const bsm_config& config, int32_t repeat, Match* match, std::string* error) {
  host::MatchRequest request;
  request.left = &pair.left;
  request.right = &pair.right;
  request.config = config;
  request.repeat = repeat;
  host::MatchResult result;
  bsm_status status = BSM_OK;
  if (!host::run_match(request, &result, &status)) {
    *error = pair.name + ": " +
             (status == BSM_ERROR_ARENA
                  ? host::text("cannot allocate %zu bytes; fewer threads, disparities or bits need less", result.arena_bytes)
                  : host::config_error(status));
    return false;
  }
  match->config = result.config;
  match->map = host::disparity_map(result.disparity.data(), result.config.width, result.config.height,
                                   bsm_invalid_disparity(&result.config));
  match->values = std::move(result.disparity);
  match->ms_min = result.fastest();
  match->ms_median = result.median();
  match->arena_bytes = result.arena_bytes;
  take_confidence(result, match, 0);
  return true;
}

}  // namespace bsm::bench
