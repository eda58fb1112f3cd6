// api_mistakes.h - calls of the public functions that have to fail, each with the status that it has to return.
#ifndef BSM_TESTS_API_MISTAKES_H
#define BSM_TESTS_API_MISTAKES_H

#include <functional>
#include <vector>

#include "api_world.h"

namespace bsm::test {

// A call that has to fail. `prepare` runs before the snapshot.
struct Mistake {
  const char* what;
  bsm_status expected;
  std::function<bsm_status(World&)> call;
  std::function<void(World&)> prepare;
};

// A configuration with one field wrong, in every function that takes one.
std::vector<Mistake> config_mistakes();
// Null pointers.
std::vector<Mistake> null_mistakes();
// Calls at the wrong time, memory that is no context, outputs that were not asked for, strides and addresses.
std::vector<Mistake> use_mistakes();

}  // namespace bsm::test

#endif  // BSM_TESTS_API_MISTAKES_H
