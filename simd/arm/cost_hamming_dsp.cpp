// cost_hamming, DSP: two candidates side by side, whose counts are added up while they are small.
// Bound, per candidate and 128 bits: 4 loads and 2 that both share, 8 operations to differ and to mask, 30 to count.
#include "platform/compiler.h"

#if BSM_ARCH_DSP
#include "simd/arm/candidates.h"
#include "simd/arm/dsp.h"
#include "simd/kernels.h"

namespace bsm {
namespace {

// Masks of the counts' fields. Held in registers: shifting the other operand is free then.
struct Fields {
  uint32_t pairs = 0x55555555, nibbles = 0x33333333, bytes = 0x0f0f0f0f;
};

// Set bits of a word by nibble, each at most 4.
inline uint32_t count_nibbles(const Fields& fields, uint32_t word) {
  word -= word >> 1 & fields.pairs;
  return (word & fields.nibbles) + (word >> 2 & fields.nibbles);
}

inline uint32_t add_nibbles(const Fields& fields, uint32_t nibbles) {
  return (nibbles & fields.bytes) + (nibbles >> 4 & fields.bytes);
}

// A word of the pixel whose costs are counted.
struct Own {
  uint32_t descriptor, mask;
};

// Costs of two candidates by kWords words, 2 or 4; other: the first of them, the second `step` bytes on.
template <int32_t kWords>
inline uint32_t count_two(const Fields& fields, const Own* own, const uint8_t* other, ptrdiff_t step) {
  uint32_t first_bytes = 0, second_bytes = 0;
  BSM_UNROLL
  for (int32_t half = 0; half < kWords / 2; ++half) {
    uint32_t first = 0, second = 0;
    BSM_UNROLL
    for (int32_t k = 2 * half; k < 2 * half + 2; ++k) {
      const Own word = own[k];
      first += count_nibbles(fields, (word.descriptor ^ load32(other + 4 * k)) & word.mask);
      second += count_nibbles(fields, (word.descriptor ^ load32(other + 4 * k + step)) & word.mask);
    }
    first_bytes += add_nibbles(fields, first);
    second_bytes += add_nibbles(fields, second);
  }
  return __usad8(first_bytes, 0) | __usad8(second_bytes, 0) << 16;
}

// Cost of one candidate by some words, which is left over where their number is odd.
BSM_NOINLINE uint32_t count_one(const Own* own, const uint8_t* other, int32_t words) {
  uint32_t count = 0;
  for (const Own* const end = own + words; own != end; ++own, other += 4) {
    const uint32_t nibbles = count_nibbles(Fields{}, (own->descriptor ^ load32(other)) & own->mask);
    count = __usada8(add_nibbles(Fields{}, nibbles), 0, count);
  }
  return count;
}

// The costs of `count` consecutive candidates by kWords words of their descriptors, added to those of the words before them,
// of which `kept` keeps all bits or none.
template <int32_t kWords>
BSM_NOINLINE void count_costs(const uint8_t* descriptor, const uint8_t* mask, const uint8_t* other, ptrdiff_t step,
                              int32_t count, uint32_t kept, uint16_t* cost) {
  Fields fields;
  __asm__("" : "+r"(fields.pairs), "+r"(fields.nibbles), "+r"(fields.bytes));  // no constants to the compiler
  Own own[kWords];
  for (int32_t k = 0; k < kWords; ++k) own[k] = Own{load32(descriptor + 4 * k), load32(mask + 4 * k)};
  for (; count > 1; count -= 2, other += 2 * step, cost += 2) {
    BSM_KEEP_ORDER();  // the words stay in memory: the registers are for the counts
    const uint32_t bits = (load32(cost) & kept) + count_two<kWords>(fields, own, other, step);
    BSM_MEMCPY(cost, &bits, sizeof bits);
  }
  if (count == 1) *cost = static_cast<uint16_t>((*cost & kept) + count_one(own, other, kWords));
}

}  // namespace

uint64_t cost_hamming_dsp_scratch(const KernelShape& shape) {
  return static_cast<uint32_t>(shape.bits) / 8;  // a mask of all bits
}

// For size: what it does around the counts is little.
BSM_COLD void cost_hamming_dsp(const CostHammingArgs& args) {
  const ptrdiff_t bytes = args.bits / 8;
  const ptrdiff_t step = args.view == 0 ? -bytes : bytes;
  const uint8_t* mask = args.own_mask;
  if (mask == nullptr) {
    BSM_MEMSET(args.scratch, 0xff, static_cast<size_t>(bytes));
    mask = static_cast<const uint8_t*>(args.scratch);
  }
  const uint8_t* own = args.own;
  uint16_t* cost = args.cost;
  for (int32_t x = 0; x < args.width; ++x, own += bytes, cost += args.stride) {
    const Candidates inside = candidates_of(args, x);
    for (int32_t level = 0; level < inside.begin; ++level) cost[level] = kNoCost;
    const uint8_t* other = args.other + inside.first * bytes;
    const int32_t count = inside.end - inside.begin;
    uint16_t* to = cost + inside.begin;
    ptrdiff_t at = bytes % 16;
    if (at != 0) count_costs<2>(own, mask, other, step, count, 0, to);
    for (uint32_t kept = at != 0 ? ~0u : 0u; at < bytes; at += 16, kept = ~0u) {
      count_costs<4>(own + at, mask + at, other + at, step, count, kept, to);
    }
    for (int32_t level = inside.end; level < args.stride; ++level) cost[level] = kNoCost;
    if (args.own_mask != nullptr) mask += bytes;
  }
}

}  // namespace bsm
#endif
