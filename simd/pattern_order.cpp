// Makes the order of a pattern: sorts its pairs by the points that they share.
#include "simd/pattern_order.h"

#if BSM_ARCH_X86_64 || BSM_ARCH_SIMD128
#include "simd/pattern_points.h"

namespace bsm {
namespace {

// A point with n pairs begins (n + 2) / 3 triples at most.
int32_t most_triples(int32_t bits) {
  const int32_t points = bits < kMaxPoints ? bits : kMaxPoints;
  return ((bits + 2 * points) / 3 + kTripleGroup - 1) / kTripleGroup * kTripleGroup;
}

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

// Of a pair's points that which more pairs share, and the other one.
Numbers by_shares(const PatternOrder& order, uint32_t pair) {
  const Numbers n = numbers_of(pair);
  const bool p_first = order.shares[n.p] != order.shares[n.q] ? order.shares[n.p] > order.shares[n.q] : n.p > n.q;
  return p_first ? n : Numbers{n.q, n.p};
}

void list_triples(int32_t bits, PatternOrder& order) {
  const int32_t points = order.points.count;
  BSM_MEMSET(order.shares, 0, sizeof order.shares);
  BSM_MEMSET(order.next, 0, sizeof order.next);
  for (int32_t i = 0; i < bits; ++i) {
    const Numbers n = numbers_of(order.points.pairs[i]);
    ++order.shares[n.p];
    ++order.shares[n.q];
  }
  for (int32_t i = 0; i < bits; ++i) ++order.next[by_shares(order, order.points.pairs[i]).p];
  int32_t places = 0;
  for (int32_t i = 0; i < points; ++i) {
    const int32_t count = order.next[i];
    order.next[i] = static_cast<uint16_t>(places);
    places += (count + 2) / 3 * 3;
  }
  order.triples_count = (places / 3 + kTripleGroup - 1) / kTripleGroup * kTripleGroup;
  const uint16_t none = static_cast<uint16_t>(8 * points);
  for (int32_t i = 0; i < order.triples_count; ++i) order.triples[i] = PatternOrder::Triple{none, {none, none, none}};
  for (int32_t i = 0; i < bits; ++i) {
    const Numbers n = by_shares(order, order.points.pairs[i]);
    const int32_t place = order.next[n.p]++;
    order.triples[place / 3].shared = static_cast<uint16_t>(8 * n.p);
    order.triples[place / 3].others[place % 3] = static_cast<uint16_t>(8 * n.q);
  }
}

}  // namespace

uint64_t pattern_order_bytes(int32_t bits) {
  return sizeof(PatternOrder) + static_cast<uint64_t>(bits) * sizeof(uint32_t) +
         static_cast<uint64_t>(most_triples(bits)) * sizeof(PatternOrder::Triple);
}

const PatternOrder* make_pattern_order(const Pattern& pattern, void* memory) {
  PatternOrder* const order = static_cast<PatternOrder*>(memory);
  order->triples = reinterpret_cast<PatternOrder::Triple*>(order + 1);
  order->partners = reinterpret_cast<uint32_t*>(order->triples + most_triples(pattern.bits));
  number_points(pattern, order->points);
  list_groups(pattern.bits, *order);
  list_triples(pattern.bits, *order);
  return order;
}

}  // namespace bsm
#endif
