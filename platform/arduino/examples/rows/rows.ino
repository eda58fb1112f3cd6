// Matches two views row by row in static memory and prints the depth along the middle row. The views are made up here: noise
// that lies 3 pixels further left in the right view, 9 in a box in the middle. Put two rectified cameras in the place of view().
#include <Arduino.h>
#include <bsm.h>

namespace {

constexpr int32_t kWidth = 64, kHeight = 48;
constexpr int32_t kFar = 3, kNear = 9;

alignas(8) uint8_t arena[48 * 1024];  // setup() says how much of it is needed
uint8_t left_row[kWidth], right_row[kWidth];
int16_t disparities[kWidth];

bool in_box(int32_t x, int32_t y) {
  return x >= kWidth / 3 && x < 2 * kWidth / 3 && y >= kHeight / 4 && y < 3 * kHeight / 4;
}

uint8_t noise(int32_t x, int32_t y) {
  uint32_t value = static_cast<uint32_t>(x * 7919 + y * 104729 + 12345);
  value = (value ^ (value >> 13)) * 0x5bd1e995u;
  return static_cast<uint8_t>(value >> 19);
}

// Row y of both views.
void view(int32_t y) {
  for (int32_t x = 0; x < kWidth; ++x) {
    left_row[x] = in_box(x, y) ? noise(x + 1000, y) : noise(x, y);
    right_row[x] = in_box(x + kNear, y) ? noise(x + kNear + 1000, y) : noise(x + kFar, y);
  }
}

// Prints the disparities in whole pixels, a character each: 0 to 9, then a, b and so on.
void print_row() {
  char text[kWidth + 1];
  for (int32_t x = 0; x < kWidth; ++x) {
    const int32_t pixels = (disparities[x] + BSM_DISPARITY_SCALE / 2) / BSM_DISPARITY_SCALE;
    text[x] = static_cast<char>(pixels < 10 ? '0' + pixels : 'a' + pixels - 10);
  }
  text[kWidth] = '\0';
  Serial.println(text);
}

void stop(bsm_status status) {
  Serial.println(bsm_status_string(status));
  for (;;) delay(1000);
}

}  // namespace

void setup() {
  Serial.begin(115200);
  bsm_config config;
  bsm_config_init(&config, kWidth, kHeight);
  config.format = BSM_FORMAT_GRAY8;
  config.num_disparities = 16;
  bsm_config_preset(&config, BSM_PRESET_FAST);
  size_t bytes = 0;
  bsm_status status = bsm_memory_required(&config, &bytes);
  if (status != BSM_OK) stop(status);
  Serial.print("bytes of arena: ");
  Serial.println(static_cast<unsigned long>(bytes));
  bsm_context* context = nullptr;
  status = bsm_open(&config, arena, sizeof arena, &context);
  if (status != BSM_OK) stop(status);

  const bsm_row left = {{left_row, nullptr}}, right = {{right_row, nullptr}};
  int32_t finished = 0;
  for (int32_t y = 0; y < kHeight; ++y) {
    view(y);
    status = bsm_push_row(context, &left, &right);
    if (status != BSM_OK) stop(status);
    while (bsm_pull_row(context, disparities, nullptr, nullptr) == BSM_OK) {
      if (finished++ == kHeight / 2) print_row();
    }
  }
}

void loop() {}
