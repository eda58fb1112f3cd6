// cost_hamming, MVE: sixteen bytes of a candidate at once, counted by a table of every byte's bits.
// Bound, per candidate and 128 bits: 1 load, 1 gather, 3 operations; a store.
#include "platform/compiler.h"

#if BSM_ARCH_MVE
#include "simd/arm/candidates.h"
#include "simd/arm/mve.h"
#include "simd/arm/population.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

// The costs of `count` consecutive candidates, `step` bytes apart, of descriptors of up to 16 bytes.
void count_short(const uint8_t* own, const uint8_t* mask, const uint8_t* other, ptrdiff_t step, int32_t count, int32_t bytes,
                 const uint8_t* population, uint16_t* cost) {
  const mve_pred16_t bits = vctp8q(static_cast<uint32_t>(bytes));
  const uint8x16_t descriptor = vldrbq_z_u8(own, bits);
  const uint8x16_t kept = vldrbq_z_u8(mask, bits);
  if (bytes == 16) {
    for (; count > 0; --count, other += step) {
      const uint8x16_t differing = vandq_u8(veorq_u8(descriptor, vldrbq_u8(other)), kept);
      *cost++ = static_cast<uint16_t>(vaddvq_u8(vldrbq_gather_offset_u8(population, differing)));
    }
    return;
  }
  for (; count > 0; --count, other += step) {
    const uint8x16_t differing = vandq_u8(veorq_u8(descriptor, vldrbq_z_u8(other, bits)), kept);
    *cost++ = static_cast<uint16_t>(vaddvq_u8(vldrbq_gather_offset_u8(population, differing)));
  }
}

// The same for descriptors of any length.
void count_long(const uint8_t* own, const uint8_t* mask, const uint8_t* other, ptrdiff_t step, int32_t count, int32_t bytes,
                const uint8_t* population, uint16_t* cost) {
  for (; count > 0; --count, other += step) {
    uint32_t sum = 0;
    int32_t at = 0;
    for (; at + 16 <= bytes; at += 16) {
      const uint8x16_t differing = vandq_u8(veorq_u8(vldrbq_u8(own + at), vldrbq_u8(other + at)), vldrbq_u8(mask + at));
      sum = vaddvaq_u8(sum, vldrbq_gather_offset_u8(population, differing));
    }
    if (at < bytes) {
      const mve_pred16_t half = vctp8q(8);
      const uint8x16_t differing = veorq_u8(vldrbq_z_u8(own + at, half), vldrbq_z_u8(other + at, half));
      sum = vaddvaq_u8(sum, vldrbq_gather_offset_u8(population, vandq_u8(differing, vldrbq_z_u8(mask + at, half))));
    }
    *cost++ = static_cast<uint16_t>(sum);
  }
}

}  // namespace

uint64_t cost_hamming_mve_scratch(const KernelShape& shape) {
  return kPopulationBytes + static_cast<uint32_t>(shape.bits) / 8;  // and a mask of all bits
}

void cost_hamming_mve(const CostHammingArgs& args) {
  const uint8_t* population = make_population(args.scratch);
  const int32_t bytes = args.bits / 8;
  const ptrdiff_t step = args.view == 0 ? -bytes : bytes;
  const uint8_t* mask = args.own_mask;
  if (mask == nullptr) {
    uint8_t* const all = static_cast<uint8_t*>(args.scratch) + kPopulationBytes;
    BSM_MEMSET(all, 0xff, static_cast<size_t>(bytes));
    mask = all;
  }
  const uint8_t* own = args.own;
  uint16_t* cost = args.cost;
  for (int32_t x = 0; x < args.width; ++x, own += bytes, cost += args.stride) {
    const Candidates inside = candidates_of(args, x);
    for (int32_t level = 0; level < inside.begin; ++level) cost[level] = kNoCost;
    const uint8_t* other = args.other + inside.first * bytes;
    const int32_t count = inside.end - inside.begin;
    if (bytes <= 16) {
      count_short(own, mask, other, step, count, bytes, population, cost + inside.begin);
    } else {
      count_long(own, mask, other, step, count, bytes, population, cost + inside.begin);
    }
    for (int32_t level = inside.end; level < args.stride; ++level) cost[level] = kNoCost;
    if (args.own_mask != nullptr) mask += bytes;
  }
}

}  // namespace bsm
#endif
