#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "verification/study/run_data.hpp"

namespace verification {

/// What a caller hears while a suite runs; calls never overlap.
struct SuiteListener {
  std::function<void(long done, long total, const std::string& run)> run_ended;
  std::function<void(const StudyData&)> study_ended;
};

/// Everything that a suite of studies came to.
struct SuiteOutcome {
  reports::Results results;  ///< in the order of the studies, whatever the number of jobs
  std::vector<std::string>
      failures;  ///< runs that could not be simulated at all: an error of solver or program
};

/// Runs every simulation of the studies on `jobs` threads, longest first, and writes DIR: each run's scene,
/// profile and history as soon as it ends, the tables at the end. Results do not depend on `jobs`. Throws
/// reports::IoError when DIR cannot be written; the tables of the studies that had ended are then written if
/// at all possible.
SuiteOutcome run_suite(const std::vector<Study>& studies, const std::filesystem::path& out, int jobs,
                       const SuiteListener& listener);

}  // namespace verification
