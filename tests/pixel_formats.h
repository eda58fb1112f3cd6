// pixel_formats.h - every pixel format and the bytes of its rows. Freestanding.
#ifndef BSM_TESTS_PIXEL_FORMATS_H
#define BSM_TESTS_PIXEL_FORMATS_H

#include "bsm/bsm.h"
#include "rng.h"

namespace bsm::test {

inline constexpr bsm_format kAllFormats[] = {BSM_FORMAT_GRAY8,  BSM_FORMAT_RGB24,  BSM_FORMAT_BGR24,
                                             BSM_FORMAT_RGBA32, BSM_FORMAT_BGRA32, BSM_FORMAT_RGB565,
                                             BSM_FORMAT_NV12,   BSM_FORMAT_NV21,   BSM_FORMAT_YUYV};

inline bool has_chroma_plane(bsm_format format) {
  return format == BSM_FORMAT_NV12 || format == BSM_FORMAT_NV21;
}

inline bsm_format any_format(Rng& rng) {
  return kAllFormats[rng.range(0, static_cast<int>(sizeof kAllFormats / sizeof *kAllFormats) - 1)];
}

// Bytes of a row of pixels of plane 0 and of the chroma plane.
inline int row_bytes(bsm_format format, int width) {
  switch (format) {
    case BSM_FORMAT_GRAY8:
    case BSM_FORMAT_NV12:
    case BSM_FORMAT_NV21:
      return width;
    case BSM_FORMAT_RGB24:
    case BSM_FORMAT_BGR24:
      return 3 * width;
    case BSM_FORMAT_RGBA32:
    case BSM_FORMAT_BGRA32:
      return 4 * width;
    case BSM_FORMAT_RGB565:
      return 2 * width;
    case BSM_FORMAT_YUYV:
      return (width + 1) / 2 * 4;
  }
  return 0;
}

inline int chroma_row_bytes(int width) {
  return (width + 1) / 2 * 2;
}

}  // namespace bsm::test

#endif  // BSM_TESTS_PIXEL_FORMATS_H
