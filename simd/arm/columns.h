// Columns around the pixels at an end of a row, copied to where those outside the row have values too.
#ifndef BSM_SIMD_ARM_COLUMNS_H
#define BSM_SIMD_ARM_COLUMNS_H

#include "simd/arm/neon.h"

namespace bsm {
namespace {

constexpr int32_t kColumnsAtOnce = 8;  // as many columns may be written beyond the last one

inline void fill_columns(uint8_t value, uint8_t* out) {
  vst1_u8(out, vdup_n_u8(value));
}

inline void fill_columns(uint16_t value, uint16_t* out) {
  vst1q_u16(out, vdupq_n_u16(value));
}

// The columns first..first + count - 1 of a row, some of which lie in it; `left` and `right` for those that do not, of which
// at most eight lie before the row.
template <class T>
inline void copy_columns(const T* row, int32_t width, int32_t first, int32_t count, T left, T right, T* out) {
  const int32_t begin = first < 0 ? -first : 0;
  const int32_t end = first + count > width ? width - first : count;
  if (begin != 0) fill_columns(left, out);
  const T* const from = row + first;
  int32_t i = begin;
  for (; i + kColumnsAtOnce <= end; i += kColumnsAtOnce) BSM_MEMCPY(out + i, from + i, kColumnsAtOnce * sizeof(T));
  if (end - begin >= kColumnsAtOnce) {
    i = end - kColumnsAtOnce;
    BSM_MEMCPY(out + i, from + i, kColumnsAtOnce * sizeof(T));
  } else {
    for (; i < end; ++i) out[i] = from[i];
  }
  for (i = end; i < count; i += kColumnsAtOnce) fill_columns(right, out + i);
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_ARM_COLUMNS_H
