// Makes the order of a pattern: sorts its pairs by the points that they share.
#include "simd/pattern_order.h"

#if BSM_ARCH_X86_64
#include "simd/pattern_points.h"

namespace bsm {
namespace {

struct Numbers {
  int32_t p, q;
};

Numbers numbers_of(uint32_t pair) {
  return Numbers{static_cast<int32_t>((pair & 0xffff) / 8), static_cast<int32_t>((pair >> 16) / 8)};
}

void list_groups(int32_t bits, PatternOrder& order) {
  BSM_MEMSET(order.shares, 0, sizeof order.shares);
  for (int32_t i = 0; i < bits; ++i) ++order.shares[numbers_of(order.points.pairs[i]).p];
  order.groups_count = 0;
  int32_t places = 0;
  for (int32_t size = 1; places != bits; ++size) {
    for (int32_t i = 0; i < order.points.count; ++i) {
      if (order.shares[i] != size) continue;
      order.groups[order.groups_count++] = PatternOrder::Group{static_cast<uint16_t>(8 * i), static_cast<uint16_t>(size)};
      order.next[i] = static_cast<uint16_t>(places);
      places += size;
    }
  }
  for (int32_t i = 0; i < bits; ++i) {
    const uint32_t pair = order.points.pairs[i];
    order.partners[order.next[numbers_of(pair).p]++] = pair >> 16 | static_cast<uint32_t>(i) << 16;
  }
}

}  // namespace

uint64_t pattern_order_bytes(int32_t bits) {
  return sizeof(PatternOrder) + static_cast<uint64_t>(bits) * sizeof(uint32_t);
}

const PatternOrder* make_pattern_order(const Pattern& pattern, void* memory) {
  PatternOrder* const order = static_cast<PatternOrder*>(memory);
  order->partners = reinterpret_cast<uint32_t*>(order + 1);
  number_points(pattern, order->points);
  list_groups(pattern.bits, *order);
  return order;
}

}  // namespace bsm
#endif
