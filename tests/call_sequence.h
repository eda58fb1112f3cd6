// call_sequence.h - plays calls in any order on one context and holds the library to its contract: the status of each call,
// the rows that come out, and that nothing else is touched.
#ifndef BSM_TESTS_CALL_SEQUENCE_H
#define BSM_TESTS_CALL_SEQUENCE_H

#include <functional>

#include "bsm/bsm.h"
#include "images.h"
#include "matching.h"
#include "page_yard.h"

namespace bsm::test {

// A number in low..high: from a generator or from a fuzzer's input.
using Draw = std::function<int(int low, int high)>;

// What is played with. The configurations differ in anything but the size and the format of the images.
struct Stage {
  bsm_config config[2];
  EncodedPair pair[2];  // rows without gaps
};

// Plays `calls` calls drawn from: frames, rows pushed and pulled, streams ended early or abandoned, resets, contexts opened
// anew in the same arena, arenas used for other things in between, and calls with every kind of mistake. Every buffer lies
// between pages that may not be touched. What comes out is compared with contexts of their own that did nothing else.
void play_calls(const Stage& stage, const Draw& draw, PageYard& yard, int calls);

}  // namespace bsm::test

#endif  // BSM_TESTS_CALL_SEQUENCE_H
