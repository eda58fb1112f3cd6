// The command-line options that fill a bsm_config.
#include "host/config_options.h"

#include "host/text.h"

namespace bsm::host {
namespace {

constexpr int32_t kFeatureBits = 32;

constexpr Choice kMethods[] = {{"local", BSM_METHOD_LOCAL}, {"sgm", BSM_METHOD_SGM}};
constexpr Choice kPresets[] = {{"paper", BSM_PRESET_PAPER},
                               {"fast", BSM_PRESET_FAST},
                               {"balanced", BSM_PRESET_BALANCED},
                               {"best", BSM_PRESET_BEST},
                               {"local", BSM_PRESET_LOCAL}};
constexpr Choice kRightCosts[] = {{"own", BSM_RIGHT_COSTS_OWN}, {"left", BSM_RIGHT_COSTS_LEFT}};
constexpr Choice kStages[] = {{"cost", BSM_STAGE_COST},
                              {"masked", BSM_STAGE_MASKED},
                              {"aggregated", BSM_STAGE_AGGREGATED},
                              {"checked", BSM_STAGE_CHECKED},
                              {"refined", BSM_STAGE_REFINED}};
constexpr Choice kFormats[] = {{"gray8", BSM_FORMAT_GRAY8},   {"rgb24", BSM_FORMAT_RGB24},   {"bgr24", BSM_FORMAT_BGR24},
                               {"rgba32", BSM_FORMAT_RGBA32}, {"bgra32", BSM_FORMAT_BGRA32}, {"rgb565", BSM_FORMAT_RGB565},
                               {"nv12", BSM_FORMAT_NV12},     {"nv21", BSM_FORMAT_NV21},     {"yuyv", BSM_FORMAT_YUYV}};

template <size_t size>
std::vector<Choice> all_of(const Choice (&choices)[size]) {
  return std::vector<Choice>(choices, choices + size);
}

template <size_t size>
const char* name_of(const Choice (&choices)[size], int32_t value) {
  for (const Choice& choice : choices) {
    if (choice.value == value) return choice.name;
  }
  return "unknown";
}

// An option of one number that a preset sets and the command line may set again.
struct PresetField {
  const char* option;
  const char* value_name;
  int32_t bsm_config::*field;
  int32_t least, most;
  bsm_status refused;
  const char* help;
};

constexpr PresetField kPresetFields[] = {
    {"--bits", "n", &bsm_config::bits, BSM_MIN_BITS, BSM_MAX_BITS, BSM_ERROR_BITS,
     "descriptor length, a multiple of 64; sgm at most 1024"},
    {"--sigma", "S", &bsm_config::sigma, 3, 4, BSM_ERROR_SIGMA, "local: spread of the pattern, pixels; the paper has 4"},
    {"--paths", "P", &bsm_config::paths, 3, 8, BSM_ERROR_PATHS,
     "sgm: 3, 4 or 5 paths of one pass from the top, or 8 over the whole frame"},
    {"--p1", "C", &bsm_config::p1, 1, 16384, BSM_ERROR_PENALTY, "sgm: penalty of a change by one level, at 4096 bits"},
    {"--p2", "C", &bsm_config::p2, 1, 16384, BSM_ERROR_PENALTY, "sgm: penalty of a larger change, at 4096 bits"},
    {"--edge-threshold", "C", &bsm_config::edge_threshold, 1, 255, BSM_ERROR_EDGE,
     "sgm: colour difference that is an edge, in 0.8 CIELAB"},
    {"--edge-divisor", "K", &bsm_config::edge_divisor, 1, 64, BSM_ERROR_EDGE, "sgm: penalties are divided by it at edges"},
    {"--subpixel", "0|1", &bsm_config::subpixel, 0, 1, BSM_ERROR_SUBPIXEL, "sgm: fractions of a pixel"},
    {"--lr-tolerance", "P", &bsm_config::lr_tolerance, 0, 255, BSM_ERROR_TOLERANCE,
     "largest difference of both views that agrees, pixels"},
    {"--speckle", "P", &bsm_config::speckle, 0, 100, BSM_ERROR_SPECKLE,
     "percentage of near pixels that must agree, 0 for no speckle filter"},
    {"--border", "0|1", &bsm_config::border, 0, 1, BSM_ERROR_BORDER,
     "continue surfaces into the band that one view alone shows"},
    {"--vote-radius", "R", &bsm_config::vote_radius, 1, BSM_MAX_VOTE_RADIUS, BSM_ERROR_VOTE_RADIUS,
     "half side of the voting window, pixels"},
    {"--vote-step", "P", &bsm_config::vote_step, 1, BSM_MAX_VOTE_RADIUS, BSM_ERROR_VOTE_STEP,
     "every P-th pixel of the window votes"},
    {"--vote-color", "C", &bsm_config::vote_color, 1, 64, BSM_ERROR_VOTE_COLOR, "colour distance that divides a vote by e"},
    {"--vote-distance", "E", &bsm_config::vote_distance, 1, 64, BSM_ERROR_VOTE_DISTANCE,
     "distance in pixels that divides a vote by e"},
    {"--vote-cap", "0|1", &bsm_config::vote_cap, 0, 1, BSM_ERROR_VOTE_CAP, "occlusions take the farther surface"},
    {"--smooth-radius", "R", &bsm_config::smooth_radius, 1, BSM_MAX_SMOOTH_RADIUS, BSM_ERROR_SMOOTH_RADIUS,
     "half side of the weighted median's window, pixels"},
    {"--smooth-passes", "N", &bsm_config::smooth_passes, 0, BSM_MAX_SMOOTH_PASSES, BSM_ERROR_SMOOTH_PASSES,
     "passes of the weighted median, 0 for none"},
    {"--smooth-color", "C", &bsm_config::smooth_color, 1, 64, BSM_ERROR_SMOOTH_COLOR,
     "colour distance that divides its weights by e"},
    {"--smooth-distance", "E", &bsm_config::smooth_distance, 2, 64, BSM_ERROR_SMOOTH_DISTANCE,
     "distance in pixels that divides its weights by e"},
    {"--median", "0|1", &bsm_config::median, 0, 1, BSM_ERROR_MEDIAN, "a 3x3 median at the end"}};

const char* option_of(bsm_status status) {
  for (const PresetField& field : kPresetFields) {
    if (field.refused == status) return field.option;
  }
  switch (status) {
    case BSM_ERROR_WIDTH:
    case BSM_ERROR_HEIGHT:
      return "the image size";
    case BSM_ERROR_MIN_DISPARITY:
      return "--min-disparity";
    case BSM_ERROR_NUM_DISPARITIES:
      return "--disparities";
    case BSM_ERROR_METHOD:
      return "--method";
    case BSM_ERROR_STAGE:
      return "--stage";
    case BSM_ERROR_ROW_MODE:
      return "--stream";
    case BSM_ERROR_JOBS:
      return "--threads";
    case BSM_ERROR_MEMORY_SIZE:
      return "--bits, --disparities or --threads";
    default:
      return "the configuration";
  }
}

}  // namespace

ConfigOptions::ConfigOptions() : config{} {
  bsm_config_init(&config, 1, 1);
}

void ConfigOptions::add_search(Options* options) {
  options_ = options;
  options->choice("--preset", &preset_, all_of(kPresets),
                  "quality against time; for --method local or more than 1024 bits it is paper");
  options->integer("--disparities", "N", &config.num_disparities, 1, BSM_MAX_DISPARITY - BSM_MIN_DISPARITY + 1,
                   "how many disparities are searched, in pixels");
  options->integer("--min-disparity", "M", &config.min_disparity, BSM_MIN_DISPARITY, BSM_MAX_DISPARITY,
                   "the smallest disparity searched, may be negative");
  options->choice("--method", &config.method, all_of(kMethods), "how costs become disparities");
  options->integer("--threads", "T", &config.max_jobs, 1, BSM_MAX_JOBS,
                   "threads that share the work; the map stays the same");
  options->word("--isa", "NAME", &isa, "instructions allowed: auto, scalar or a name from 'bsm info'");
  for (const PresetField& field : kPresetFields) {
    options->integer(field.option, field.value_name, &(config.*field.field), field.least, field.most, field.help);
  }
  options->choice("--right-costs", &config.right_costs, all_of(kRightCosts),
                  "sgm: the right view's map from its own costs, or from the left's");
  options->flag("--no-median", &no_median_, "the same as --median 0");
}

void ConfigOptions::add_stage(Options* options) {
  options->choice("--stage", &config.stage, all_of(kStages), "the step whose map is written");
}

bool ConfigOptions::finish(std::string* error) {
  parsed_ = config;
  if (!options_->given("--preset")) {
    const bool local = options_->given("--method") && config.method == BSM_METHOD_LOCAL;
    const bool many_bits = options_->given("--bits") && config.bits > BSM_MAX_SGM_BITS;
    if (local || (many_bits && !options_->given("--method"))) preset_ = BSM_PRESET_PAPER;
  }
  set_format(config.format);
  return isa_mask_of(isa, &config.isa_mask, error);
}

void ConfigOptions::set_format(int32_t format) {
  const uint32_t isa_mask = config.isa_mask;
  const int32_t right_map = config.right_map;
  const int32_t confidence = config.confidence;
  config = parsed_;
  config.isa_mask = isa_mask;
  config.right_map = right_map;
  config.confidence = confidence;
  config.format = format;
  bsm_config_preset(&config, static_cast<bsm_preset>(preset_));
  for (const PresetField& field : kPresetFields) {
    if (options_->given(field.option)) config.*field.field = parsed_.*field.field;
  }
  if (options_->given("--method")) config.method = parsed_.method;
  if (options_->given("--right-costs")) config.right_costs = parsed_.right_costs;
  if (no_median_) config.median = 0;
}

const char* ConfigOptions::preset() const {
  return preset_name(preset_);
}

bool isa_mask_of(const std::string& name, uint32_t* mask, std::string* error) {
  if (name == "auto" || name == "scalar") {
    *mask = name == "auto" ? BSM_ISA_ALL : 0;
    return true;
  }
  for (int32_t bit = 0; bit < kFeatureBits; ++bit) {
    const char* feature = bsm_cpu_feature_name(bit);
    if (feature == nullptr || name != feature || (bsm_cpu_features() >> bit & 1u) == 0) continue;
    int32_t last = bit;
    for (int32_t more = bit + 1; more < kFeatureBits; ++more) {
      const char* longer = bsm_cpu_feature_name(more);
      if (longer != nullptr && std::string(longer).compare(0, name.size(), name) == 0) last = more;
    }
    *mask = static_cast<uint32_t>((uint64_t{2} << last) - 1);
    return true;
  }
  const uint32_t features = bsm_cpu_features();
  *error = "--isa '" + name + "': not available here; there are auto scalar" +
           (features != 0 ? " " + feature_names(features) : "");
  return false;
}

std::string feature_names(uint32_t features) {
  std::string names;
  for (int32_t bit = 0; bit < kFeatureBits; ++bit) {
    const char* name = bsm_cpu_feature_name(bit);
    if ((features >> bit & 1u) != 0 && name != nullptr) names += (names.empty() ? "" : " ") + std::string(name);
  }
  return names.empty() ? "none" : names;
}

std::string config_error(bsm_status status) {
  return std::string(option_of(status)) + ": " + bsm_status_string(status);
}

const char* preset_name(int32_t preset) {
  return name_of(kPresets, preset);
}
const char* method_name(int32_t method) {
  return name_of(kMethods, method);
}
const char* stage_name(int32_t stage) {
  return name_of(kStages, stage);
}
const char* format_name(int32_t format) {
  return name_of(kFormats, format);
}
std::vector<Choice> format_choices() {
  return all_of(kFormats);
}

}  // namespace bsm::host
