// test_sequence.cpp - calls in random orders, right and wrong ones, between forbidden pages: the status of each call, and
// every row as from a context that did nothing else. Contexts on threads of their own do not know of each other.
#include <thread>
#include <vector>

#include "bsm/bsm.h"
#include "call_sequence.h"
#include "check.h"
#include "images.h"
#include "matching.h"

using namespace bsm::test;

namespace {

bsm_config any_config(Rng& rng, int width, int height, bsm_format format) {
  bsm_config config = config_for(width, height, format);
  randomize(rng, config, rng.one_in(6));
  config.speckle = rng.one_in(2) ? 0 : rng.range(1, 100);
  config.max_jobs = rng.range(1, 4);
  return config;
}

}  // namespace

TEST_CASE(random_sequences) {
  if (!GuardedBuffer::available()) SKIP("this system has no page protection that the test knows");
  Rng rng(seed());
  const Draw draw = [&rng](int low, int high) { return rng.range(low, high); };
  PageYard yard;
  for (int i = repeats(250); i-- > 0;) {
    const int width = rng.range(1, 40), height = rng.one_in(3) ? rng.range(1, 8) : rng.range(1, 60);
    const bsm_format format = any_format(rng);
    Stage stage{};
    for (size_t j = 0; j < 2; ++j) {
      stage.config[j] = any_config(rng, width, height, format);
      stage.pair[j] = encode(make_pair(rng, j == 0 ? Content::kShifted : Content::kNoise, width, height), format);
    }
    const Scope scope("sequence " + text_of(i) + ": " + describe(stage.config[0]) + " and " + describe(stage.config[1]));
    play_calls(stage, draw, yard, 40);
  }
}

TEST_CASE(contexts_on_several_threads) {
  constexpr size_t kContexts = 4;
  Rng rng(seed() + 1);
  for (int i = repeats(12); i-- > 0;) {
    std::vector<bsm_config> configs;
    std::vector<EncodedPair> pairs;
    for (size_t j = 0; j < kContexts; ++j) {
      const bsm_format format = any_format(rng);
      configs.push_back(any_config(rng, rng.range(1, 60), rng.range(1, 40), format));
      pairs.push_back(encode(make_pair(rng, Content::kShifted, configs[j].width, configs[j].height), format));
    }
    std::vector<Maps> maps(kContexts);
    std::vector<std::thread> threads;
    for (size_t j = 0; j < kContexts; ++j) {
      threads.emplace_back([&, j] { maps[j] = match_frame(configs[j], pairs[j], Jobs::kThreads); });
    }
    for (std::thread& thread : threads) thread.join();
    for (size_t j = 0; j < kContexts; ++j) {
      const Scope scope(describe(configs[j]));
      check_same(maps[j], match_frame(configs[j], pairs[j]));
    }
  }
}
