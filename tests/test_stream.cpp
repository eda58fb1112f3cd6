// test_stream.cpp - the same map in every way of asking for it: whole frames with any number of jobs in any order, rows
// pushed and pulled with exactly the promised delay, streams that end early, and contexts that are reset or used again.
#include <algorithm>

#include "bsm/bsm.h"
#include "check.h"
#include "host/thread_pool.h"
#include "images.h"
#include "matching.h"

using namespace bsm::test;

namespace {

// A configuration whose windows reach beyond the small image on every side.
bsm_config small_config(Rng& rng, int width, int height) {
  bsm_config config = config_for(width, height);
  randomize(rng, config);
  config.speckle = rng.one_in(2) ? 0 : rng.range(1, 100);
  return config;
}

EncodedPair random_pair(Rng& rng, int width, int height) {
  return encode(make_pair(rng, rng.one_in(4) ? Content::kNoise : Content::kShifted, width, height), BSM_FORMAT_RGB24);
}

}  // namespace

TEST_CASE(rows_equal_frame) {
  Rng rng(seed());
  for (int i = repeats(120); i-- > 0;) {
    const int width = rng.range(1, 40), height = rng.range(1, rng.one_in(3) ? 160 : 50);
    const bsm_config config = small_config(rng, width, height);
    const Scope scope(describe(config));
    const EncodedPair pair = random_pair(rng, width, height);
    check_same(match_rows(config, pair), match_frame(config, pair));
  }
}

TEST_CASE(jobs_and_orders_equal_one_job) {
  Rng rng(seed() + 1);
  for (int i = repeats(40); i-- > 0;) {
    const int width = rng.range(1, 32), height = rng.one_in(4) ? rng.range(1, 8) : rng.range(9, 160);
    bsm_config config = small_config(rng, width, height);
    const EncodedPair pair = random_pair(rng, width, height);
    const Maps expected = match_frame(config, pair);
    for (const int jobs : {1, 2, 3, 8, BSM_MAX_JOBS}) {
      config.max_jobs = jobs;
      for (const Jobs order : kAllJobs) {
        if (jobs == BSM_MAX_JOBS && order == Jobs::kThreads) continue;
        const Scope scope(describe(config) + ", " + jobs_name(order));
        check_same(match_frame(config, pair, order), expected);
      }
      const Scope scope(describe(config) + ", rows");
      check_same(match_rows(config, pair), expected);
    }
  }
}

TEST_CASE(whole_frame_paths_do_not_depend_on_jobs) {
  Rng rng(seed() + 8);
  for (int i = repeats(25); i-- > 0;) {
    bsm_config config = config_for(rng.range(1, 32), rng.range(1, 40));
    randomize(rng, config, true);
    config.speckle = rng.range(0, 100);
    const EncodedPair pair = random_pair(rng, config.width, config.height);
    const Maps expected = match_frame(config, pair);
    for (const int jobs : {2, 3, 8}) {
      config.max_jobs = jobs;
      for (const Jobs order : kAllJobs) {
        const Scope scope(describe(config) + ", " + jobs_name(order));
        check_same(match_frame(config, pair, order), expected);
      }
    }
  }
}

TEST_CASE(thread_pool_equals_one_thread) {
  Rng rng(seed() + 2);
  for (const int threads : {1, 2, 3, 8}) {
    bsm::host::ThreadPool pool(threads);
    for (int i = repeats(10); i-- > 0;) {
      bsm_config config = small_config(rng, rng.range(20, 70), rng.range(20, 70));
      const EncodedPair pair = random_pair(rng, config.width, config.height);
      const Maps expected = match_frame(config, pair);
      config.max_jobs = threads;
      const Scope scope(describe(config));
      Arena arena(arena_bytes(config));
      bsm_context* context = nullptr;
      REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
      Maps maps;
      bsm_frame frame = frame_for(config, pair, maps);
      frame.parallel_for = bsm::host::ThreadPool::parallel_for;
      frame.parallel_user = &pool;
      REQUIRE_EQ(bsm_process(context, &frame), BSM_OK);
      check_same(maps, expected);
    }
  }
}

TEST_CASE(kernels_agree) {
  Rng rng(seed() + 9);
  for (int i = repeats(120); i-- > 0;) {
    bsm_config config = config_for(rng.range(1, 80), rng.range(1, 30), rng.one_in(2) ? BSM_FORMAT_RGB24 : BSM_FORMAT_GRAY8);
    randomize(rng, config, rng.one_in(3));
    config.speckle = rng.range(0, 100);
    if (rng.one_in(3)) config.num_disparities = rng.range(1, 100);
    const EncodedPair pair = encode(make_pair(rng, kAllContents[rng.range(0, 5)], config.width, config.height),
                                    static_cast<bsm_format>(config.format));
    config.isa_mask = 0;
    const Maps expected = match_frame(config, pair);
    for (const uint32_t isa_mask : isa_masks()) {
      config.isa_mask = isa_mask;
      const Scope scope(describe(config));
      check_same(match_frame(config, pair), expected);
    }
  }
}

TEST_CASE(early_finish_equals_a_shorter_frame) {
  Rng rng(seed() + 3);
  for (int i = repeats(60); i-- > 0;) {
    const int width = rng.range(1, 30), height = rng.range(2, 60), rows = rng.range(1, height - 1);
    bsm_config config = small_config(rng, width, height);
    const Scope scope(describe(config) + ", finished after " + text_of(rows) + " rows");
    const EncodedPair pair = random_pair(rng, width, height);
    Arena arena(arena_bytes(config));
    bsm_context* context = nullptr;
    REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
    const Maps streamed = stream_rows(context, config, pair, rows);
    config.height = rows;
    check_same(streamed, match_frame(config, pair));
  }
}

TEST_CASE(reset_drops_rows_in_flight) {
  Rng rng(seed() + 4);
  for (int i = repeats(60); i-- > 0;) {
    const int width = rng.range(1, 30), height = rng.range(1, 60), dropped = rng.range(0, height);
    const bsm_config config = small_config(rng, width, height);
    const Scope scope(describe(config) + ", reset after " + text_of(dropped) + " rows");
    const EncodedPair noise = encode(make_pair(rng, Content::kNoise, width, height), BSM_FORMAT_RGB24);
    const EncodedPair pair = random_pair(rng, width, height);
    Arena arena(arena_bytes(config));
    bsm_context* context = nullptr;
    REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
    std::vector<int16_t> left(static_cast<size_t>(width)), right(static_cast<size_t>(width));
    for (int y = 0; y < dropped; ++y) {
      const bsm_row l = noise.left.planes(y), r = noise.right.planes(y);
      REQUIRE_EQ(bsm_push_row(context, &l, &r), BSM_OK);
      if (y + 1 < dropped)
        CHECK(bsm_pull_row(context, left.data(), config.right_map ? right.data() : nullptr, nullptr) >= BSM_OK);
    }
    REQUIRE_EQ(bsm_reset(context), BSM_OK);
    const Maps expected = match_frame(config, pair);
    check_same(stream_rows(context, config, pair), expected);
  }
}

TEST_CASE(a_context_serves_many_images) {
  Rng rng(seed() + 5);
  for (int i = repeats(20); i-- > 0;) {
    const bsm_config config = small_config(rng, rng.range(1, 40), rng.range(1, 60));
    const Scope scope(describe(config));
    Arena arena(arena_bytes(config));
    bsm_context* context = nullptr;
    REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
    for (int image = 0; image < 4; ++image) {
      const EncodedPair pair = random_pair(rng, config.width, config.height);
      const Maps expected = match_frame(config, pair);
      if (image % 2 == 0) {  // a stream pulled to its end needs no reset before a frame
        REQUIRE_EQ(bsm_reset(context), BSM_OK);
        check_same(stream_rows(context, config, pair), expected);
      } else {
        Maps maps;
        const bsm_frame frame = frame_for(config, pair, maps);
        REQUIRE_EQ(bsm_process(context, &frame), BSM_OK);
        check_same(maps, expected);
      }
    }
  }
}

TEST_CASE(streaming_protocol) {
  bsm_config config = config_for(24, 60);
  config.bits = 64;
  config.num_disparities = 4;
  config.vote_radius = 2;
  Rng rng(seed() + 6);
  const EncodedPair pair = random_pair(rng, config.width, config.height);
  int32_t delay = 0;
  REQUIRE_EQ(bsm_row_delay(&config, &delay), BSM_OK);
  REQUIRE(delay >= 1 && delay + 4 < config.height);
  Arena arena(arena_bytes(config));
  bsm_context* context = nullptr;
  REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
  std::vector<int16_t> row(static_cast<size_t>(config.width));
  const auto push = [&](int y) {
    const bsm_row left = pair.left.planes(y), right = pair.right.planes(y);
    return bsm_push_row(context, &left, &right);
  };
  const auto pull = [&] { return bsm_pull_row(context, row.data(), nullptr, nullptr); };

  CHECK_EQ(pull(), BSM_NEED_ROWS);  // nothing pushed
  for (int y = 0; y < delay; ++y) {
    CHECK_EQ(push(y), BSM_OK);  // within the delay nothing has to be pulled
  }
  CHECK_EQ(pull(), BSM_NEED_ROWS);
  CHECK_EQ(push(delay), BSM_OK);
  CHECK_EQ(push(delay + 1), BSM_ERROR_PULL_FIRST);
  CHECK_EQ(push(delay + 1), BSM_ERROR_PULL_FIRST);
  CHECK_EQ(pull(), BSM_OK);
  CHECK_EQ(pull(), BSM_NEED_ROWS);
  CHECK_EQ(push(delay + 1), BSM_OK);
  CHECK_EQ(bsm_finish(context), BSM_OK);
  CHECK_EQ(push(delay + 2), BSM_ERROR_ROW_COUNT);
  for (int y = 1; y < delay + 2; ++y) CHECK_EQ(pull(), BSM_OK);
  CHECK_EQ(pull(), BSM_END);
  CHECK_EQ(push(0), BSM_ERROR_ROW_COUNT);
  CHECK_EQ(bsm_reset(context), BSM_OK);
  check_same(stream_rows(context, config, pair), match_frame(config, pair));
  CHECK_EQ(push(0), BSM_ERROR_ROW_COUNT);  // after the last row of the image

  CHECK_EQ(bsm_reset(context), BSM_OK);
  CHECK_EQ(bsm_finish(context), BSM_OK);  // an image without rows
  CHECK_EQ(pull(), BSM_END);
}

TEST_CASE(a_row_comes_without_the_right_map) {
  bsm_config config = config_for(20, 30);
  config.bits = 64;
  config.num_disparities = 6;
  config.right_map = 1;
  Rng rng(seed() + 7);
  const EncodedPair pair = random_pair(rng, config.width, config.height);
  const Maps expected = match_frame(config, pair);
  Arena arena(arena_bytes(config));
  bsm_context* context = nullptr;
  REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
  std::vector<int16_t> left, row(static_cast<size_t>(config.width));
  for (int y = 0; y < config.height; ++y) {
    const bsm_row l = pair.left.planes(y), r = pair.right.planes(y);
    REQUIRE_EQ(bsm_push_row(context, &l, &r), BSM_OK);
    while (bsm_pull_row(context, row.data(), nullptr, nullptr) == BSM_OK) left.insert(left.end(), row.begin(), row.end());
  }
  check_same_map(left, expected.left, config.width, "left map");
}

TEST_CASE(delay_does_not_depend_on_size) {
  bsm_config config = config_for(64, 48);
  for (const bsm_stage stage : kStages) {
    config.stage = stage;
    int32_t expected = -1, delay = -1;
    config.width = 64, config.height = 48;
    REQUIRE_EQ(bsm_row_delay(&config, &expected), BSM_OK);
    CHECK(expected >= 0);
    for (const int width : {1, 3, 1000, BSM_MAX_SIZE}) {
      for (const int height : {1, 2, 5000, BSM_MAX_SIZE}) {
        config.width = width, config.height = height;
        REQUIRE_EQ(bsm_row_delay(&config, &delay), BSM_OK);
        CHECK_EQ(delay, expected);
      }
    }
  }
}
