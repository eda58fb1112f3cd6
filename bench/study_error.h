// What stops a measurement: a file, the machine or a refused configuration, in words for the user.
#ifndef BSM_BENCH_STUDY_ERROR_H
#define BSM_BENCH_STUDY_ERROR_H

#include <stdexcept>

namespace bsm::bench {

class StudyError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace bsm::bench

#endif  // BSM_BENCH_STUDY_ERROR_H
