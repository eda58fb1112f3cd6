/* test_c99.c - uses the public header from C99: a frame, the same image as rows, and the answers of the small calls. The
 * environment variable BSM_EXPECT_ISA names the instruction set whose kernel has to match. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bsm/bsm.h"

enum { kWidth = 40, kHeight = 30, kShift = 5 };

static int failures = 0;

static void check(int condition, const char* what) {
  if (!condition) {
    printf("check failed: %s\n", what);
    ++failures;
  }
}

/* Runs its jobs last first: any order is allowed. */
static void run_jobs(void* user, int32_t n_jobs, bsm_job job, void* job_context) {
  int32_t i;
  *(int32_t*)user += n_jobs;
  for (i = n_jobs - 1; i >= 0; --i) job(job_context, i);
}

/* Noise that moves left by kShift pixels in the right view. */
static unsigned char pixel(int x, int y, int channel) {
  unsigned value = (unsigned)(x * 7919 + y * 104729 + channel * 1299709 + 12345);
  value = (value ^ (value >> 13)) * 0x5bd1e995u;
  return (unsigned char)(value >> 19);
}

int main(void) {
  static unsigned char left[kHeight][kWidth][3], right[kHeight][kWidth][3];
  static int16_t map[kHeight][kWidth], rows[kHeight][kWidth];
  bsm_config config;
  bsm_context* context = NULL;
  bsm_frame frame;
  size_t bytes = 0;
  int32_t delay = 0, jobs_run = 0;
  int x, y, channel, pulled = 0, right_answers = 0;
  void* arena;
  char version[40];
  const char* kernel;
  const char* expected_isa = getenv("BSM_EXPECT_ISA");

  for (y = 0; y < kHeight; ++y) {
    for (x = 0; x < kWidth; ++x) {
      for (channel = 0; channel < 3; ++channel) {
        left[y][x][channel] = pixel(x, y, channel);
        right[y][x][channel] = pixel(x + kShift, y, channel);
      }
    }
  }

  check(bsm_config_init(&config, kWidth, kHeight) == BSM_OK, "config_init");
  config.num_disparities = 12;
  config.bits = 256;
  config.max_jobs = 2;
  check(bsm_memory_required(&config, &bytes) == BSM_OK && bytes > 0, "memory_required");
  check(bsm_row_delay(&config, &delay) == BSM_OK && delay > 0, "row_delay");
  arena = malloc(bytes);
  if (arena == NULL) return 1;
  check(bsm_open(&config, arena, bytes, &context) == BSM_OK, "open");

  memset(&frame, 0, sizeof frame);
  frame.left.plane[0] = left;
  frame.left.stride[0] = kWidth * 3;
  frame.right.plane[0] = right;
  frame.right.stride[0] = kWidth * 3;
  frame.disparity.data = &map[0][0];
  frame.disparity.stride = kWidth * (ptrdiff_t)sizeof(int16_t);
  frame.parallel_for = run_jobs;
  frame.parallel_user = &jobs_run;
  check(bsm_process(context, &frame) == BSM_OK, "process");
  check(jobs_run > 0, "parallel_for was called");

  for (y = 0; y < kHeight; ++y) {
    bsm_row left_row = {{NULL, NULL}}, right_row = {{NULL, NULL}};
    left_row.plane[0] = left[y];
    right_row.plane[0] = right[y];
    check(bsm_push_row(context, &left_row, &right_row) == BSM_OK, "push_row");
    while (pulled < kHeight && bsm_pull_row(context, rows[pulled], NULL, NULL) == BSM_OK) ++pulled;
  }
  check(bsm_pull_row(context, rows[0], NULL, NULL) == BSM_END, "pull_row at the end");
  check(pulled == kHeight, "every row was pulled");
  check(memcmp(map, rows, sizeof map) == 0, "rows equal the frame");

  for (y = 0; y < kHeight; ++y) {
    for (x = kShift; x < kWidth; ++x) right_answers += map[y][x] == kShift * BSM_DISPARITY_SCALE;
  }
  check(right_answers > kHeight * (kWidth - kShift) * 8 / 10, "most pixels have the true disparity");

  check(bsm_reset(context) == BSM_OK, "reset");
  check(bsm_finish(context) == BSM_OK, "finish");
  check(bsm_invalid_disparity(&config) == -BSM_DISPARITY_SCALE, "invalid_disparity");
  sprintf(version, "%d.%d.%d", BSM_VERSION_MAJOR, BSM_VERSION_MINOR, BSM_VERSION_PATCH);
  check(strcmp(bsm_version(), version) == 0, "the library has the version of its header");
  check(strlen(bsm_status_string(BSM_ERROR_ARENA)) > 0, "status_string");
  kernel = bsm_kernel_name(context, BSM_KERNEL_MATCH);
  check(kernel != NULL, "kernel_name");
  if (expected_isa != NULL) check(kernel != NULL && strcmp(strrchr(kernel, '_') + 1, expected_isa) == 0, kernel);
  check(bsm_cpu_features() == 0 || bsm_cpu_feature_name(-1) == NULL, "cpu_features");
  free(arena);
  printf("%s\n", failures == 0 ? "ok: C99" : "FAILED: C99");
  return failures == 0 ? 0 : 1;
}
