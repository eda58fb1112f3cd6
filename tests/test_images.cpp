// test_images.cpp - the caller's images and maps: no byte is read that is not a pixel's, none written that is not the map's,
// with padding, strides of both signs and forbidden pages around and between the rows.
#include <algorithm>

#include "bsm/bsm.h"
#include "check.h"
#include "guarded.h"
#include "images.h"
#include "matching.h"

using namespace bsm::test;

namespace {

// A map with its own stride, between values that must not change.
struct GuardedMap {
  GuardedMap(int w, int h, ptrdiff_t stride_values, bool upward) : width(w), height(h), stride(stride_values) {
    values.assign(static_cast<size_t>(stride * h) + 2 * kEdge, kUnwritten);
    top = values.data() + kEdge + (upward ? stride * (h - 1) : 0);
    if (upward) stride = -stride;
  }
  bsm_map map() { return {top, stride * 2}; }
  std::vector<int16_t> pixels() const {
    std::vector<int16_t> result;
    for (int y = 0; y < height; ++y) result.insert(result.end(), top + y * stride, top + y * stride + width);
    return result;
  }
  // Every value outside the pixels is as it was.
  bool gaps_intact() const {
    std::vector<int16_t> copy = values;
    const ptrdiff_t origin = top - values.data();
    for (int y = 0; y < height; ++y) std::fill_n(copy.begin() + origin + y * stride, width, kUnwritten);
    return std::all_of(copy.begin(), copy.end(), [](int16_t v) { return v == kUnwritten; });
  }

  static constexpr int kEdge = 64;
  int width, height;
  ptrdiff_t stride;
  std::vector<int16_t> values;
  int16_t* top;
};

// The planes of an image, each between pages that may not be touched, and read-only.
class GuardedImage {
 public:
  GuardedImage(const PixelImage& image, GuardedBuffer::Edge edge)
      : pixels_(image.bytes.size(), edge), chroma_(image.chroma.size(), edge) {
    view_ = image.view();
    view_.plane[0] = place(image.bytes, pixels_);
    if (!image.chroma.empty()) view_.plane[1] = place(image.chroma, chroma_);
  }
  const bsm_image& view() const { return view_; }

 private:
  static const uint8_t* place(const std::vector<uint8_t>& plane, GuardedBuffer& buffer) {
    std::copy(plane.begin(), plane.end(), buffer.data());
    buffer.make_read_only();
    return buffer.data();
  }
  GuardedBuffer pixels_, chroma_;
  bsm_image view_;
};

// The planes of an image with each row between pages that may not be touched, read-only, bottom-up when asked for.
class GuardedRows {
 public:
  GuardedRows(const PixelImage& image, GuardedBuffer::Edge edge, bool upward, bool chroma_upward)
      : pixels_(static_cast<size_t>(image.stride), edge, static_cast<size_t>(image.height)),
        chroma_(static_cast<size_t>(image.chroma_stride), edge, image.chroma.empty() ? 0 : chroma_rows(image.height)) {
    place(image.bytes, pixels_, static_cast<size_t>(image.height), upward, 0);
    if (!image.chroma.empty()) place(image.chroma, chroma_, chroma_rows(image.height), chroma_upward, 1);
  }
  const bsm_image& view() const { return view_; }
  bsm_row planes(int y) const {
    bsm_row row{{static_cast<const uint8_t*>(view_.plane[0]) + y * view_.stride[0], nullptr}};
    if (view_.plane[1]) row.plane[1] = static_cast<const uint8_t*>(view_.plane[1]) + y / 2 * view_.stride[1];
    return row;
  }

 private:
  static size_t chroma_rows(int height) { return static_cast<size_t>(height + 1) / 2; }
  void place(const std::vector<uint8_t>& plane, GuardedBuffer& buffer, size_t rows, bool upward, size_t index) {
    for (size_t y = 0; y < rows; ++y) {
      std::copy_n(plane.data() + y * buffer.size(), buffer.size(), buffer.row(upward ? rows - 1 - y : y));
    }
    buffer.make_read_only();
    view_.plane[index] = buffer.row(upward ? rows - 1 : 0);
    view_.stride[index] = upward ? -buffer.stride() : buffer.stride();
  }
  GuardedBuffer pixels_, chroma_;
  bsm_image view_{};
};

// The planes of an image at odd addresses, bottom-up when `upward`: the last row first in memory.
class PlacedImage {
 public:
  PlacedImage(const PixelImage& image, bool upward, bool chroma_upward) {
    view_ = image.view();
    place(image.bytes, upward, 0, pixels_);
    if (!image.chroma.empty()) place(image.chroma, chroma_upward, 1, chroma_);
  }
  const bsm_image& view() const { return view_; }
  bool operator==(const PlacedImage& other) const { return pixels_ == other.pixels_ && chroma_ == other.chroma_; }

 private:
  void place(const std::vector<uint8_t>& plane, bool upward, size_t index, std::vector<uint8_t>& memory) {
    memory.assign(plane.size() + 1, 0);
    ptrdiff_t& stride = view_.stride[index];
    const ptrdiff_t rows = static_cast<ptrdiff_t>(plane.size()) / stride;
    for (ptrdiff_t y = 0; y < rows; ++y) {
      std::copy_n(plane.begin() + y * stride, stride, memory.begin() + 1 + (upward ? rows - 1 - y : y) * stride);
    }
    view_.plane[index] = memory.data() + 1 + (upward ? (rows - 1) * stride : 0);
    if (upward) stride = -stride;
  }
  std::vector<uint8_t> pixels_, chroma_;
  bsm_image view_;
};

}  // namespace

TEST_CASE(images_at_page_edges_are_not_read_beyond) {
  if (!GuardedBuffer::available()) SKIP("this system has no page protection that the test knows");
  Rng rng(seed() + 4);
  for (int i = repeats(60); i-- > 0;) {
    const bsm_config config = any_config(rng, rng.range(1, 70), rng.range(1, 24), rng.one_in(4));
    const Scope scope(describe(config));
    const EncodedPair pair =
        encode(make_pair(rng, Content::kShifted, config.width, config.height), static_cast<bsm_format>(config.format));
    const Maps expected = match_frame(config, pair);
    const auto edge = rng.one_in(2) ? GuardedBuffer::Edge::kEnd : GuardedBuffer::Edge::kBegin;
    const size_t pixels = static_cast<size_t>(config.width) * static_cast<size_t>(config.height);
    const GuardedImage left(pair.left, edge), right(pair.right, edge);
    GuardedBuffer arena(arena_bytes(config), edge);
    GuardedBuffer map(pixels * 2, edge), right_map(pixels * 2, edge), confidence(pixels, edge);
    bsm_context* context = nullptr;
    REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
    bsm_frame frame{};
    frame.left = left.view();
    frame.right = right.view();
    const ptrdiff_t map_stride = static_cast<ptrdiff_t>(config.width) * 2;
    frame.disparity = {reinterpret_cast<int16_t*>(map.data()), map_stride};
    if (config.right_map) frame.right_disparity = {reinterpret_cast<int16_t*>(right_map.data()), map_stride};
    if (config.confidence) {
      frame.confidence = {confidence.data(), config.width};
    }
    REQUIRE_EQ(bsm_process(context, &frame), BSM_OK);
    const int16_t* values = reinterpret_cast<const int16_t*>(map.data());
    check_same_map({values, values + pixels}, expected.left, config.width, "left map");
    if (config.right_map) {
      values = reinterpret_cast<const int16_t*>(right_map.data());
      check_same_map({values, values + pixels}, expected.right, config.width, "right map");
    }
    if (config.confidence) {
      check_same_map({confidence.data(), confidence.data() + pixels}, expected.confidence, config.width, "confidence");
    }
  }
}

TEST_CASE(rows_at_page_edges_are_not_read_beyond) {
  if (!GuardedBuffer::available()) SKIP("this system has no page protection that the test knows");
  Rng rng(seed() + 5);
  for (int i = repeats(30); i-- > 0;) {
    const bsm_config config = any_config(rng, rng.range(1, 70), rng.range(1, 24));
    const Scope scope(describe(config));
    const EncodedPair pair =
        encode(make_pair(rng, Content::kShifted, config.width, config.height), static_cast<bsm_format>(config.format));
    const Maps expected = match_frame(config, pair);
    const size_t row_size = static_cast<size_t>(pair.left.stride), width = static_cast<size_t>(config.width);
    const size_t chroma_size = static_cast<size_t>(pair.left.chroma_stride);
    const auto edge = rng.one_in(2) ? GuardedBuffer::Edge::kEnd : GuardedBuffer::Edge::kBegin;
    GuardedBuffer left(row_size, edge), right(row_size, edge), out(width * 2, edge), right_out(width * 2, edge);
    GuardedBuffer left_chroma(chroma_size, edge), right_chroma(chroma_size, edge);
    Arena arena(arena_bytes(config));
    bsm_context* context = nullptr;
    REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
    std::vector<int16_t> map;
    int16_t* row = reinterpret_cast<int16_t*>(out.data());
    int16_t* right_row = config.right_map ? reinterpret_cast<int16_t*>(right_out.data()) : nullptr;
    for (int y = 0; y < config.height; ++y) {
      std::copy_n(pair.left.row(y), row_size, left.data());
      std::copy_n(pair.right.row(y), row_size, right.data());
      if (chroma_size != 0) std::copy_n(pair.left.chroma_row(y), chroma_size, left_chroma.data());
      if (chroma_size != 0) std::copy_n(pair.right.chroma_row(y), chroma_size, right_chroma.data());
      const bsm_row l{{left.data(), left_chroma.data()}}, r{{right.data(), right_chroma.data()}};
      REQUIRE_EQ(bsm_push_row(context, &l, &r), BSM_OK);
      while (bsm_pull_row(context, row, right_row, nullptr) == BSM_OK) map.insert(map.end(), row, row + width);
    }
    check_same_map(map, expected.left, config.width, "left map");
  }
}

TEST_CASE(nothing_between_rows_is_read) {
  if (!GuardedBuffer::available()) SKIP("this system has no page protection that the test knows");
  Rng rng(seed() + 8);
  const std::vector<uint32_t> masks = isa_masks();
  for (int i = repeats(36); i-- > 0;) {
    bsm_config config = any_config(rng, rng.range(1, 70), rng.range(1, 12));
    config.format = kAllFormats[i % 9];
    config.isa_mask = masks[static_cast<size_t>(rng.range(0, static_cast<int>(masks.size()) - 1))];
    const bool left_up = rng.one_in(2), right_up = rng.one_in(2), chroma_up = rng.one_in(2);
    const auto edge = rng.one_in(2) ? GuardedBuffer::Edge::kEnd : GuardedBuffer::Edge::kBegin;
    const Scope scope(describe(config) + " upward=" + text_of(left_up) + text_of(right_up) + text_of(chroma_up));
    const EncodedPair pair =
        encode(make_pair(rng, Content::kShifted, config.width, config.height), static_cast<bsm_format>(config.format));
    const Maps expected = match_frame(config, pair);
    const GuardedRows left(pair.left, edge, left_up, chroma_up), right(pair.right, edge, right_up, !chroma_up);
    Arena arena(arena_bytes(config));
    bsm_context* context = nullptr;
    REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
    Maps maps;
    bsm_frame frame = frame_for(config, pair, maps);
    frame.left = left.view();
    frame.right = right.view();
    REQUIRE_EQ(bsm_process(context, &frame), BSM_OK);
    check_same(maps, expected);

    std::vector<int16_t> map, row(static_cast<size_t>(config.width));
    for (int y = 0; y < config.height; ++y) {
      const bsm_row l = left.planes(y), r = right.planes(y);
      REQUIRE_EQ(bsm_push_row(context, &l, &r), BSM_OK);
      while (bsm_pull_row(context, row.data(), nullptr, nullptr) == BSM_OK) map.insert(map.end(), row.begin(), row.end());
    }
    check_same_map(map, expected.left, config.width, "left map by rows");
  }
}

TEST_CASE(strides_of_both_signs_and_padding) {
  Rng rng(seed() + 6);
  for (int i = repeats(60); i-- > 0;) {
    const bsm_config config = any_config(rng, rng.range(1, 30), rng.range(1, 24), rng.one_in(4));
    const ColorPair colors = make_pair(rng, Content::kShifted, config.width, config.height);
    const bsm_format format = static_cast<bsm_format>(config.format);
    const Maps expected = match_frame(config, encode(colors, format));

    const int padding = rng.range(0, 9);
    const bool left_up = rng.one_in(2), right_up = rng.one_in(2), map_up = rng.one_in(2);
    const bool chroma_up = rng.one_in(2);
    const Scope scope(describe(config) + " padding=" + text_of(padding) + " upward=" + text_of(left_up) + text_of(right_up) +
                      text_of(map_up) + text_of(chroma_up));
    const PixelImage left_pixels = encode(colors.left, format, padding);
    const PixelImage right_pixels = encode(colors.right, format, padding + 3);
    const PlacedImage left(left_pixels, left_up, chroma_up), right(right_pixels, right_up, !chroma_up);

    GuardedMap map(config.width, config.height, config.width + rng.range(0, 5), map_up);
    GuardedMap right_map(config.width, config.height, config.width + rng.range(0, 5), !map_up);
    Arena arena(arena_bytes(config), static_cast<size_t>(rng.range(0, 63)));
    bsm_context* context = nullptr;
    REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
    const ptrdiff_t last = config.height - 1;
    bsm_frame frame{};
    frame.left = left.view();
    frame.right = right.view();
    frame.disparity = map.map();
    if (config.right_map) frame.right_disparity = right_map.map();
    const ptrdiff_t confidence_stride = config.width + rng.range(0, 5);
    const bool confidence_up = rng.one_in(2);
    std::vector<uint8_t> confidence(static_cast<size_t>(confidence_stride * config.height), 0x5a);
    if (config.confidence) {
      frame.confidence = confidence_up ? bsm_byte_map{confidence.data() + last * confidence_stride, -confidence_stride}
                                       : bsm_byte_map{confidence.data(), confidence_stride};
    }
    REQUIRE_EQ(bsm_process(context, &frame), BSM_OK);
    check_same_map(map.pixels(), expected.left, config.width, "left map");
    CHECK(map.gaps_intact());
    if (config.right_map) check_same_map(right_map.pixels(), expected.right, config.width, "right map");
    CHECK(right_map.gaps_intact());
    for (int y = 0; config.confidence && y < config.height; ++y) {
      const uint8_t* row = confidence.data() + (confidence_up ? last - y : y) * confidence_stride;
      const uint8_t* expected_row = expected.confidence.data() + y * config.width;
      CHECK(std::equal(row, row + config.width, expected_row));
      CHECK(std::all_of(row + config.width, row + confidence_stride, [](uint8_t v) { return v == 0x5a; }));
    }
    CHECK(left == PlacedImage(left_pixels, left_up, chroma_up) && right == PlacedImage(right_pixels, right_up, !chroma_up));
  }
}

TEST_CASE(a_frame_may_leave_the_right_map_out) {
  Rng rng(seed() + 7);
  bsm_config config = any_config(rng, 20, 16);
  config.right_map = 1;
  const EncodedPair pair = encode(make_pair(rng, Content::kShifted, 20, 16), static_cast<bsm_format>(config.format));
  const Maps expected = match_frame(config, pair);
  config.right_map = 0;
  check_same_map(match_frame(config, pair).left, expected.left, 20, "left map");  // the right map changes nothing in it
  config.right_map = 1;
  Arena arena(arena_bytes(config));
  bsm_context* context = nullptr;
  REQUIRE_EQ(bsm_open(&config, arena.data(), arena.size(), &context), BSM_OK);
  std::vector<int16_t> map(320);
  bsm_frame frame{};
  frame.left = pair.left.view();
  frame.right = pair.right.view();
  frame.disparity = {map.data(), 40};
  REQUIRE_EQ(bsm_process(context, &frame), BSM_OK);
  check_same_map(map, expected.left, 20, "left map");
}
