#include <fmt/format.h>

#include "verification/commands/commands.hpp"
#include "verification/commands/suite_session.hpp"
#include "verification/config/config_error.hpp"
#include "verification/config/machine.hpp"
#include "verification/flows/reference_store.hpp"

namespace verification {
namespace {

/// A suite can go on where it stopped if it was begun there and if finished runs are kept at all.
void require_begun(const RunOptions& options, const RunCache& cache) {
  if (!cache.on())
    throw ConfigError(
        "--resume goes on from the cache of finished runs, which is off: leave out --no-cache, or set "
        "MPM_CACHE "
        "to a directory");
  if (options.fresh) throw ConfigError("--resume and --fresh contradict each other: give one of them");
  if (!std::filesystem::exists(options.out / "provenance.json"))
    throw ConfigError(options.out.string() + ": no suite was begun here; leave out --resume to begin one");
}

}  // namespace

int job_count(int asked) {
  return asked > 0 ? asked : available_cores();
}

int run_command(const RunOptions& options) {
  if (!options.shard.empty()) return shard_command(options);
  const std::vector<Study> studies = chosen_studies(options.studies, options.names, options.suite,
                                                    options.plain ? Controls::Plain : Controls::Judged);
  const std::filesystem::path kept = options.no_cache ? std::filesystem::path() : cache_directory();
  RunCache cache(kept, options.fresh ? CacheUse::Refresh : CacheUse::Reuse);
  if (options.resume) require_begun(options, cache);
  return run_session(studies,
                     {options.out, kept, job_count(options.jobs), options.force, options.pdf,
                      options.keep_profiles, options.command_line},
                     cache);
}

}  // namespace verification
