// descriptor_compare, SVE: a pair is one comparison of a vector of luma values, sixteen pairs fill a 16-bit lane.
// Bound, per pair and vector of 16-bit lanes: 2 loads, 1 comparison, 1 predicated OR.
#include "platform/compiler.h"

#if BSM_ARCH_SVE
#include "simd/arm/transpose_sve.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

// Sixteen bits of the pixels from x on.
inline svuint16_t compare_sixteen(const uint16_t* const* rows, const PixelPair* pairs, int32_t x, svbool_t pixels) {
  svuint16_t bits = svdup_u16(0);
  BSM_UNROLL
  for (int32_t i = 0; i < 16; ++i) {
    const svuint16_t p = svld1(pixels, rows[pairs[i].py] + pairs[i].px + x);
    const svuint16_t q = svld1(pixels, rows[pairs[i].qy] + pairs[i].qx + x);
    bits = svorr_m(svcmpgt(pixels, p, q), bits, static_cast<uint16_t>(1 << i));
  }
  return bits;
}

}  // namespace

uint64_t descriptor_compare_sve_scratch(const KernelShape&) {
  return 0;
}

void descriptor_compare_sve(const DescriptorCompareArgs& args) {
  const uint16_t* const* rows = args.rows + args.pattern.radius;
  const ptrdiff_t bytes = args.pattern.bits / 8;
  for (int32_t x = 0; x < args.width; x += lanes16()) {
    const svbool_t pixels = svwhilelt_b16(x, args.width);
    uint8_t* out = args.out + x * bytes;
    for (int32_t first = 0; first < args.pattern.bits; first += 64, out += 8) {
      const PixelPair* pairs = args.pattern.pairs + first;
      const svuint16_t a = compare_sixteen(rows, pairs, x, pixels);
      const svuint16_t b = compare_sixteen(rows, pairs + 16, x, pixels);
      const svuint16_t c = compare_sixteen(rows, pairs + 32, x, pixels);
      const svuint16_t d = compare_sixteen(rows, pairs + 48, x, pixels);
      store_quarters(a, b, c, d, args.width - x, out, bytes);
    }
  }
}

}  // namespace bsm
#endif
