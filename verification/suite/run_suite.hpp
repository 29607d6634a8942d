#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "verification/runs/run_data.hpp"
#include "verification/suite/kept_profiles.hpp"
#include "verification/suite/run_cache.hpp"

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
      failures;         ///< runs that could not be simulated at all: an error of solver or program
  long runs = 0;        ///< simulations, and
  long from_cache = 0;  ///< how many of them were taken over from the cache
};

/// Runs every simulation of the studies on `jobs` threads, longest first, and writes DIR: each run's scene
/// and the profiles that are wanted of it as soon as it ends, the tables at the end. Runs that the cache
/// holds are taken over; the others are added to it as they end, so that a suite that was stopped or killed
/// goes on where it was. Results do not depend on `jobs` or on the cache, except for timing.csv, which says
/// of each time whether it was measured in this run. Tables of an earlier suite in DIR go first: a DIR
/// without checks.csv is one whose suite did not end. Throws reports::IoError when DIR cannot be written, and
/// Interrupted on SIGINT and SIGTERM (while an InterruptionGuard is alive); the tables of the studies that
/// had ended are then written if at all possible, with a failed check that says so.
SuiteOutcome run_suite(const std::vector<Study>& studies, const std::filesystem::path& out, int jobs,
                       RunCache& cache, const SuiteListener& listener, Profiles profiles = Profiles::Needed);

}  // namespace verification
