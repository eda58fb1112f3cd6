// test_kernels.cpp - every kernel of simd/kernels.def that this machine can run writes the same bytes as scalar; the right
// ones are chosen; the whole pipeline gives the same maps with each choice. BSM_EXPECT_ISA names the instruction set whose
// kernels have to be the best chosen ones, for runs under an emulator.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "check.h"
#include "images.h"
#include "kernel_cases.h"
#include "matching.h"
#include "page_yard.h"
#include "platform/cpu.h"

using namespace bsm;
using namespace bsm::test;

namespace {

[[noreturn]] void report(const Difference& difference) {
  std::string notes = difference.what;
  for (size_t i = 0; i < difference.notes_count; ++i) {
    notes += std::string(", ") + difference.notes[i].name + " " + text_of(difference.notes[i].value);
  }
  const Scope scope(notes + ", element " + text_of(difference.element));
  if (difference.kernel != difference.scalar) {
    CHECK_EQ(difference.kernel, difference.scalar);
  } else {
    const bool intact_around_the_memory = false;
    CHECK(intact_around_the_memory);
  }
  throw Stop{};
}

template <class Args>
void try_widths(const Kernel<Args>& kernel, const Kernel<Args>& scalar, PageYard& yard) {
  Rng rng(seed());
  const int rounds = repeats(2);
  int group = rng.range(0, 63);
  for (int round = 0; round < rounds; ++round) {
    for (int width = 1; width <= 200; ++width) {
      group = (group + 27) % 64;  // all lengths, in an order without a pattern
      const int bits = 64 * (group + 1);
      const Scope scope("width " + text_of(width) + " bits " + text_of(bits));
      yard.clear(rng.one_in(2) ? GuardedBuffer::Edge::kEnd : GuardedBuffer::Edge::kBegin);
      try_kernel(Trial{rng, yard, width, bits, report}, kernel, scalar);
    }
    for (const int bits : {64, 128, 192, 256, 320, 384, 448, 512, 576, 1024, 4032, 4096}) {
      const Scope scope("bits " + text_of(bits));
      yard.clear(rng.one_in(2) ? GuardedBuffer::Edge::kEnd : GuardedBuffer::Edge::kBegin);
      try_kernel(Trial{rng, yard, rng.range(1, 200), bits, report}, kernel, scalar);
    }
  }
}

template <class Args>
void run_kernel(const char* name, uint32_t required, void (*run)(const Args&), kernel_scratch_fn* scratch, int block,
                void (*scalar)(const Args&), kernel_scratch_fn* scalar_scratch, PageYard& yard) {
  if (run == scalar) return;
  if ((required & ~cpu_features()) != 0) {
    std::printf("  cannot run here: %s\n", name);
    return;
  }
  const Scope scope(name);
  try_widths(Kernel<Args>{run, scratch, block}, Kernel<Args>{scalar, scalar_scratch, 1}, yard);
}

}  // namespace

TEST_CASE(kernels_equal_scalar) {
  PageYard yard;
#define BSM_KERNEL(stage, operation, isa, required, block)                                 \
  run_kernel(#stage "_" #operation "_" #isa, (required), stage##_##operation##_##isa,      \
             stage##_##operation##_##isa##_scratch, (block), stage##_##operation##_scalar, \
             stage##_##operation##_scalar_scratch, yard);
#include "simd/kernels.def"
#undef BSM_KERNEL
}

// Every kernel is chosen by exactly the words that hold its features and those of no later kernel of its stage; one of SVE
// by none that calls its vectors short.
TEST_CASE(selection_follows_the_list) {
  Rng rng(seed());
  for (int i = 0; i < 2000; ++i) {
    const uint32_t features = static_cast<uint32_t>(rng.next() | (rng.one_in(2) ? rng.next() : 0));
    const Kernels kernels = select_kernels(features);
    const uint32_t usable = (features & kCpuSveShort) != 0 ? features & ~uint32_t{kCpuSve} : features;
    const char* expected[BSM_KERNEL_COUNT] = {};
#define BSM_KERNEL(stage, operation, isa, required, block)                                              \
  for (int32_t k = 0; k < BSM_KERNEL_COUNT && ((required) & ~usable) == 0; ++k) {                       \
    const std::string name = #stage "_" #operation "_";                                                 \
    if (std::string(kernels.name[k]).rfind(name, 0) == 0) expected[k] = #stage "_" #operation "_" #isa; \
  }
#include "simd/kernels.def"
#undef BSM_KERNEL
    for (int32_t k = 0; k < BSM_KERNEL_COUNT; ++k) {
      REQUIRE(expected[k] != nullptr);
      REQUIRE_EQ(std::string(kernels.name[k]), std::string(expected[k]));
    }
  }
}

TEST_CASE(expected_instruction_set) {
  const char* expected = std::getenv("BSM_EXPECT_ISA");
  if (expected == nullptr) SKIP("BSM_EXPECT_ISA names no instruction set");
  CHECK_EQ(best_isa(BSM_ISA_ALL), std::string(expected));
}

TEST_CASE(maps_are_the_same_for_every_choice) {
  Rng rng(seed());
  std::vector<uint32_t> masks = isa_masks();
  masks.erase(masks.begin());  // scalar kernels give what is expected
  if (masks.empty()) SKIP("this machine runs the scalar kernels alone");
  for (int i = 0; i < repeats(24); ++i) {
    bsm_config config = config_for(rng.range(1, 180), rng.range(1, 24), any_format(rng));
    randomize(rng, config, true);
    const Content content = kAllContents[rng.range(0, 5)];
    const EncodedPair pair =
        encode(make_pair(rng, content, config.width, config.height), static_cast<bsm_format>(config.format));
    config.isa_mask = 0;
    const Scope scope(describe(config) + " " + content_name(content));
    const Maps expected = match_frame(config, pair);
    for (const uint32_t mask : masks) {
      config.isa_mask = mask;
      const Scope with("isa_mask " + text_of(mask));
      if (!check_same(match_frame(config, pair), expected)) return;
    }
  }
}
