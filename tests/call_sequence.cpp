// call_sequence.cpp - the player: a model of the protocol beside the context.
#include "call_sequence.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "caller_memory.h"

namespace bsm::test {
namespace {

bool uses_whole_frame(const bsm_config& config) {
  return config.method == BSM_METHOD_SGM && config.paths == 8 && config.stage >= BSM_STAGE_AGGREGATED;
}

class Player {
 public:
  Player(const Stage& stage, const Draw& draw, PageYard& yard)
      : stage_(stage),
        draw_(draw),
        yard_(yard),
        width_(stage.config[0].width),
        height_(stage.config[0].height),
        arena_size_{arena_bytes(stage.config[0]), arena_bytes(stage.config[1])},
        arena_(yard.take(std::max(arena_size_[0], arena_size_[1]), 1)),
        frame_(yard, draw, height_, width_),
        row_(yard, draw, 1, width_) {
    for (size_t pair = 0; pair < 2; ++pair) {
      picture_[pair][0] = Picture(yard, draw, stage.pair[pair].left);
      picture_[pair][1] = Picture(yard, draw, stage.pair[pair].right);
    }
    for (auto& view : input_) {
      view[0] = yard.take(static_cast<size_t>(row_bytes(format(), width_)), 1);
      view[1] = yard.take(static_cast<size_t>(chroma_row_bytes(width_)), 1);
    }
    open(0);
  }

  // One frame and one stream from end to end, then whatever is drawn.
  void play(int calls) {
    process(0);
    for (int y = 0; y < height_; ++y) {
      push();
      pull();
    }
    for (int y = 0; y < height_; ++y) pull();
    for (int call = 0; call < calls; ++call) {
      const Scope scope("call " + text_of(call) + " of the sequence");
      act();
    }
    for (const auto& pair : picture_) REQUIRE(pair[0].unchanged() && pair[1].unchanged());
  }

 private:
  const bsm_config& config() const { return stage_.config[opened_]; }
  bsm_format format() const { return static_cast<bsm_format>(stage_.config[0].format); }
  bool whole_frame() const { return uses_whole_frame(config()); }

  void act() {
    switch (draw_(0, 15)) {
      case 0:
      case 1:
      case 2:  // as cameras do: push, and pull what is there
        for (int i = draw_(1, 2 * delay_ + 4); i-- > 0;) {
          push();
          pull();
        }
        break;
      case 3:
      case 4:
        for (int i = draw_(1, delay_ + 2); i-- > 0;) push();
        break;
      case 5:
      case 6:
        for (int i = draw_(1, height_ + 1); i-- > 0;) pull();
        break;
      case 7:
        finish();
        break;
      case 8:
        check(bsm_reset(context_), BSM_OK);
        forget_rows();
        break;
      case 9:
      case 10:
        process(static_cast<size_t>(draw_(0, 1)));
        break;
      case 11:
        open(static_cast<size_t>(draw_(0, 1)));
        break;
      case 12:  // the arena serves something else for a while
        for (size_t i = 0; i < arena_size_[opened_]; i += static_cast<size_t>(draw_(1, 64))) {
          arena_[i] = static_cast<uint8_t>(draw_(0, 255));
        }
        open(static_cast<size_t>(draw_(0, 1)));
        break;
      case 13:
        refuse_to_open();
        break;
      case 14:
        refuse_a_frame();
        break;
      default:
        refuse_a_row();
    }
  }

  // After each call: its status, and that it wrote neither around the buffers nor, unless accepted before, into them.
  void check(bsm_status status, bsm_status expected) {
    REQUIRE_EQ(status, expected);
    REQUIRE(yard_.intact());
    REQUIRE(frame_.unchanged() && row_.unchanged());
  }

  void forget_rows() {
    pushed_ = pulled_ = 0;
    rows_ = height_;
    ended_ = false;
    streamed_ = static_cast<size_t>(draw_(0, 1));
  }

  void open(size_t config) {
    bsm_context* opened = nullptr;
    check(bsm_open(&stage_.config[config], arena_, arena_size_[config], &opened), BSM_OK);
    context_ = opened;
    opened_ = config;
    delay_ = 0;
    REQUIRE_EQ(bsm_row_delay(&stage_.config[config], &delay_), whole_frame() ? BSM_ERROR_ROW_MODE : BSM_OK);
    forget_rows();
  }

  // Rows that are finished and not pulled.
  bool row_waits() const { return pulled_ < (ended_ ? rows_ : std::clamp(pushed_ - delay_, 0, rows_)); }

  bsm_row copy_row(size_t view, int y) {
    const PixelImage& image = view == 0 ? stage_.pair[streamed_].left : stage_.pair[streamed_].right;
    std::copy_n(image.row(y), row_bytes(format(), width_), input_[view][0]);
    if (image.chroma.empty()) return bsm_row{{input_[view][0], nullptr}};
    std::copy_n(image.chroma_row(y), chroma_row_bytes(width_), input_[view][1]);
    return bsm_row{{input_[view][0], input_[view][1]}};
  }

  void push() {
    const int y = std::min(pushed_, height_ - 1);
    const bsm_row left = copy_row(0, y), right = copy_row(1, y);
    const bsm_status expected = whole_frame() ? BSM_ERROR_ROW_MODE
                                : ended_      ? BSM_ERROR_ROW_COUNT
                                : row_waits() ? BSM_ERROR_PULL_FIRST
                                              : BSM_OK;
    check(bsm_push_row(context_, &left, &right), expected);
    for (auto& view : input_) {  // the rows were copied
      std::fill_n(view[0], row_bytes(format(), width_), uint8_t{0x99});
      std::fill_n(view[1], chroma_row_bytes(width_), uint8_t{0x66});
    }
    if (expected != BSM_OK) return;
    ++pushed_;
    ended_ = pushed_ == height_;
  }

  void pull() {
    const bool right = config().right_map != 0 && draw_(0, 3) != 0;
    const bool confidence = config().confidence != 0 && draw_(0, 3) != 0;
    const bsm_status expected = whole_frame()                ? BSM_ERROR_ROW_MODE
                                : ended_ && pulled_ == rows_ ? BSM_END
                                : row_waits()                ? BSM_OK
                                                             : BSM_NEED_ROWS;
    const bsm_status status = bsm_pull_row(context_, row_.left_data(), right ? row_.right_data() : nullptr,
                                           confidence ? row_.confidence.first() : nullptr);
    if (expected == BSM_OK) {
      const Maps& maps = expected_maps(streamed_, rows_);
      const size_t at = static_cast<size_t>(pulled_) * static_cast<size_t>(width_);
      const Scope scope("row " + text_of(pulled_) + " of " + text_of(rows_) + ", " + describe(config()));
      REQUIRE(row_.left.holds(&maps.left[at], 1));
      REQUIRE(row_.right.holds(right ? &maps.right[at] : nullptr, right ? 1 : 0));
      REQUIRE(row_.confidence.holds(confidence ? &maps.confidence[at] : nullptr, confidence ? 1 : 0));
      row_.accept();
      ++pulled_;
    }
    check(status, expected);
  }

  void finish() {
    check(bsm_finish(context_), whole_frame() ? BSM_ERROR_ROW_MODE : BSM_OK);
    if (whole_frame() || ended_) return;
    rows_ = pushed_;
    ended_ = true;
  }

  bsm_frame make_frame(size_t pair) {
    bsm_frame frame{};
    frame.left = picture_[pair][0].view;
    frame.right = picture_[pair][1].view;
    frame.disparity = {frame_.left_data(), frame_.left.stride()};
    return frame;
  }

  void process(size_t pair) {
    const bool right = config().right_map != 0 && draw_(0, 3) != 0;
    const bool confidence = config().confidence != 0 && draw_(0, 3) != 0;
    bsm_frame frame = make_frame(pair);
    if (right) frame.right_disparity = {frame_.right_data(), frame_.right.stride()};
    if (confidence) frame.confidence = {frame_.confidence.first(), frame_.confidence.stride()};
    frame.parallel_for = parallel_for_of(kAllJobs[draw_(0, 3)]);
    const bool in_flight = pushed_ != 0 && pulled_ < rows_;
    const bsm_status status = bsm_process(context_, &frame);
    if (!in_flight) {
      const Maps& maps = expected_maps(pair, height_);
      const Scope scope(describe(config()));
      REQUIRE(frame_.left.holds(maps.left.data(), height_));
      REQUIRE(frame_.right.holds(maps.right.data(), right ? height_ : 0));
      REQUIRE(frame_.confidence.holds(maps.confidence.data(), confidence ? height_ : 0));
      frame_.accept();
      forget_rows();
    }
    check(status, in_flight ? BSM_ERROR_STREAM_OPEN : BSM_OK);
  }

  void refuse_to_open() {
    bsm_context* untouched = context_;
    bsm_config wrong = config();
    switch (draw_(0, 3)) {
      case 0:
        check(bsm_open(&wrong, arena_, arena_size_[opened_] - 1, &untouched), BSM_ERROR_ARENA);
        break;
      case 1:
        wrong.bits = 65;
        check(bsm_open(&wrong, arena_, arena_size_[opened_], &untouched), BSM_ERROR_BITS);
        break;
      case 2:
        check(bsm_open(&wrong, nullptr, arena_size_[opened_], &untouched), BSM_ERROR_NULL);
        break;
      default:
        check(bsm_open(&wrong, arena_, arena_size_[opened_], nullptr), BSM_ERROR_NULL);
    }
    REQUIRE(untouched == context_);
  }

  void refuse_a_frame() {
    bsm_frame frame = make_frame(0);
    bsm_image& image = draw_(0, 1) == 0 ? frame.left : frame.right;
    bsm_status expected = BSM_ERROR_NULL;
    switch (draw_(0, 6)) {
      case 0:
        image.plane[0] = nullptr;
        break;
      case 1:
        if (!has_chroma_plane(format())) return;
        image.plane[1] = nullptr;
        break;
      case 2:
        frame.disparity.data = nullptr;
        break;
      case 3:
        frame.disparity.stride += 1;
        expected = BSM_ERROR_ALIGNMENT;
        break;
      case 4:
        if (height_ < 2) return;
        image.stride[0] = draw_(0, 1) == 0 ? row_bytes(format(), width_) - 1 : 1 - row_bytes(format(), width_);
        expected = BSM_ERROR_STRIDE;
        break;
      case 5:
        if (config().right_map != 0) return;
        frame.right_disparity = {frame_.right_data(), frame_.right.stride()};
        expected = BSM_ERROR_NO_RIGHT_MAP;
        break;
      default:
        if (config().confidence != 0) return;
        frame.confidence = {frame_.confidence.first(), frame_.confidence.stride()};
        expected = BSM_ERROR_NO_CONFIDENCE;
    }
    check(bsm_process(context_, &frame), expected);
  }

  void refuse_a_row() {
    bsm_row left = copy_row(0, 0);
    const bsm_row right = copy_row(1, 0);
    switch (draw_(0, 4)) {
      case 0:
        left.plane[0] = nullptr;
        check(bsm_push_row(context_, &left, &right), BSM_ERROR_NULL);
        break;
      case 1:
        if (!has_chroma_plane(format())) return;
        left.plane[1] = nullptr;
        check(bsm_push_row(context_, &right, &left), BSM_ERROR_NULL);
        break;
      case 2:
        check(bsm_pull_row(context_, reinterpret_cast<int16_t*>(row_.left.first() + 1), nullptr, nullptr),
              BSM_ERROR_ALIGNMENT);
        break;
      case 3:
        if (config().right_map != 0) return;
        check(bsm_pull_row(context_, row_.left_data(), row_.right_data(), nullptr), BSM_ERROR_NO_RIGHT_MAP);
        break;
      default:
        if (config().confidence != 0) return;
        check(bsm_pull_row(context_, row_.left_data(), nullptr, row_.confidence.first()), BSM_ERROR_NO_CONFIDENCE);
    }
  }

  // The maps of the first `rows` rows of a pair, from a context of their own.
  const Maps& expected_maps(size_t pair, int rows) {
    Maps& maps = expected_[{opened_, pair, static_cast<size_t>(rows)}];
    if (maps.left.empty()) {
      bsm_config clean = config();
      clean.height = rows;
      maps = match_frame(clean, stage_.pair[pair]);
      const int first = clean.min_disparity * BSM_DISPARITY_SCALE;
      for (const int16_t value : maps.left) {
        const bool in_range = first <= value && value < first + clean.num_disparities * BSM_DISPARITY_SCALE;
        REQUIRE(in_range || (clean.stage != BSM_STAGE_REFINED && value == bsm_invalid_disparity(&clean)));
      }
    }
    return maps;
  }

  const Stage& stage_;
  const Draw& draw_;
  PageYard& yard_;
  const int width_, height_;
  const std::array<size_t, 2> arena_size_;
  uint8_t* const arena_;
  Outputs frame_, row_;
  Picture picture_[2][2];      // pair, view
  uint8_t* input_[2][2] = {};  // view, plane: the row that is pushed
  std::map<std::array<size_t, 3>, Maps> expected_;

  // The model of the context.
  bsm_context* context_ = nullptr;
  size_t opened_ = 0;    // configuration
  size_t streamed_ = 0;  // pair whose rows are pushed
  int32_t delay_ = 0;
  int pushed_ = 0, pulled_ = 0, rows_ = 0;
  bool ended_ = false;
};

}  // namespace

void play_calls(const Stage& stage, const Draw& draw, PageYard& yard, int calls) {
  yard.clear(draw(0, 1) == 0 ? GuardedBuffer::Edge::kEnd : GuardedBuffer::Edge::kBegin);
  Player(stage, draw, yard).play(calls);
}

}  // namespace bsm::test
