// page_yard.cpp - guarded pieces of memory that are mapped once and reused.
#include "page_yard.h"

#include <algorithm>
#include <cstring>

namespace bsm::test {
namespace {

constexpr size_t kFence = 256;
constexpr uint8_t kFenceByte = 0xa7;

size_t round_up(size_t value, size_t multiple) {
  return (value + multiple - 1) / multiple * multiple;
}

}  // namespace

void PageYard::clear(GuardedBuffer::Edge edge) {
  pieces_.clear();
  edge_ = edge;
}

uint8_t* PageYard::take(size_t bytes, size_t alignment) {
  const size_t rounded = round_up(bytes, alignment);
  const size_t needed = rounded + kFence;
  auto& regions = regions_[edge_ == GuardedBuffer::Edge::kEnd ? 0 : 1];
  const size_t index = pieces_.size();
  if (index == regions.size()) regions.emplace_back();
  std::unique_ptr<GuardedBuffer>& region = regions[index];
  if (!region || region->size() < needed) region = std::make_unique<GuardedBuffer>(round_up(needed, 4096), edge_);
  uint8_t* const region_end = region->data() + region->size();
  uint8_t* const begin = edge_ == GuardedBuffer::Edge::kEnd ? region_end - rounded : region->data();
  const Piece piece{
      begin, begin + bytes, std::max(region->data(), begin - std::min<ptrdiff_t>(kFence, begin - region->data())),
      std::min(region_end,
               begin + rounded + std::min<ptrdiff_t>(kFence, region_end - begin - static_cast<ptrdiff_t>(rounded)))};
  std::memset(piece.fence_begin, kFenceByte, static_cast<size_t>(piece.fence_end - piece.fence_begin));
  pieces_.push_back(piece);
  return begin;
}

bool PageYard::intact() const {
  const auto clean = [](const uint8_t* begin, const uint8_t* end) {
    return std::all_of(begin, end, [](uint8_t byte) { return byte == kFenceByte; });
  };
  return std::all_of(pieces_.begin(), pieces_.end(), [&](const Piece& piece) {
    return clean(piece.fence_begin, piece.begin) && clean(piece.end, piece.fence_end);
  });
}

}  // namespace bsm::test
