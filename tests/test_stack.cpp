// test_stack.cpp - the deepest stack that the library uses, measured: each call runs on a painted stack of its own, and the
// lowest byte that lost its paint is counted. A caller's parallel_for is not the library's; the one used here takes no room.
#include <cstdio>
#include <functional>
#include <vector>

#include "bsm/bsm.h"
#include "check.h"
#include "images.h"
#include "matching.h"

#if defined(__linux__)
#include <ucontext.h>
#define BSM_TEST_HAS_UCONTEXT 1
#else
#define BSM_TEST_HAS_UCONTEXT 0
#endif

using namespace bsm::test;

namespace {

constexpr size_t kLimit = 2048;  // what the documentation promises

#if BSM_TEST_HAS_UCONTEXT

constexpr size_t kStackBytes = 256 * 1024;
constexpr uint8_t kPaint = 0xc7;

ucontext_t test_context, call_context;
void (*call_function)(void*);
void* call_data;

void run_call() {
  call_function(call_data);
}

// Bytes of stack between the call's entry and its deepest point, with the switch itself.
size_t stack_of(void (*function)(void*), void* data) {
  static std::vector<uint8_t> stack(kStackBytes);
  size_t used = 0;
  for (int run = 0; run < 2; ++run) {  // the first run resolves symbols, which takes stack of the loader's
    for (uint8_t& byte : stack) byte = kPaint;
    REQUIRE(getcontext(&call_context) == 0);
    call_context.uc_stack.ss_sp = stack.data();
    call_context.uc_stack.ss_size = stack.size();
    call_context.uc_link = &test_context;
    call_function = function;
    call_data = data;
    makecontext(&call_context, run_call, 0);
    REQUIRE(swapcontext(&test_context, &call_context) == 0);
    size_t untouched = 0;
    while (untouched < stack.size() && stack[untouched] == kPaint) ++untouched;
    used = stack.size() - untouched;
  }
  return used;
}

struct Call {
  bsm_config config;
  bsm_context* context;
  bsm_frame frame;
  bsm_row left, right;
  int16_t* row;
  int16_t* right_row;
  uint8_t* confidence;
  const EncodedPair* pair;
  void* arena;
  size_t bytes;
};

// Every public call, each on a stack of its own.
struct NamedCall {
  const char* name;
  void (*run)(void*);
};
constexpr NamedCall kCalls[] = {
    {"nothing", [](void*) {}},
    {"bsm_config_init", [](void* d) { bsm_config_init(&static_cast<Call*>(d)->config, 37, 29); }},
    {"bsm_config_preset", [](void* d) { bsm_config_preset(&static_cast<Call*>(d)->config, BSM_PRESET_BEST); }},
    {"bsm_memory_required",
     [](void* d) { bsm_memory_required(&static_cast<Call*>(d)->config, &static_cast<Call*>(d)->bytes); }},
    {"bsm_memory_required_for",
     [](void* d) { bsm_memory_required_for(&static_cast<Call*>(d)->config, 0, &static_cast<Call*>(d)->bytes); }},
    {"bsm_row_delay",
     [](void* d) {
       static int32_t rows;
       bsm_row_delay(&static_cast<Call*>(d)->config, &rows);
     }},
    {"bsm_open",
     [](void* d) {
       Call* c = static_cast<Call*>(d);
       bsm_open(&c->config, c->arena, c->bytes, &c->context);
     }},
    {"bsm_process", [](void* d) { bsm_process(static_cast<Call*>(d)->context, &static_cast<Call*>(d)->frame); }},
    {"bsm_push_row and bsm_pull_row",
     [](void* d) {
       Call* c = static_cast<Call*>(d);
       bsm_reset(c->context);
       for (int y = 0; y < c->pair->left.height; ++y) {
         c->left.plane[0] = c->pair->left.bytes.data() + c->pair->left.stride * y;
         c->right.plane[0] = c->pair->right.bytes.data() + c->pair->right.stride * y;
         bsm_push_row(c->context, &c->left, &c->right);
         while (bsm_pull_row(c->context, c->row, c->right_row, c->confidence) == BSM_OK) {
         }
       }
     }},
    {"bsm_finish", [](void* d) { bsm_finish(static_cast<Call*>(d)->context); }},
    {"bsm_reset", [](void* d) { bsm_reset(static_cast<Call*>(d)->context); }},
    {"bsm_status_string", [](void*) { bsm_status_string(BSM_ERROR_ARENA); }},
    {"bsm_version", [](void*) { bsm_version(); }},
    {"bsm_cpu_features", [](void*) { bsm_cpu_features(); }},
    {"bsm_kernel_name", [](void* d) { bsm_kernel_name(static_cast<Call*>(d)->context, BSM_KERNEL_VOTE); }},
};

void run_jobs(void*, int32_t count, bsm_job job, void* job_context) {
  for (int32_t i = 0; i < count; ++i) job(job_context, i);
}

// Makes every call with a configuration and checks each; the deepest.
size_t deepest_call(const bsm_config& config, const EncodedPair& pair) {
  Call call{};
  Arena arena(arena_bytes(config));
  const size_t pixels = static_cast<size_t>(config.width) * static_cast<size_t>(config.height);
  std::vector<int16_t> map(pixels), right_map(pixels);
  std::vector<uint8_t> confidence(pixels);
  call.pair = &pair;
  call.arena = arena.data();
  call.row = map.data();
  call.right_row = right_map.data();
  call.confidence = confidence.data();
  call.frame.left = pair.left.view();
  call.frame.right = pair.right.view();
  call.frame.disparity = {map.data(), config.width * ptrdiff_t{2}};
  call.frame.right_disparity = {right_map.data(), config.width * ptrdiff_t{2}};
  call.frame.confidence = {confidence.data(), config.width};
  call.frame.parallel_for = run_jobs;
  size_t baseline = 0, deepest = 0;
  for (const NamedCall& named : kCalls) {
    call.config = config;  // the call before may have overwritten both
    call.bytes = arena.size();
    const size_t used = stack_of(named.run, &call);
    if (baseline == 0) baseline = used;  // the first call does nothing
    const Scope scope(std::string(named.name) + ", " + describe(config));
    REQUIRE(used >= baseline && used < kStackBytes);
    CHECK_LE(used - baseline, kLimit);
    deepest = used - baseline > deepest ? used - baseline : deepest;
  }
  REQUIRE(call.context != nullptr);
  return deepest;
}

#endif

}  // namespace

TEST_CASE(stack_stays_within_the_bound) {
#if BSM_TEST_HAS_UCONTEXT
  if (kSanitized) SKIP("sanitizers change the stack");
  if (!kOptimized) SKIP("the bound holds for optimized builds (Release)");
  Rng rng(seed());
  size_t deepest = 0;
  for (const bsm_format format : kAllFormats) {
    for (const bsm_preset preset :
         {BSM_PRESET_PAPER, BSM_PRESET_FAST, BSM_PRESET_BALANCED, BSM_PRESET_BEST, BSM_PRESET_LOCAL}) {
      for (const uint32_t isa_mask : isa_masks()) {
        bsm_config config = config_for(37, 29, format);
        REQUIRE_EQ(bsm_config_preset(&config, preset), BSM_OK);
        config.right_map = 1;
        config.confidence = 1;
        config.num_disparities = 9;
        config.max_jobs = 2;
        config.isa_mask = isa_mask;
        const size_t used = deepest_call(config, encode(make_pair(rng, Content::kShifted, 37, 29), format));
        deepest = used > deepest ? used : deepest;
      }
    }
  }
  std::printf("  deepest stack: %zu bytes of %zu\n", deepest, kLimit);
  CHECK(deepest > 100);  // the measurement sees something
#else
  SKIP("this system has no makecontext to measure with");
#endif
}

TEST_CASE(measurement_sees_a_large_frame) {
#if BSM_TEST_HAS_UCONTEXT
  if (kSanitized) SKIP("sanitizers change the stack");
  const size_t small = stack_of([](void*) {}, nullptr);
  const size_t large = stack_of(
      [](void* data) {
        volatile uint8_t block[5000];
        for (size_t i = 0; i < sizeof block; ++i) block[i] = static_cast<uint8_t>(i);
        *static_cast<int*>(data) = block[77];
      },
      [] {
        static int sink;
        return static_cast<void*>(&sink);
      }());
  CHECK_LE(small + 4900, large);  // saved registers and alignment differ
  CHECK_LE(large, small + 6000);
#else
  SKIP("this system has no makecontext to measure with");
#endif
}
