// edge_threshold for AVX2 and SSE4.2: a vector of pixels at once, the last one up to the end of the row.
// Include after the lanes of one instruction set.
#ifndef BSM_SIMD_X86_EDGE_THRESHOLD_LANES_H
#define BSM_SIMD_X86_EDGE_THRESHOLD_LANES_H

#include "simd/kernels.h"

namespace bsm {
namespace {

inline Bytes distance8(Bytes a, Bytes b) {
  return sub8(max8(a, b), min8(a, b));
}

// Edges of kLanes pixels. Pixels are summed in 16 bits, the even and the odd ones apart.
template <int32_t kPlanes>
inline Bytes edges(const EdgeThresholdArgs& args, int32_t x, Bytes limit) {
  const Bytes low_byte = set16(0xff);
  Bytes even = zero();
  Bytes odd = zero();
  BSM_UNROLL
  for (int32_t plane = 0; plane < kPlanes; ++plane) {
    const ptrdiff_t at = plane * args.plane_stride + x;
    const Bytes distance = distance8(load(args.lab + at), load(args.previous + at));
    even = add16(even, both(distance, low_byte));
    odd = add16(odd, right16<8>(distance));
  }
  const Bytes even_edge = both(equal16(max16(even, limit), even), set16(1));
  const Bytes odd_edge = both(equal16(max16(odd, limit), odd), set16(1));
  return either(even_edge, left16<8>(odd_edge));
}

template <int32_t kPlanes>
inline void find_edges(const EdgeThresholdArgs& args) {
  const Bytes limit = set16(args.threshold + 1);
  if (args.width < kLanes) {
    for (int32_t x = 0; x < args.width; ++x) {
      int32_t sum = 0;
      for (int32_t plane = 0; plane < kPlanes; ++plane) {
        const ptrdiff_t at = plane * args.plane_stride + x;
        const int32_t difference = args.lab[at] - args.previous[at];
        sum += difference < 0 ? -difference : difference;
      }
      args.edge[x] = sum > args.threshold ? 1 : 0;
    }
    return;
  }
  for (int32_t x = 0; x + kLanes < args.width; x += kLanes) store(args.edge + x, edges<kPlanes>(args, x, limit));
  const int32_t last = args.width - kLanes;
  store(args.edge + last, edges<kPlanes>(args, last, limit));
}

inline void threshold_edges(const EdgeThresholdArgs& args) {
  return args.planes == 3 ? find_edges<3>(args) : find_edges<1>(args);
}

}  // namespace
}  // namespace bsm

#endif  // BSM_SIMD_X86_EDGE_THRESHOLD_LANES_H
