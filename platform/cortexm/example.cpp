// A firmware image that matches what two cameras deliver, row by row, in static memory. Copy it and replace the files that
// stand in for the cameras and for the receiver of the map.
//
// Arguments (by semihosting): LEFT.pgm RIGHT.pgm MAP.pgm; PPM files work too, where the arena is large enough for colour.
#include <stddef.h>
#include <stdint.h>

#include "bsm/bsm.h"
#include "cortexm/pnm_rows.h"
#include "cortexm/semihosting.h"
#include "cortexm/text.h"

using namespace bsm::cortexm;

namespace {

constexpr int32_t kMaxWidth = BSM_IMAGE_WIDTH;

// All the memory that matching takes, beside 2 KB of stack. `bsm info` on a computer tells how many bytes a configuration
// needs.
alignas(64) uint8_t arena[BSM_IMAGE_BYTES];
// A row of each camera and of the map.
uint8_t left_row[3 * kMaxWidth], right_row[3 * kMaxWidth];
int16_t disparities[kMaxWidth];

[[noreturn]] void stop(const char* about, const char* problem) {
  host_print(about);
  host_print(": ");
  host_print(problem);
  host_print("\n");
  host_exit(1);
}

void check(bsm_status status) {
  if (status < 0) stop("bsm", bsm_status_string(status));
}

bsm_context* open_matcher(const ImageRows& image, bsm_config* config) {
  check(bsm_config_init(config, image.width, image.height));
  config->format = image.channels == 1 ? BSM_FORMAT_GRAY8 : BSM_FORMAT_RGB24;
  config->num_disparities = 32;
  check(bsm_config_preset(config, BSM_PRESET_FAST));
  config->speckle = 0;  // the filter's rows would take the last 4 KB of a small memory
  bsm_context* context = nullptr;
  check(bsm_open(config, arena, sizeof arena, &context));
  return context;
}

// Sends the rows that are finished.
void send_rows(bsm_context* context, const MapRows& map) {
  bsm_status status;
  while ((status = bsm_pull_row(context, disparities, nullptr, nullptr)) == BSM_OK) {
    if (!write_row(map, disparities)) stop("map", "cannot be written");
  }
  check(status);
}

void match(const char* left_path, const char* right_path, const char* map_path) {
  ImageRows left, right;
  const char* problem = open_image(left_path, &left);
  if (problem != nullptr) stop(left_path, problem);
  problem = open_image(right_path, &right);
  if (problem != nullptr) stop(right_path, problem);
  if (left.width != right.width || left.height != right.height || left.channels != right.channels) {
    stop(right_path, "differs from the left image in size or format");
  }
  if (left.width > kMaxWidth) stop(left_path, "is wider than this image's rows");

  bsm_config config;
  bsm_context* context = open_matcher(left, &config);
  MapRows map;
  problem = create_map(map_path, left.width, left.height, bsm_invalid_disparity(&config), &map);
  if (problem != nullptr) stop(map_path, problem);

  const bsm_row left_source = {{left_row, nullptr}}, right_source = {{right_row, nullptr}};
  for (int32_t y = 0; y < left.height; ++y) {
    if (!read_row(left, left_row) || !read_row(right, right_row)) stop("camera", "a row is missing");
    check(bsm_push_row(context, &left_source, &right_source));
    send_rows(context, map);
  }
  host_close(map.file);
}

}  // namespace

extern "C" void HardFault_Handler() {
  stop("example", "hard fault");
}

int main() {
  static char arguments[512];
  char* words[5];
  if (!host_arguments(arguments, sizeof arguments) || split_words(arguments, words, 5) != 4) {
    stop("usage", "arguments LEFT.pgm RIGHT.pgm MAP.pgm after the image's name");
  }
  match(words[1], words[2], words[3]);
  host_exit(0);
}
