#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "verification/suite/run_cache.hpp"
#include "verification/suite/schedule.hpp"

// A suite cut into parts that machines which know nothing of each other run: which run belongs to which part
// follows from the studies and the number of parts alone.
namespace verification {

/// Part `index` (1 ... count) of a suite.
struct Shard {
  int index = 1, count = 1;
};
/// "3/7". Throws ConfigError.
Shard shard_named(const std::string& text);

/// Estimated time of a job on one core [s].
double estimated_seconds(const Study& study, const Job& job);
/// As many shards as take about a minute each on one core, by estimate.
int automatic_shards(const std::vector<Study>& studies);

/// All runs and limits of the studies in `count` parts of about the same cost: longest first, each to the
/// part that has least so far. Job::cost is in seconds; a part may be empty.
std::vector<std::vector<Job>> partition(const std::vector<Study>& studies, int count);

/// Name of a job in messages, manifests and progress: its run, or STUDY.CASE of a limit.
std::string name_of(const std::vector<Study>& studies, const Job& job);

/// Refuses studies whose runs nobody could take over: a foreign solver of which it is not said what decides
/// its results. Throws ConfigError.
void require_keepable(const std::vector<Study>& studies);

/// Runs what the cache does not hold and keeps it there; runs whose time is measured come last, one at a
/// time. `out` takes the files of foreign runs. Returns the runs that could not be simulated, with why; those
/// are noted in the cache, and tried again by the next call. Throws Interrupted, and whatever keeps `out`
/// from being written.
std::vector<std::string> run_shard(const std::vector<Study>& studies, const std::vector<Job>& jobs,
                                   RunCache& cache, const std::filesystem::path& out, int threads,
                                   const std::function<void(const std::string& run)>& ended);

/// Jobs of the studies that the cache knows nothing of, by name.
std::vector<std::string> missing_runs(const std::vector<Study>& studies, RunCache& cache);

}  // namespace verification
