#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <vector>

#include "verification/study/study.hpp"

namespace verification {

/// One piece of a suite's work: run `run` of study `study`, case `run` of its [stability], the reference that
/// a run needs, or the study's [control].
struct Job {
  enum class Kind { Run, Limit, Reference, Control };

  std::size_t study, run;
  double cost;  ///< estimated, in arbitrary units
  Kind kind = Kind::Run;
};

/// Jobs in the order in which they are taken.
struct Schedule {
  /// On all threads. References that take long, each once as far as any run needs it, so that no run has to
  /// wait for one; then the longest first, so that no long one is left for the end.
  std::vector<Job> shared;
  std::vector<Job> alone;  ///< after those, one at a time: runs whose time is to be measured
};
Schedule schedule(const std::vector<Study>& studies);

/// Performs every job on `threads` threads, in order. The first exception stops it: no further job is taken,
/// those under way end, and it is returned; null if all went well.
std::exception_ptr perform_all(const std::vector<Job>& jobs, int threads,
                               const std::function<void(const Job&)>& perform);

}  // namespace verification
