// SAD of two stored CIELAB colours (eq. 5), for the scalar kernels.
#ifndef BSM_SIMD_SCALAR_SAD_H
#define BSM_SIMD_SCALAR_SAD_H

#include <stddef.h>
#include <stdint.h>

namespace bsm {

static inline uint32_t sad(const uint8_t* a, const uint8_t* b, ptrdiff_t plane_stride, int32_t planes) {
  uint32_t sum = 0;
  for (int32_t plane = 0; plane < planes; ++plane) {
    const uint32_t p = a[plane * plane_stride];
    const uint32_t q = b[plane * plane_stride];
    sum += p < q ? q - p : p - q;
  }
  return sum;
}

}  // namespace bsm

#endif  // BSM_SIMD_SCALAR_SAD_H
