// One walk along a row that knows the nearest valid pixels on both sides.
#include "core/holes.h"

#include "simd/kernels.h"

namespace bsm {
namespace {

constexpr int32_t kSurfaceStep = 24;  // sixteenths between two surfaces

// The nearest valid pixels at or before, and after, a position that only moves forward.
class Neighbours {
 public:
  Neighbours(const uint16_t* levels, int32_t width) : levels_(levels), width_(width) { seek(0); }

  void move_to(int32_t x) {
    if (x != after_) return;
    before_ = x;
    seek(x + 1);
  }
  bool has_before() const { return before_ >= 0; }
  bool has_after() const { return after_ < width_; }
  int32_t before() const { return before_; }
  int32_t after() const { return after_; }

 private:
  void seek(int32_t x) {
    while (x < width_ && levels_[x] >= kOccluded) ++x;
    after_ = x;
  }

  const uint16_t* levels_;
  int32_t width_;
  int32_t before_ = -1;
  int32_t after_ = 0;
};

}  // namespace

void fill_holes(const uint16_t* checked, const uint16_t* above, int32_t width, uint16_t* voted) {
  Neighbours near(checked, width);
  for (int32_t x = 0; x < width; ++x) {
    near.move_to(x);
    if (voted[x] != kNoLevel) continue;
    if (near.has_before() && (!near.has_after() || x - near.before() <= near.after() - x)) {
      voted[x] = static_cast<uint16_t>(whole_level(checked[near.before()]) << kLevelShift);
    } else if (near.has_after()) {
      voted[x] = static_cast<uint16_t>(whole_level(checked[near.after()]) << kLevelShift);
    } else {
      voted[x] = above != nullptr ? above[x] : uint16_t{0};
    }
  }
}

void cap_occlusions(const uint16_t* checked, int32_t width, uint16_t* cap) {
  Neighbours near(checked, width);
  for (int32_t x = 0; x < width; ++x) {
    near.move_to(x);
    cap[x] = 0xffff;
    if (checked[x] != kOccluded || !near.has_before() || !near.has_after()) continue;
    const int32_t before = checked[near.before()];
    const int32_t after = checked[near.after()];
    const int32_t lower = before < after ? before : after;
    if (before + after - 2 * lower > kSurfaceStep) {
      cap[x] = static_cast<uint16_t>((lower + kSurfaceStep) >> kLevelShift);
    }
  }
}

}  // namespace bsm
