// images.h - images made for the tests: random, flat and smooth ones, stereo pairs of known shift, and every pixel format.
#ifndef BSM_TESTS_IMAGES_H
#define BSM_TESTS_IMAGES_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bsm/bsm.h"
#include "check.h"
#include "pixel_formats.h"

namespace bsm::test {

// Colours of an image: 3 bytes R G B a pixel, rows without gaps. Images decoded from YUV keep Y, which their luma is made
// of.
struct ColorImage {
  int width = 0, height = 0;
  std::vector<uint8_t> rgb;
  std::vector<uint8_t> luma;

  ColorImage() = default;
  ColorImage(int w, int h) : width(w), height(h), rgb(static_cast<size_t>(w) * static_cast<size_t>(h) * 3) {}
  uint8_t* at(int x, int y) {
    return &rgb[(static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)) * 3];
  }
  const uint8_t* at(int x, int y) const {
    return &rgb[(static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)) * 3];
  }
};

struct ColorPair {
  ColorImage left, right;
};

// The bytes of an image in one of the library's formats; chroma is the second plane of those that have one, else empty.
struct PixelImage {
  int width = 0, height = 0;
  bsm_format format = BSM_FORMAT_RGB24;
  ptrdiff_t stride = 0;
  std::vector<uint8_t> bytes;
  ptrdiff_t chroma_stride = 0;
  std::vector<uint8_t> chroma = {};

  const uint8_t* row(int y) const { return bytes.data() + static_cast<ptrdiff_t>(y) * stride; }
  const uint8_t* chroma_row(int y) const {
    return chroma.empty() ? nullptr : chroma.data() + static_cast<ptrdiff_t>(y / 2) * chroma_stride;
  }
  // What the row API takes for row y.
  bsm_row planes(int y) const { return bsm_row{{row(y), chroma_row(y)}}; }
  bsm_image view() const { return bsm_image{{row(0), chroma_row(0)}, {stride, chroma_stride}}; }
};

struct EncodedPair {
  PixelImage left, right;
};

inline constexpr bsm_format kYuvFormats[] = {BSM_FORMAT_NV12, BSM_FORMAT_NV21, BSM_FORMAT_YUYV};
const char* format_name(bsm_format format);
bool is_yuv(bsm_format format);

// The stages of the local method, in order.
inline constexpr bsm_stage kStages[] = {BSM_STAGE_COST, BSM_STAGE_MASKED, BSM_STAGE_CHECKED, BSM_STAGE_REFINED};

const char* stage_name(bsm_stage stage);

enum class Content {
  kNoise,      // independent random colours
  kFewColors,  // noise over a handful of colours: many equal SADs and equal lumas
  kConstant,   // one colour everywhere, the same in both views
  kGradient,   // smooth ramps in all channels
  kShifted,    // noise blobs, the right view is the left one moved by a few pixels, plus a little noise
  kExtremes,   // only 0 and 255 in each channel: the largest lumas and SADs
};
inline constexpr Content kAllContents[] = {Content::kNoise,    Content::kFewColors, Content::kConstant,
                                           Content::kGradient, Content::kShifted,   Content::kExtremes};
const char* content_name(Content content);

// A pair of views of the given content.
ColorPair make_pair(Rng& rng, Content content, int width, int height, int shift = 3);

// The same with R = G = B everywhere.
ColorPair to_gray(const ColorPair& pair);

// The same with every colour rounded to one that rgb565 holds exactly (top bits repeated below).
ColorPair to_rgb565_colors(const ColorPair& pair);

// Encodes colours; gray8 takes the green channel, chroma is that of the mean colour. `padding` extra bytes end each row,
// filled with noise from their position.
PixelImage encode(const ColorImage& image, bsm_format format, int padding = 0);
EncodedPair encode(const ColorPair& pair, bsm_format format, int padding = 0);

// The colours that an image of a YUV format shows.
ColorImage decode(const PixelImage& image);
ColorPair decode(const EncodedPair& pair);

}  // namespace bsm::test

#endif  // BSM_TESTS_IMAGES_H
