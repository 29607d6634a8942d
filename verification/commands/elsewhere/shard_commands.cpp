#include "verification/commands/elsewhere/shard_commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "reports/records/directory/result_directory.hpp"
#include "reports/records/provenance.hpp"
#include "solver/kernel/isa.hpp"
#include "verification/commands/commands.hpp"
#include "verification/commands/output.hpp"
#include "verification/commands/provenance_of.hpp"
#include "verification/commands/suite_session.hpp"
#include "verification/commands/terminal.hpp"
#include "verification/config/config_error.hpp"
#include "verification/flows/reference_store.hpp"
#include "verification/runs/interruption.hpp"
#include "verification/suite/build_identity.hpp"
#include "verification/suite/shards/manifest.hpp"
#include "verification/suite/shards/shard.hpp"

namespace verification {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_named = 10;

/// The first few of many names, and how many more there are.
std::string some_of(const std::vector<std::string>& names) {
  std::vector<std::string> shown(names.begin(),
                                 names.begin() + static_cast<long>(std::min(names.size(), most_named)));
  std::string text = fmt::format("{}", fmt::join(shown, ", "));
  return names.size() > most_named ? text + fmt::format(" and {} more", names.size() - most_named) : text;
}

/// Refuses shards that do not belong together, or to this program.
void require_one_suite(const std::vector<fs::path>& dirs, const std::vector<ShardState>& shards) {
  for (std::size_t k = 0; k < shards.size(); ++k) {
    const ShardState &one = shards[k], &first = shards.front();
    if (one.suite.names != first.suite.names || one.suite.suite != first.suite.suite ||
        one.count != first.count)
      throw ConfigError(fmt::format("{} is part of another suite than {}: collect them apart",
                                    dirs[k].string(), dirs.front().string()));
    if (one.program != program_identity())
      throw ConfigError(fmt::format(
          "{} was made by another program than this one ({} against {}): collect it with the one that ran it",
          dirs[k].string(), one.program, program_identity()));
  }
  for (const ShardState& one : shards)
    if (one.kernels != shards.front().kernels) {
      warn(
          "warning: shards ran with different vector kernels ({} and {}): give --isa to all of them for the "
          "same bytes as one run\n",
          shards.front().kernels, one.kernels);
      return;
    }
}

}  // namespace

int shard_command(const RunOptions& options) {
  if (options.no_cache || options.fresh || options.resume)
    throw ConfigError(
        "--shard keeps its runs in --out and goes on from them: leave out --no-cache, --fresh and --resume");
  const Shard shard = shard_named(options.shard);
  std::vector<Study> studies = chosen_studies(options.studies, options.names, options.suite);
  require_keepable(studies);
  const reports::ResultDirectory ours(options.out, options.force);
  reports::write_provenance(options.out, provenance_of(options.command_line));
  ShardState state{PlannedSuite::of(options.studies, options.names, options.suite),
                   program_identity(),
                   mpm::current_isa(),
                   reports::this_machine().cpu,
                   shard.index,
                   shard.count,
                   0,
                   false,
                   {}};
  write_shard(options.out, state);
  RunCache cache(origin_of(options.out, state));
  long done = 0;
  const bool progress = show_progress();
  try {
    const InterruptionGuard guard;
    // Every shard chooses the steps itself: from the same runs it comes to the same ones.
    settle_and_say(studies, cache, job_count(options.jobs));
    const std::vector<Job> jobs = partition(studies, shard.count)[static_cast<std::size_t>(shard.index - 1)];
    state.runs = static_cast<long>(jobs.size());
    write_shard(options.out, state);
    state.failures =
        run_shard(studies, jobs, cache, options.out, job_count(options.jobs), [&](const std::string& run) {
          if (progress) warn("\r\033[K[{}/{} runs] {}", ++done, state.runs, run);
        });
  } catch (const Interrupted& stop) {
    if (progress) warn("\r\033[K");
    warn("mpm-verify: interrupted; the same command goes on from there\n");
    return 128 + stop.signal;
  }
  if (progress) warn("\r\033[K");
  if (const std::string warning = cache.warning(); !warning.empty())
    throw ConfigError(warning);  // a shard that cannot keep its runs has done nothing
  state.complete = true;
  write_shard(options.out, state);
  say("shard {}/{}: {} runs in {}\n", shard.index, shard.count, state.runs, options.out.string());
  for (const std::string& failure : state.failures) warn("error: run {}\n", failure);
  return state.failures.empty() ? 0 : 3;
}

int collect_command(const CollectOptions& options) {
  const std::vector<fs::path> dirs = shard_directories(options.dirs);
  std::vector<ShardState> shards;
  std::vector<CacheOrigin> origins;
  for (const fs::path& dir : dirs) {
    shards.push_back(read_shard(dir));
    origins.push_back(origin_of(dir, shards.back()));
  }
  require_one_suite(dirs, shards);
  const PlannedSuite& suite = shards.front().suite;
  const fs::path folder = options.studies.empty() ? suite.studies : options.studies;
  std::vector<Study> studies = chosen_studies(folder, suite.names, suite.suite);
  RunCache cache(origins);
  settle_and_say(studies, cache, job_count(options.jobs));
  const std::vector<std::string> missing = missing_runs(studies, cache);
  if (!missing.empty()) {
    std::set<int> there;
    for (const ShardState& shard : shards)
      if (shard.complete) there.insert(shard.index);
    std::vector<std::string> lacking;
    for (int k = 1; k <= shards.front().count; ++k)
      if (!there.contains(k)) lacking.push_back(fmt::format("{}/{}", k, shards.front().count));
    throw ConfigError(fmt::format(
        "{} runs are in none of the shards: {}.{} Nothing is simulated here", missing.size(),
        some_of(missing),
        lacking.empty() ? " The studies have changed since: run the shards again."
                        : fmt::format(" Run these shards, or run them to their end: {}.", some_of(lacking))));
  }
  return run_session(studies,
                     {options.out, cache_directory(), job_count(options.jobs), options.force, options.pdf,
                      options.keep_profiles, options.command_line},
                     cache);
}

}  // namespace verification
