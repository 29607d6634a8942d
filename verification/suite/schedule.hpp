#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <vector>

#include "verification/study/study.hpp"

namespace verification {

/// One piece of a suite's work: run `run` of study `study`, or case `run` of its [stability].
struct Job {
  std::size_t study, run;
  double cost;  ///< estimated, in arbitrary units
  bool measures_limit = false;
};

/// Jobs in the order in which they are taken.
struct Schedule {
  std::vector<Job> shared;  ///< on all threads, longest first, so that no long one is left for the end
  std::vector<Job> alone;   ///< after those, one at a time: runs whose time is to be measured
};
Schedule schedule(const std::vector<Study>& studies);

/// Performs every job on `threads` threads, in order. The first exception stops it: no further job is taken,
/// those under way end, and it is returned; null if all went well.
std::exception_ptr perform_all(const std::vector<Job>& jobs, int threads,
                               const std::function<void(const Job&)>& perform);

}  // namespace verification
