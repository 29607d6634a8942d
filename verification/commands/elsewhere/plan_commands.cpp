#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <map>

#include "reports/figures/figures.hpp"
#include "reports/files/atomic_file.hpp"
#include "reports/files/content_hash.hpp"
#include "reports/records/directory/result_directory.hpp"
#include "verification/checks/check_reader.hpp"
#include "verification/commands/commands.hpp"
#include "verification/commands/elsewhere/shard_commands.hpp"
#include "verification/commands/output.hpp"
#include "verification/commands/provenance_of.hpp"
#include "verification/commands/suite_session.hpp"
#include "verification/config/config_error.hpp"
#include "verification/flows/reference_store.hpp"
#include "verification/reading/figure_reader.hpp"
#include "verification/runs/foreign/delivered_files.hpp"
#include "verification/scene/handed_scene.hpp"
#include "verification/suite/build_identity.hpp"
#include "verification/suite/shards/manifest.hpp"
#include "verification/suite/shards/shard.hpp"

namespace verification {
namespace {

namespace fs = std::filesystem;

std::string scene_of(const PlannedRun& plan) {
  return plan.solver ? plan.handed : handed_scene(plan.scene, "");
}

/// What checks and figures of a study read of a run.
std::vector<Record> records_needed(const Study& study) {
  std::vector<Record> needed{Record::Profile};
  const auto add = [&](Record record) {
    if (std::ranges::count(needed, record) == 0) needed.push_back(record);
  };
  for (const CheckSpec& check : study.checks)
    for (const Record record : records_of(check)) add(record);
  for (const reports::FigureRecord& figure : study.figures) add(record_of_figure(figure.kind));
  return needed;
}

/// What other solvers' files cannot be judged by: limits that are measured with ours, solutions of our own
/// schemes, and what is known of our schemes alone.
bool is_ours_alone(const Study& study) {
  return study.runs.empty() || study.matrix || study.scoreboard.has_value() ||
         study.comparison == Comparison::Discrete || study.comparison == Comparison::SteadyNodes;
}

/// Every run of the study judged by the files in DIR/results/RUN.
void judge_by_files(Study& study, const fs::path& dir) {
  ForeignSolver solver;
  if (study.solver) solver = *study.solver;
  if (!study.solver) {
    solver.name = "results";
    solver.is_named = false;
  }
  solver.command.clear();
  solver.version_command.clear();
  solver.results = fs::absolute(dir / "results" / "{run}").string();
  solver.delivers = records_needed(study);
  if (!study.solver) {
    for (const PlannedRun& run : study.runs)
      if (solver.locations.empty())
        solver.locations = locations_in(dir / "results" / run.run / "profile.csv");
    if (solver.locations.empty()) solver.locations = {Location::Grid, Location::Particles};
    const auto is_there = [&](Location location) {
      return std::ranges::count(solver.locations, location) > 0;
    };
    for (CheckSpec& check : study.checks) {
      std::vector<Location> kept;
      std::ranges::copy_if(check.locations, std::back_inserter(kept), is_there);
      if (!kept.empty()) check.locations = kept;  // none: it fails, and says which location has no rows
    }
    study.declared_checks.reset();  // how many our own solver's records make
  }
  study.repetitions = 0;
  const auto shared = std::make_shared<const ForeignSolver>(solver);
  study.solver = solver;
  for (PlannedRun& run : study.runs) {
    run.handed = scene_of(run);
    run.solver = shared;
  }
}

int shard_count(const std::string& text, const std::vector<Study>& studies) {
  if (text.empty()) return 0;
  if (text == "auto") return automatic_shards(studies);
  int count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 1 || count > 100000)
    throw ConfigError("--shards '" + text + "': give auto, or a number of 1 or more");
  return count;
}

}  // namespace

namespace {

/// A plan holds scenes with numbers in them: what pilots must run for that, runs here.
void settle_by_cache(std::vector<Study>& studies) {
  RunCache cache(cache_directory(), CacheUse::Reuse);
  settle_and_say(studies, cache, job_count(0));
  cache.prune();
}

}  // namespace

Manifest write_plan(const PlanOptions& options) {
  std::vector<Study> studies = chosen_studies(options.studies, options.names, options.suite);
  settle_by_cache(studies);
  Manifest manifest;
  manifest.suite = PlannedSuite::of(options.studies, options.names, options.suite);
  manifest.program = program_identity();
  manifest.shards = shard_count(options.shards, studies);
  if (manifest.shards > 0) require_keepable(studies);
  const auto parts = partition(studies, std::max(1, manifest.shards));
  reports::ensure_directory(options.out / "scenes");
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (const Job& job : parts[k]) {
      const Study& study = studies[job.study];
      PlannedEntry entry;
      entry.run = name_of(studies, job);
      entry.study = study.name;
      entry.seconds = job.cost;
      entry.shard = manifest.shards > 0 ? static_cast<int>(k) + 1 : 0;
      if (job.kind == Job::Kind::Run) {
        const std::string scene = scene_of(study.runs[job.run]);
        entry.scene = "scenes/" + entry.run + ".toml";
        entry.key = reports::content_name(scene);
        reports::keep_file(options.out / entry.scene, scene);
        for (const Record record : records_needed(study)) entry.delivers.push_back(name(record) + ".csv");
      }
      manifest.runs.push_back(entry);
    }
  std::ranges::sort(manifest.runs, {}, &PlannedEntry::run);
  write_manifest(options.out, manifest);
  return manifest;
}

int plan_command(const PlanOptions& options) {
  const reports::ResultDirectory ours(options.out, options.force);
  reports::write_provenance(options.out, provenance_of(options.command_line));
  const Manifest manifest = write_plan(options);
  std::map<int, std::pair<long, double>> shards;
  double seconds = 0;
  for (const PlannedEntry& entry : manifest.runs) {
    ++shards[entry.shard].first;
    shards[entry.shard].second += entry.seconds;
    seconds += entry.seconds;
  }
  say("{} runs, about {:.0f} s on one core: {}\n", manifest.runs.size(), seconds,
      (options.out / "manifest.json").string());
  for (const auto& [shard, content] : shards)
    if (shard > 0)
      say("shard {}/{}: {} runs, about {:.0f} s\n", shard, manifest.shards, content.first, content.second);
  return 0;
}

int judge_command(const JudgeOptions& options) {
  const Manifest manifest = read_manifest(options.dir);
  std::vector<Study> studies =
      chosen_studies(manifest.suite.studies, manifest.suite.names, manifest.suite.suite);
  settle_by_cache(studies);
  std::map<std::string, std::string> key_of;
  for (const PlannedEntry& entry : manifest.runs) key_of[entry.run] = entry.key;
  for (const Study& study : studies)
    for (const PlannedRun& run : study.runs)
      if (const auto found = key_of.find(run.run);
          found == key_of.end() || found->second != reports::content_name(scene_of(run)))
        throw ConfigError(
            fmt::format("{}: study '{}' is not what it was when this was planned (run {}): plan "
                        "again, and solve the scenes that changed",
                        options.dir.string(), study.name, run.run));
  std::vector<std::string> left_out;
  for (const Study& study : studies)
    if (!study.solver && is_ours_alone(study)) left_out.push_back(study.name);
  std::erase_if(studies, [](const Study& study) { return !study.solver && is_ours_alone(study); });
  if (studies.empty())
    throw ConfigError(options.dir.string() +
                      ": none of its studies can be judged from files: they are of the built-in solver's own "
                      "schemes");
  if (!left_out.empty())
    say("left out, of the built-in solver's own schemes: {}\n", fmt::join(left_out, ", "));
  for (Study& study : studies) judge_by_files(study, options.dir);
  RunCache cache({}, CacheUse::Off);
  return run_session(studies,
                     {options.out.empty() ? options.dir / "verdict" : options.out, cache_directory(),
                      job_count(options.jobs), false, options.pdf, false, options.command_line},
                     cache);
}

}  // namespace verification
