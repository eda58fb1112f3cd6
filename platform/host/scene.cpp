// Renders the synthetic stereo scene: geometry, visibility and cameras. Textures are in scene_texture.cpp.
//
// Every surface is a plane in disparity space, d = base + slope_x * x + slope_y * y with (x, y) in left-image pixels, cut
// out by a shape that is fixed in the left image. A left pixel reads its surface at x; a right pixel solves x - d(x, y) =
// x_right for x. Of the surfaces that cover a pixel the one of largest disparity is in front.
#include "host/scene.h"

#include "host/scene_texture.h"

namespace bsm::host {
namespace {

// Coordinates and disparities are 64-bit fixed point with 16 fractional bits; images are at most 2^14 pixels wide and slopes
// below 1/2, so that no product here reaches 2^60.
constexpr int kFractionBits = 16;
constexpr int64_t kOne = int64_t{1} << kFractionBits;
constexpr int64_t kInFront = kOne / 16;  // disparity by which a surface has to be nearer to hide another

enum class Shape { kEverything, kBelowHorizon, kDisc, kRing, kBox, kPole, kTriangle };

// A surface as designed. Depth is in 1/256 of the disparity range: depth + depth_x * x / width + depth_y * y / height stays
// within 0..256 wherever the shape lies. Positions are in 1/256 of width and height, sizes in 1/256 of the smaller of them.
struct SurfaceDesign {
  Shape shape;
  int32_t depth, depth_x, depth_y;
  int32_t center_x, center_y;
  int32_t size_a, size_b;  // half width and half height; ring: outer and inner radius
  int32_t cosine, sine;    // of the shape's turn, in 1/256
};

constexpr SurfaceDesign kDesigns[] = {
    {Shape::kEverything, 26, 24, 0, 0, 0, 0, 0, 256, 0},         // wall
    {Shape::kBelowHorizon, -126, 0, 276, 0, 158, 0, 0, 256, 0},  // floor, rising toward the camera
    {Shape::kBox, 77, 60, 0, 56, 100, 46, 58, 247, 66},          // board, turned by 15 degrees
    {Shape::kDisc, 103, 40, -70, 179, 77, 46, 0, 256, 0},        // disc
    {Shape::kRing, 189, -50, 0, 120, 138, 52, 32, 256, 0},       // ring, the wall shows through
    {Shape::kBox, 182, 60, -40, 172, 204, 26, 24, 237, -97},     // small box
    {Shape::kPole, 215, 0, -30, 222, 128, 5, 0, 256, 0},         // pole from top to bottom
    {Shape::kTriangle, 206, 30, 20, 66, 204, 50, 44, 256, 0},    // triangle in front
};
constexpr int kSurfaceCount = sizeof(kDesigns) / sizeof(kDesigns[0]);
static_assert(kSurfaceCount == kTextureCount, "one texture per surface");

// A surface placed in an image; positions and sizes in 1/256 pixel.
struct Surface {
  SurfaceDesign design;
  int64_t base, slope_x, slope_y;
  int64_t center_x, center_y, size_a, size_b;

  int64_t disparity_at(int64_t x, int32_t y) const { return base + slope_x * x / kOne + slope_y * y; }
  // The x whose point the right view shows at right_x.
  int64_t x_seen_at(int64_t right_x, int32_t y) const { return (right_x + base + slope_y * y) * kOne / (kOne - slope_x); }
  bool covers(int64_t x, int32_t y) const;
};

int64_t magnitude(int64_t value) {
  return value < 0 ? -value : value;
}

bool Surface::covers(int64_t x, int32_t y) const {
  const int64_t from_x = x / 256 - center_x;
  const int64_t from_y = int64_t{y} * 256 - center_y;
  const int64_t turned_x = (from_x * design.cosine + from_y * design.sine) / 256;
  const int64_t turned_y = (from_y * design.cosine - from_x * design.sine) / 256;
  const int64_t distance2 = from_x * from_x + from_y * from_y;
  switch (design.shape) {
    case Shape::kEverything:
      return true;
    case Shape::kBelowHorizon:
      return from_y >= 0;
    case Shape::kDisc:
      return distance2 <= size_a * size_a;
    case Shape::kRing:
      return distance2 <= size_a * size_a && distance2 >= size_b * size_b;
    case Shape::kBox:
      return magnitude(turned_x) <= size_a && magnitude(turned_y) <= size_b;
    case Shape::kPole:
      return magnitude(from_x) <= size_a;
    case Shape::kTriangle:  // apex up
      return magnitude(from_y) <= size_b && 2 * size_b * magnitude(from_x) <= size_a * (from_y + size_b);
  }
  return false;
}

struct Stage {
  Surface surface[kSurfaceCount];
};

Stage make_stage(const SceneOptions& options) {
  const int64_t width = options.width, height = options.height;
  const int64_t span = options.num_disparities - 1 < width / 4 ? options.num_disparities - 1 : width / 4;
  const int64_t range = span * kOne;
  const int64_t unit = width < height ? width : height;
  Stage stage{};
  for (int i = 0; i < kSurfaceCount; ++i) {
    const SurfaceDesign& design = kDesigns[i];
    Surface& surface = stage.surface[i];
    surface.design = design;
    surface.base = options.min_disparity * kOne + range * design.depth / 256;
    surface.slope_x = range * design.depth_x / (256 * width);
    surface.slope_y = range * design.depth_y / (256 * height);
    surface.center_x = width * design.center_x;
    surface.center_y = height * design.center_y;
    surface.size_a = unit * design.size_a;
    surface.size_b = unit * design.size_b;
  }
  return stage;
}

// What a pixel shows: the surface, the x at which it is read, and its disparity.
struct Hit {
  int surface;
  int64_t x, disparity;
};

Hit front_in_left(const Stage& stage, int64_t left_x, int32_t y) {
  Hit hit{-1, 0, 0};
  for (int i = 0; i < kSurfaceCount; ++i) {
    const Surface& surface = stage.surface[i];
    const int64_t disparity = surface.disparity_at(left_x, y);
    if ((hit.surface < 0 || disparity > hit.disparity) && surface.covers(left_x, y)) hit = {i, left_x, disparity};
  }
  return hit;
}

Hit front_in_right(const Stage& stage, int64_t right_x, int32_t y) {
  Hit hit{-1, 0, 0};
  for (int i = 0; i < kSurfaceCount; ++i) {
    const Surface& surface = stage.surface[i];
    const int64_t x = surface.x_seen_at(right_x, y);
    const int64_t disparity = x - right_x;
    if ((hit.surface < 0 || disparity > hit.disparity) && surface.covers(x, y)) hit = {i, x, disparity};
  }
  return hit;
}

// 255 when the point of `here` lies inside the other image and nothing there is in front of it.
uint8_t visibility(const Hit& here, int64_t other_x, int32_t width, const Hit& there) {
  const bool inside = other_x >= 0 && other_x <= (width - 1) * kOne;
  return inside && there.disparity <= here.disparity + kInFront ? 255 : 0;
}

// 1/16 pixel, rounded to nearest, halves up.
int16_t to_map_value(int64_t disparity) {
  const int64_t shifted = disparity + kOne / 32 + (int64_t{1} << 40);  // positive, so that the division rounds down
  return static_cast<int16_t>(shifted / (kOne / 16) - (int64_t{1} << 40) / (kOne / 16));
}

uint8_t clamp_byte(int32_t value) {
  return static_cast<uint8_t>(value < 0 ? 0 : value > 255 ? 255 : value);
}

// Sensor noise within -3..3, most often 0.
int32_t sensor_noise(uint32_t seed, uint32_t camera, int32_t x, int32_t y, uint32_t channel) {
  const uint32_t bits = scene_hash(seed, 64 + 4 * camera + channel, static_cast<uint32_t>(x), static_cast<uint32_t>(y));
  return static_cast<int32_t>((bits & 3u) + (bits >> 2 & 3u)) - 3;
}

// The right camera: gain of each channel less a loss toward the corners, in 1/256, then an offset.
constexpr int32_t kRightGain[3] = {240, 230, 214};
constexpr int64_t kRightCornerLoss = 36;
constexpr int32_t kRightOffset = 6;

int32_t right_gain(const SceneOptions& options, int32_t x, int32_t y, int channel) {
  const int64_t from_x = 2 * int64_t{x} + 1 - options.width, from_y = 2 * int64_t{y} + 1 - options.height;
  const int64_t corner2 = int64_t{options.width} * options.width + int64_t{options.height} * options.height;
  return kRightGain[channel] - static_cast<int32_t>(kRightCornerLoss * (from_x * from_x + from_y * from_y) / corner2);
}

}  // namespace

void scene_row(const SceneOptions& options, int32_t y, const SceneRow& row) {
  const Stage stage = make_stage(options);
  for (int32_t x = 0; x < options.width; ++x) {
    const Hit left = front_in_left(stage, x * kOne, y);
    const Hit right = front_in_right(stage, x * kOne, y);
    if (row.left_truth != nullptr) row.left_truth[x] = to_map_value(left.disparity);
    if (row.right_truth != nullptr) row.right_truth[x] = to_map_value(right.disparity);
    if (row.left_visible != nullptr) {
      const int64_t right_x = x * kOne - left.disparity;
      row.left_visible[x] = visibility(left, right_x, options.width, front_in_right(stage, right_x, y));
    }
    if (row.right_visible != nullptr) {
      row.right_visible[x] = visibility(right, right.x, options.width, front_in_left(stage, right.x, y));
    }
    int32_t color[3];
    if (row.left != nullptr) {
      scene_texture(options.seed, left.surface, left.x, y * kOne, color);
      for (int c = 0; c < 3; ++c) {
        row.left[3 * x + c] = clamp_byte(color[c] + sensor_noise(options.seed, 0, x, y, static_cast<uint32_t>(c)));
      }
    }
    if (row.right != nullptr) {
      scene_texture(options.seed, right.surface, right.x, y * kOne, color);
      for (int c = 0; c < 3; ++c) {
        const int32_t seen = color[c] * right_gain(options, x, y, c) / 256 + kRightOffset;
        row.right[3 * x + c] = clamp_byte(seen + sensor_noise(options.seed, 1, x, y, static_cast<uint32_t>(c)));
      }
    }
  }
}

}  // namespace bsm::host
