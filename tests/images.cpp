// images.cpp - makes and encodes the test images.
#include "images.h"

#include <algorithm>
#include <array>

#include "simd/yuv.h"

namespace bsm::test {
namespace {

void fill(ColorImage& image, int x, int y, int r, int g, int b) {
  uint8_t* pixel = image.at(x, y);
  pixel[0] = static_cast<uint8_t>(std::clamp(r, 0, 255));
  pixel[1] = static_cast<uint8_t>(std::clamp(g, 0, 255));
  pixel[2] = static_cast<uint8_t>(std::clamp(b, 0, 255));
}

void fill_noise(Rng& rng, ColorImage& image) {
  for (uint8_t& value : image.rgb) value = rng.byte();
}

void fill_few_colors(Rng& rng, ColorImage& image, const std::array<std::array<uint8_t, 3>, 4>& palette) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto& color = palette[static_cast<size_t>(rng.range(0, 3))];
      fill(image, x, y, color[0], color[1], color[2]);
    }
  }
}

void fill_gradient(ColorImage& image, int dx, int dy, int offset) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      fill(image, x, y, offset + dx * x + dy * y, 255 - offset - dx * x, (offset + 3 * x + 5 * y) % 256);
    }
  }
}

// Blobs of 2 x 2 pixels, so that a view moved by a few pixels can be told apart and smooth areas exist.
void fill_shifted(Rng& rng, ColorPair& pair, int shift) {
  ColorImage& left = pair.left;
  ColorImage wide(left.width + 64, left.height);
  for (int y = 0; y < wide.height; y += 2) {
    for (int x = 0; x < wide.width; x += 2) {
      const int r = rng.byte(), g = rng.byte(), b = rng.byte();
      for (int j = y; j < std::min(y + 2, wide.height); ++j) {
        for (int i = x; i < std::min(x + 2, wide.width); ++i) fill(wide, i, j, r, g, b);
      }
    }
  }
  for (int y = 0; y < left.height; ++y) {
    for (int x = 0; x < left.width; ++x) {
      const uint8_t* l = wide.at(x + 32, y);
      fill(pair.left, x, y, l[0], l[1], l[2]);
      const uint8_t* r = wide.at(std::clamp(x + 32 + shift, 0, wide.width - 1), y);
      fill(pair.right, x, y, r[0] + rng.range(-2, 2), r[1] + rng.range(-2, 2), r[2] + rng.range(-2, 2));
    }
  }
}

void fill_extremes(Rng& rng, ColorImage& image) {
  for (uint8_t& value : image.rgb) value = rng.one_in(2) ? 0 : 255;
}

template <typename PixelFunction>
ColorPair map_pixels(const ColorPair& pair, PixelFunction change) {
  ColorPair result = pair;
  for (ColorImage* image : {&result.left, &result.right}) {
    for (size_t i = 0; i < image->rgb.size(); i += 3) change(&image->rgb[i]);
  }
  return result;
}

// Where the pieces of a YUV format lie: Y of pixel (x, y), and U and V of the group that it belongs to.
struct YuvLayout {
  int y_step, u, v;
  bool planar;
};
YuvLayout layout_of(bsm_format format) {
  switch (format) {
    case BSM_FORMAT_NV12:
      return {1, 0, 1, true};
    case BSM_FORMAT_NV21:
      return {1, 1, 0, true};
    default:
      return {2, 1, 3, false};
  }
}
ptrdiff_t chroma_offset(const PixelImage& image, int x, int y) {
  return layout_of(image.format).planar ? y / 2 * image.chroma_stride + x / 2 * 2 : y * image.stride + x / 2 * 4;
}
uint8_t clamp_to_byte(int value) {
  return static_cast<uint8_t>(std::clamp(value, 0, 255));
}

// Full-range BT.601, coefficients in 2^-16.
void encode_yuv(const ColorImage& image, PixelImage* result) {
  const YuvLayout layout = layout_of(result->format);
  const int rows = layout.planar ? 2 : 1;
  std::vector<uint8_t>& chroma = layout.planar ? result->chroma : result->bytes;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const uint8_t* rgb = image.at(x, y);
      const int luma = (19595 * rgb[0] + 38470 * rgb[1] + 7471 * rgb[2] + (1 << 15)) >> 16;
      result->bytes[static_cast<size_t>(y * result->stride + x * layout.y_step)] = static_cast<uint8_t>(luma);
      if (x % 2 != 0 || y % rows != 0) continue;
      int sum[3] = {}, count = 0;
      for (int j = y; j < std::min(y + rows, image.height); ++j) {
        for (int i = x; i < std::min(x + 2, image.width); ++i, ++count) {
          for (int c = 0; c < 3; ++c) sum[c] += image.at(i, j)[c];
        }
      }
      const int r = sum[0] / count, g = sum[1] / count, b = sum[2] / count;
      const ptrdiff_t group = chroma_offset(*result, x, y);
      const int u = (-11059 * r - 21709 * g + 32768 * b + (128 << 16) + (1 << 15)) >> 16;
      const int v = (32768 * r - 27439 * g - 5329 * b + (128 << 16) + (1 << 15)) >> 16;
      chroma[static_cast<size_t>(group + layout.u)] = clamp_to_byte(u);
      chroma[static_cast<size_t>(group + layout.v)] = clamp_to_byte(v);
    }
  }
}

}  // namespace

const char* format_name(bsm_format format) {
  switch (format) {
    case BSM_FORMAT_GRAY8:
      return "gray8";
    case BSM_FORMAT_RGB24:
      return "rgb24";
    case BSM_FORMAT_BGR24:
      return "bgr24";
    case BSM_FORMAT_RGBA32:
      return "rgba32";
    case BSM_FORMAT_BGRA32:
      return "bgra32";
    case BSM_FORMAT_RGB565:
      return "rgb565";
    case BSM_FORMAT_NV12:
      return "nv12";
    case BSM_FORMAT_NV21:
      return "nv21";
    case BSM_FORMAT_YUYV:
      return "yuyv";
  }
  return "?";
}

bool is_yuv(bsm_format format) {
  return has_chroma_plane(format) || format == BSM_FORMAT_YUYV;
}

const char* stage_name(bsm_stage stage) {
  switch (stage) {
    case BSM_STAGE_COST:
      return "cost";
    case BSM_STAGE_MASKED:
      return "masked";
    case BSM_STAGE_AGGREGATED:
      return "aggregated";
    case BSM_STAGE_CHECKED:
      return "checked";
    case BSM_STAGE_REFINED:
      return "refined";
    default:
      return "?";
  }
}

const char* content_name(Content content) {
  switch (content) {
    case Content::kNoise:
      return "noise";
    case Content::kFewColors:
      return "few colors";
    case Content::kConstant:
      return "constant";
    case Content::kGradient:
      return "gradient";
    case Content::kShifted:
      return "shifted";
    case Content::kExtremes:
      return "extremes";
  }
  return "?";
}

ColorPair make_pair(Rng& rng, Content content, int width, int height, int shift) {
  ColorPair pair{ColorImage(width, height), ColorImage(width, height)};
  switch (content) {
    case Content::kNoise:
      fill_noise(rng, pair.left);
      fill_noise(rng, pair.right);
      break;
    case Content::kFewColors: {
      std::array<std::array<uint8_t, 3>, 4> palette{};
      for (auto& color : palette) {
        for (uint8_t& channel : color) channel = rng.byte();
      }
      fill_few_colors(rng, pair.left, palette);
      fill_few_colors(rng, pair.right, palette);
      break;
    }
    case Content::kConstant: {
      const int r = rng.byte(), g = rng.byte(), b = rng.byte();
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          fill(pair.left, x, y, r, g, b);
          fill(pair.right, x, y, r, g, b);
        }
      }
      break;
    }
    case Content::kGradient: {
      const int dx = rng.range(-6, 6), dy = rng.range(-6, 6), offset = rng.range(0, 255);
      fill_gradient(pair.left, dx, dy, offset);
      fill_gradient(pair.right, dx, dy, offset + shift);
      break;
    }
    case Content::kShifted:
      fill_shifted(rng, pair, shift);
      break;
    case Content::kExtremes:
      fill_extremes(rng, pair.left);
      fill_extremes(rng, pair.right);
      break;
  }
  return pair;
}

ColorPair to_gray(const ColorPair& pair) {
  return map_pixels(pair, [](uint8_t* pixel) { pixel[0] = pixel[2] = pixel[1]; });
}

ColorPair to_rgb565_colors(const ColorPair& pair) {
  return map_pixels(pair, [](uint8_t* pixel) {
    const int r = pixel[0] >> 3, g = pixel[1] >> 2, b = pixel[2] >> 3;
    pixel[0] = static_cast<uint8_t>(r << 3 | r >> 2);
    pixel[1] = static_cast<uint8_t>(g << 2 | g >> 4);
    pixel[2] = static_cast<uint8_t>(b << 3 | b >> 2);
  });
}

PixelImage encode(const ColorImage& image, bsm_format format, int padding) {
  PixelImage result;
  result.width = image.width;
  result.height = image.height;
  result.format = format;
  result.stride = row_bytes(format, image.width) + padding;
  result.bytes.resize(static_cast<size_t>(result.stride * image.height));
  if (has_chroma_plane(format)) {
    result.chroma_stride = chroma_row_bytes(image.width) + padding;
    result.chroma.resize(static_cast<size_t>(result.chroma_stride * ((image.height + 1) / 2)));
  }
  for (std::vector<uint8_t>* plane : {&result.bytes, &result.chroma}) {
    for (size_t i = 0; i < plane->size(); ++i) (*plane)[i] = static_cast<uint8_t>(i * 151 + 17);
  }
  if (is_yuv(format)) {
    encode_yuv(image, &result);
    return result;
  }
  const int pixel_bytes = row_bytes(format, 1);
  for (int y = 0; y < image.height; ++y) {
    uint8_t* out = result.bytes.data() + y * result.stride;
    for (int x = 0; x < image.width; ++x, out += pixel_bytes) {
      const uint8_t* in = image.at(x, y);
      switch (format) {
        case BSM_FORMAT_GRAY8:
          out[0] = in[1];
          break;
        case BSM_FORMAT_RGB24:
        case BSM_FORMAT_RGBA32:  // alpha keeps the noise of its position: it must not matter
          out[0] = in[0], out[1] = in[1], out[2] = in[2];
          break;
        case BSM_FORMAT_BGR24:
        case BSM_FORMAT_BGRA32:
          out[0] = in[2], out[1] = in[1], out[2] = in[0];
          break;
        case BSM_FORMAT_RGB565: {
          const int value = (in[0] >> 3) << 11 | (in[1] >> 2) << 5 | in[2] >> 3;
          out[0] = static_cast<uint8_t>(value & 255);
          out[1] = static_cast<uint8_t>(value >> 8);
          break;
        }
        default:
          break;
      }
    }
  }
  return result;
}

EncodedPair encode(const ColorPair& pair, bsm_format format, int padding) {
  return {encode(pair.left, format, padding), encode(pair.right, format, padding)};
}

ColorImage decode(const PixelImage& image) {
  const YuvLayout layout = layout_of(image.format);
  const std::vector<uint8_t>& chroma = layout.planar ? image.chroma : image.bytes;
  ColorImage colors(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const uint8_t luma = image.row(y)[x * layout.y_step];
      const uint8_t* group = &chroma[static_cast<size_t>(chroma_offset(image, x, y))];
      const ChromaTerms terms = chroma_terms(group[layout.u], group[layout.v]);
      uint8_t* rgb = colors.at(x, y);
      rgb[0] = channel_from_yuv(luma, terms.r);
      rgb[1] = channel_from_yuv(luma, terms.g);
      rgb[2] = channel_from_yuv(luma, terms.b);
      colors.luma.push_back(luma);
    }
  }
  return colors;
}

ColorPair decode(const EncodedPair& pair) {
  return {decode(pair.left), decode(pair.right)};
}

}  // namespace bsm::test
