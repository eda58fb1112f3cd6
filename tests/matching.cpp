// matching.cpp - arenas with guards, frames and row streams.
#include "matching.h"

#include <algorithm>
#include <set>
#include <thread>

#include "simd/kernels.h"

namespace bsm::test {
namespace {

constexpr size_t kGuardBytes = 256;
constexpr size_t kArenaAlignment = 64;

uint8_t guard_byte(size_t i) {
  return static_cast<uint8_t>(0xa5 ^ (i * 37));
}

void run_in_order(void*, int32_t count, bsm_job job, void* job_context) {
  for (int32_t i = 0; i < count; ++i) job(job_context, i);
}
void run_reversed(void*, int32_t count, bsm_job job, void* job_context) {
  for (int32_t i = count; i-- > 0;) job(job_context, i);
}
void run_shuffled(void*, int32_t count, bsm_job job, void* job_context) {
  std::vector<int32_t> order(static_cast<size_t>(count));
  for (int32_t i = 0; i < count; ++i) order[static_cast<size_t>(i)] = i;
  Rng rng(static_cast<uint64_t>(count));
  for (int32_t i = count - 1; i > 0; --i) {
    std::swap(order[static_cast<size_t>(i)], order[static_cast<size_t>(rng.range(0, i))]);
  }
  for (const int32_t i : order) job(job_context, i);
}
void run_threads(void*, int32_t count, bsm_job job, void* job_context) {
  std::vector<std::thread> threads;
  for (int32_t i = 0; i < count; ++i) threads.emplace_back(job, job_context, i);
  for (std::thread& thread : threads) thread.join();
}

// A row of an image in memory of its own.
class RowCopy {
 public:
  bsm_row take(const PixelImage& image, int y) {
    pixels_.assign(image.row(y), image.row(y) + row_bytes(image.format, image.width));
    if (image.chroma.empty()) return bsm_row{{pixels_.data(), nullptr}};
    chroma_.assign(image.chroma_row(y), image.chroma_row(y) + chroma_row_bytes(image.width));
    return bsm_row{{pixels_.data(), chroma_.data()}};
  }
  void fill(uint8_t value) {
    std::fill(pixels_.begin(), pixels_.end(), value);
    std::fill(chroma_.begin(), chroma_.end(), value);
  }

 private:
  std::vector<uint8_t> pixels_, chroma_;
};

template <typename Value>
bool same_map(const std::vector<Value>& a, const std::vector<Value>& b, int width, const char* what) {
  if (a.size() != b.size()) {
    report_failure(__FILE__, __LINE__,
                   std::string(what) + ": " + text_of(a.size()) + " values against " + text_of(b.size()));
    return false;
  }
  size_t different = 0, first = 0;
  for (size_t i = a.size(); i-- > 0;) {
    if (a[i] != b[i]) {
      ++different;
      first = i;
    }
  }
  if (different == 0) return true;
  const size_t w = static_cast<size_t>(std::max(width, 1));
  report_failure(__FILE__, __LINE__,
                 std::string(what) + ": " + text_of(different) + " of " + text_of(a.size()) +
                     " values differ, first at x = " + text_of(first % w) + ", y = " + text_of(first / w) + ": " +
                     text_of(a[first]) + " against " + text_of(b[first]));
  return false;
}

}  // namespace

bool check_same_map(const std::vector<int16_t>& a, const std::vector<int16_t>& b, int width, const char* what) {
  return same_map(a, b, width, what);
}

bool check_same_map(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b, int width, const char* what) {
  return same_map(a, b, width, what);
}

bool check_same(const Maps& a, const Maps& b) {
  const bool left = check_same_map(a.left, b.left, a.width, "left map");
  const bool right = check_same_map(a.right, b.right, a.width, "right map");
  const bool confidence = check_same_map(a.confidence, b.confidence, a.width, "confidence");
  return left && right && confidence;
}

Arena::Arena(size_t bytes, size_t misalignment) : bytes_(bytes) {
  storage_.resize(bytes + 2 * kGuardBytes + 2 * kArenaAlignment);
  const uintptr_t start = reinterpret_cast<uintptr_t>(storage_.data()) + kGuardBytes;
  offset_ = kGuardBytes + (kArenaAlignment - start % kArenaAlignment) % kArenaAlignment + misalignment % kArenaAlignment;
  for (size_t i = 0; i < storage_.size(); ++i) storage_[i] = guard_byte(i);
}

bool Arena::guards_intact() const {
  for (size_t i = 0; i < offset_; ++i) {
    if (storage_[i] != guard_byte(i)) return false;
  }
  for (size_t i = offset_ + bytes_; i < storage_.size(); ++i) {
    if (storage_[i] != guard_byte(i)) return false;
  }
  return true;
}

Arena::~Arena() {
  CHECK(guards_intact());
}

std::string describe(const bsm_config& c) {
  std::string text = text_of(c.width) + "x" + text_of(c.height) + " " + format_name(static_cast<bsm_format>(c.format));
  const auto add = [&text](const char* name, int32_t value) { text += std::string(" ") + name + "=" + text_of(value); };
  add("disparities", c.num_disparities);
  add("from", c.min_disparity);
  add("stage", c.stage);
  add("right", c.right_map);
  add("confidence", c.confidence);
  add("method", c.method);
  add("bits", c.bits);
  if (c.method == BSM_METHOD_LOCAL) add("sigma", c.sigma);
  if (c.method == BSM_METHOD_SGM) {
    add("paths", c.paths);
    add("p1", c.p1);
    add("p2", c.p2);
    add("edge_threshold", c.edge_threshold);
    add("edge_divisor", c.edge_divisor);
    add("right_costs", c.right_costs);
    add("subpixel", c.subpixel);
  }
  add("tolerance", c.lr_tolerance);
  add("speckle", c.speckle);
  add("border", c.border);
  add("vote_radius", c.vote_radius);
  add("vote_step", c.vote_step);
  add("vote_color", c.vote_color);
  add("vote_distance", c.vote_distance);
  add("vote_cap", c.vote_cap);
  add("smooth_radius", c.smooth_radius);
  add("smooth_passes", c.smooth_passes);
  add("smooth_color", c.smooth_color);
  add("smooth_distance", c.smooth_distance);
  add("median", c.median);
  add("jobs", c.max_jobs);
  if (c.isa_mask != BSM_ISA_ALL) add("isa_mask", static_cast<int32_t>(c.isa_mask));
  return text;
}

bsm_config config_for(int width, int height, bsm_format format) {
  bsm_config config;
  REQUIRE_EQ(bsm_config_init(&config, width, height), BSM_OK);
  config.format = format;
  REQUIRE_EQ(bsm_config_preset(&config, BSM_PRESET_PAPER), BSM_OK);
  return config;
}

std::vector<uint32_t> isa_masks() {
  std::vector<uint32_t> masks;
  std::set<std::vector<bool>> seen;
  for (int bits = 0; bits <= 32; ++bits) {
    const uint32_t mask = bsm_cpu_features() & static_cast<uint32_t>((uint64_t{1} << bits) - 1);
    std::vector<bool> runs;  // which kernels of the list can
#define BSM_KERNEL(stage, operation, isa, required, block) runs.push_back(((required) & ~mask) == 0);
#include "simd/kernels.def"
#undef BSM_KERNEL
    if (seen.insert(runs).second) masks.push_back(mask);
  }
  return masks;
}

std::string best_isa(uint32_t isa_mask) {
  uint32_t features = bsm_cpu_features() & isa_mask;
  if ((features & kCpuSveShort) != 0) features &= ~uint32_t{kCpuSve};
  uint32_t most = 0;
  std::string best;
  // Features of a better instruction set are higher bits.
#define BSM_KERNEL(stage, operation, isa, required, block)   \
  if (((required) & ~features) == 0 && (required) >= most) { \
    most = (required);                                       \
    best = #isa;                                             \
  }
#include "simd/kernels.def"
#undef BSM_KERNEL
  return best;
}

void randomize(Rng& rng, bsm_config& config, bool whole_frame) {
  config.bits = 64 * rng.range(1, 4);
  config.num_disparities = rng.range(1, 12);
  config.min_disparity = rng.range(-4, 4);
  config.right_map = rng.range(0, 1);
  config.confidence = rng.range(0, 1);
  config.method = whole_frame || rng.one_in(2) ? BSM_METHOD_SGM : BSM_METHOD_LOCAL;
  config.stage = config.method == BSM_METHOD_SGM ? rng.range(BSM_STAGE_COST, BSM_STAGE_REFINED) : kStages[rng.range(0, 3)];
  if (rng.one_in(2)) config.stage = BSM_STAGE_REFINED;  // what most of the fields below act on
  config.sigma = rng.range(3, 4);
  config.paths = whole_frame ? 8 : rng.range(3, 5);
  config.p1 = rng.range(1, 2000);
  config.p2 = rng.range(config.p1, 16384);
  config.edge_threshold = rng.range(1, 255);
  config.edge_divisor = rng.range(1, 64);
  config.right_costs = rng.one_in(2) ? BSM_RIGHT_COSTS_OWN : BSM_RIGHT_COSTS_LEFT;
  config.subpixel = rng.range(0, 1);
  config.lr_tolerance = rng.range(0, 2);
  config.border = rng.range(0, 1);
  config.vote_step = rng.range(1, 3);
  config.vote_radius = config.vote_step * rng.range(1, 4);
  config.vote_color = rng.range(1, 64);
  config.vote_distance = rng.range(1, 64);
  config.vote_cap = rng.range(0, 1);
  config.smooth_radius = rng.range(1, BSM_MAX_SMOOTH_RADIUS);
  config.smooth_passes = rng.range(0, BSM_MAX_SMOOTH_PASSES);
  config.smooth_color = rng.range(1, 64);
  config.smooth_distance = rng.range(2, 64);
  config.median = rng.range(0, 1);
  const std::vector<uint32_t> masks = isa_masks();
  config.isa_mask = masks[static_cast<size_t>(rng.range(0, static_cast<int>(masks.size()) - 1))];
}

bsm_config any_config(Rng& rng, int width, int height, bool whole_frame) {
  bsm_config config = config_for(width, height, any_format(rng));
  randomize(rng, config, whole_frame);
  config.speckle = rng.one_in(2) ? 0 : rng.range(1, 100);
  config.max_jobs = rng.range(1, 3);
  return config;
}

size_t arena_bytes(const bsm_config& config) {
  size_t bytes = 0;
  REQUIRE_EQ(bsm_memory_required(&config, &bytes), BSM_OK);
  return bytes;
}

const char* jobs_name(Jobs jobs) {
  switch (jobs) {
    case Jobs::kNone:
      return "no parallel_for";
    case Jobs::kInOrder:
      return "in order";
    case Jobs::kReversed:
      return "reversed";
    case Jobs::kShuffled:
      return "shuffled";
    case Jobs::kThreads:
      return "threads";
  }
  return "?";
}

bsm_parallel_for parallel_for_of(Jobs jobs) {
  switch (jobs) {
    case Jobs::kNone:
      return nullptr;
    case Jobs::kInOrder:
      return run_in_order;
    case Jobs::kReversed:
      return run_reversed;
    case Jobs::kShuffled:
      return run_shuffled;
    case Jobs::kThreads:
      return run_threads;
  }
  return nullptr;
}

bsm_frame frame_for(const bsm_config& config, const EncodedPair& pair, Maps& maps) {
  maps.width = config.width;
  maps.height = config.height;
  const size_t pixels = static_cast<size_t>(config.width) * static_cast<size_t>(config.height);
  maps.left.assign(pixels, kUnwritten);
  maps.right.assign(config.right_map ? pixels : 0, kUnwritten);
  maps.confidence.assign(config.confidence ? pixels : 0, 0x5a);
  bsm_frame frame{};
  frame.left = pair.left.view();
  frame.right = pair.right.view();
  frame.disparity = {maps.left.data(), static_cast<ptrdiff_t>(config.width) * 2};
  if (config.right_map) frame.right_disparity = {maps.right.data(), static_cast<ptrdiff_t>(config.width) * 2};
  if (config.confidence) frame.confidence = {maps.confidence.data(), config.width};
  return frame;
}

Maps match_frame(const bsm_config& config, const EncodedPair& pair, Jobs jobs) {
  Arena arena(arena_bytes(config));
  bsm_context* context = nullptr;
  REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
  Maps maps;
  bsm_frame frame = frame_for(config, pair, maps);
  frame.parallel_for = parallel_for_of(jobs);
  REQUIRE_EQ(bsm_process(context, &frame), BSM_OK);
  CHECK(std::find(maps.left.begin(), maps.left.end(), kUnwritten) == maps.left.end());
  CHECK(std::find(maps.right.begin(), maps.right.end(), kUnwritten) == maps.right.end());
  return maps;
}

Maps match_rows(const bsm_config& config, const EncodedPair& pair) {
  Arena arena(arena_bytes(config));
  bsm_context* context = nullptr;
  REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
  return stream_rows(context, config, pair);
}

Maps stream_rows(bsm_context* context, const bsm_config& config, const EncodedPair& pair, int rows) {
  if (rows < 0) rows = pair.left.height;
  int32_t delay = -1;
  REQUIRE_EQ(bsm_row_delay(&config, &delay), BSM_OK);
  const size_t width = static_cast<size_t>(config.width);
  Maps maps;
  maps.width = config.width;
  maps.height = rows;
  std::vector<int16_t> left_row(width, kUnwritten), right_row(width, kUnwritten);
  std::vector<uint8_t> confidence_row(width, 0x5a);
  const auto pull = [&] {
    const bsm_status status = bsm_pull_row(context, left_row.data(), config.right_map ? right_row.data() : nullptr,
                                           config.confidence ? confidence_row.data() : nullptr);
    if (status == BSM_OK) {
      if (config.confidence) maps.confidence.insert(maps.confidence.end(), confidence_row.begin(), confidence_row.end());
      maps.left.insert(maps.left.end(), left_row.begin(), left_row.end());
      if (config.right_map) maps.right.insert(maps.right.end(), right_row.begin(), right_row.end());
    }
    return status;
  };
  // The pushed rows lie in a buffer that changes after each push: the library has to copy them.
  RowCopy left_input, right_input;
  for (int y = 0; y < rows; ++y) {
    const bsm_row left = left_input.take(pair.left, y), right = right_input.take(pair.right, y);
    REQUIRE_EQ(bsm_push_row(context, &left, &right), BSM_OK);
    left_input.fill(0x5a);
    right_input.fill(0xc3);
    if (y >= delay) REQUIRE_EQ(pull(), BSM_OK);
    if (y + 1 < config.height) REQUIRE_EQ(pull(), BSM_NEED_ROWS);  // the last row finishes the stream
  }
  if (rows < config.height) REQUIRE_EQ(bsm_finish(context), BSM_OK);
  while (maps.left.size() < width * static_cast<size_t>(rows)) REQUIRE_EQ(pull(), BSM_OK);
  REQUIRE_EQ(pull(), BSM_END);
  REQUIRE_EQ(pull(), BSM_END);
  return maps;
}

}  // namespace bsm::test
