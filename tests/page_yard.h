// page_yard.h - pieces of memory for kernels under test: each ends (or begins) at a page that may not be touched and has
// known bytes on its other side, so that a foreign read ends the program and a foreign write is found.
#ifndef BSM_TESTS_PAGE_YARD_H
#define BSM_TESTS_PAGE_YARD_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "guarded.h"
#include "yard.h"

namespace bsm::test {

class PageYard final : public Yard {
 public:
  // Forgets all pieces; the next ones lie at the given side of a forbidden page.
  void clear(GuardedBuffer::Edge edge);
  // At the end of a page a piece ends as late as the alignment of its size allows; alignments are a page at most.
  uint8_t* take(size_t bytes, size_t alignment) override;
  bool intact() const override;

 private:
  struct Piece {
    uint8_t* begin;
    uint8_t* end;
    uint8_t* fence_begin;
    uint8_t* fence_end;
  };
  std::vector<std::unique_ptr<GuardedBuffer>> regions_[2];  // by edge; kept for the next cases
  std::vector<Piece> pieces_;
  GuardedBuffer::Edge edge_ = GuardedBuffer::Edge::kEnd;
};

}  // namespace bsm::test

#endif  // BSM_TESTS_PAGE_YARD_H
