// Makes the order of a pattern: numbers its points, and sorts its pairs by those that they share.
#include "simd/pattern_order.h"

#if BSM_SORTS_PAIRS || BSM_ARCH_NEON
#include "simd/pattern_points.h"

namespace bsm {
namespace {
#if BSM_SORTS_PAIRS
// Pairs that repeat are counted apart when they are at least so many: else it takes as many groups.
constexpr int32_t kApart = 64;

int32_t round_up(int32_t value, int32_t multiple) {
  return (value + multiple - 1) / multiple * multiple;
}

int32_t most_singles(int32_t bits) {
  return bits + PatternOrder::kSingleGroup;
}

// A point with n pairs begins n / 3 + 1 triples at most, also when those that repeat are apart.
int32_t most_triples(int32_t bits) {
  const int32_t points = bits < kMaxPoints ? bits : kMaxPoints;
  return round_up(bits / 3 + points, PatternOrder::kTripleGroup) + PatternOrder::kTripleGroup;
}

void list_groups(int32_t bits, PatternOrder& order) {
  BSM_MEMSET(order.shares, 0, sizeof order.shares);
  for (int32_t i = 0; i < bits; ++i) ++order.shares[(order.points.pairs[i] & 0xffff) / 8];
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
    order.partners[order.next[(pair & 0xffff) / 8]++] = pair >> 16 | static_cast<uint32_t>(i) << 16;
  }
}

// Shell's sort.
void sort(uint32_t* values, int32_t count) {
  for (int32_t gap = count / 2; gap != 0; gap /= 2) {
    for (int32_t i = gap; i < count; ++i) {
      const uint32_t value = values[i];
      int32_t at = i;
      for (; at >= gap && values[at - gap] > value; at -= gap) values[at] = values[at - gap];
      values[at] = value;
    }
  }
}

// Sorted: the pairs with the point that more pairs share above the other one.
void sort_by_shares(int32_t bits, PatternOrder& order, uint32_t* pairs) {
  BSM_MEMSET(order.shares, 0, sizeof order.shares);
  for (int32_t i = 0; i < bits; ++i) {
    ++order.shares[(order.points.pairs[i] & 0xffff) / 8];
    ++order.shares[(order.points.pairs[i] >> 16) / 8];
  }
  for (int32_t i = 0; i < bits; ++i) {
    const uint32_t p = order.points.pairs[i] & 0xffff;
    const uint32_t q = order.points.pairs[i] >> 16;
    const int32_t more = order.shares[p / 8] - order.shares[q / 8];
    pairs[i] = more > 0 || (more == 0 && p > q) ? p << 16 | q : q << 16 | p;
  }
  sort(pairs, bits);
}

// Adds a pair to the singles and to the triples, whose last one it joins when it shares its point and there is a place.
void add(PatternOrder& order, uint32_t pair) {
  order.singles[order.singles_count++] = pair;
  const uint16_t none = static_cast<uint16_t>(8 * order.points.count);
  const uint16_t shared = static_cast<uint16_t>(pair >> 16);
  const PatternOrder::Triple* last = order.triples + order.triples_count;
  if (order.triples_count == order.triples_twice || last[-1].shared != shared || last[-1].others[2] != none) {
    order.triples[order.triples_count++] = PatternOrder::Triple{shared, {none, none, none}};
  }
  uint16_t* place = order.triples[order.triples_count - 1].others;
  while (*place != none) ++place;
  *place = static_cast<uint16_t>(pair);
}

// Fills the last groups up.
void end_groups(PatternOrder& order) {
  const uint16_t none = static_cast<uint16_t>(8 * order.points.count);
  while (order.singles_count % PatternOrder::kSingleGroup != 0) order.singles[order.singles_count++] = none * 0x10001u;
  while (order.triples_count % PatternOrder::kTripleGroup != 0) {
    order.triples[order.triples_count++] = PatternOrder::Triple{none, {none, none, none}};
  }
}

void list_counted(int32_t bits, PatternOrder& order) {
  uint32_t* const pairs = order.partners;  // not yet in use
  sort_by_shares(bits, order, pairs);
  int32_t repeated = 0;
  const auto for_each_pair = [pairs, bits](const auto& visit) {
    for (int32_t i = 0, begin = 0; i < bits; begin = i) {
      while (i < bits && pairs[i] == pairs[begin]) ++i;
      visit(pairs[begin], i - begin);
    }
  };
  for_each_pair([&repeated](uint32_t, int32_t times) { repeated += times / 2; });
  const bool apart = repeated >= kApart;
  order.singles_count = order.singles_twice = order.triples_count = order.triples_twice = 0;
  if (apart) {
    for_each_pair([&order](uint32_t pair, int32_t times) {
      for (; times >= 2; times -= 2) add(order, pair);
    });
    end_groups(order);
    order.singles_twice = order.singles_count;
    order.triples_twice = order.triples_count;
  }
  for_each_pair([&order, apart](uint32_t pair, int32_t times) {
    for (times = apart ? times % 2 : times; times != 0; --times) add(order, pair);
  });
  end_groups(order);
}

#endif
}  // namespace

#if BSM_SORTS_PAIRS
uint64_t pattern_order_bytes(int32_t bits) {
  return sizeof(PatternOrder) + static_cast<uint64_t>(2 * bits + most_singles(bits)) * sizeof(uint32_t) +
         static_cast<uint64_t>(most_triples(bits)) * sizeof(PatternOrder::Triple);
}

const PatternOrder* make_pattern_order(const Pattern& pattern, void* memory) {
  PatternOrder* const order = static_cast<PatternOrder*>(memory);
  order->triples = reinterpret_cast<PatternOrder::Triple*>(order + 1);
  order->singles = reinterpret_cast<uint32_t*>(order->triples + most_triples(pattern.bits));
  order->partners = order->singles + most_singles(pattern.bits);
  order->points.pairs = order->partners + pattern.bits;
  number_points(pattern, order->points);
  list_counted(pattern.bits, *order);
  list_groups(pattern.bits, *order);
  return order;
}
#else
uint64_t pattern_order_bytes(int32_t bits) {
  return sizeof(PatternOrder) + static_cast<uint32_t>(bits) * sizeof(uint32_t);
}

const PatternOrder* make_pattern_order(const Pattern& pattern, void* memory) {
  PatternOrder* const order = static_cast<PatternOrder*>(memory);
  order->points.pairs = reinterpret_cast<uint32_t*>(order + 1);
  number_points(pattern, order->points);
  return order;
}
#endif

}  // namespace bsm
#endif
