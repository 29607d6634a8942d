#include "verification/suite/shards/shard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <exception>
#include <mutex>

#include "reports/files/atomic_file.hpp"
#include "reports/files/io_error.hpp"
#include "verification/config/config_error.hpp"
#include "verification/runs/foreign/what_decides.hpp"
#include "verification/runs/interruption.hpp"
#include "verification/runs/run_simulation.hpp"
#include "verification/scene/scene_cost.hpp"
#include "verification/suite/run_entry.hpp"
#include "verification/suite/slots.hpp"

namespace verification {
namespace {

constexpr double seconds_of_a_shard = 60;

bool holds(const Study& study, const Job& job, RunCache& cache) {
  if (job.kind == Job::Kind::Limit)
    return cache.load(study.stability.content(study.stability.cases[job.run])).has_value();
  const PlannedRun& plan = study.runs[job.run];
  if (!plan.solver) return cache.load(study, plan).has_value();
  if (plan.solver->is_there()) return true;
  const std::string key = what_decides(plan, version_of(*plan.solver));
  const KeptDeliveries kept = cache.deliveries();
  return !key.empty() && kept.load && kept.load(key).has_value();
}

void run_job(const Study& study, const Job& job, RunCache& cache, const std::filesystem::path& out) {
  if (job.kind == Job::Kind::Limit) {
    const StabilityCase& one = study.stability.cases[job.run];
    const auto begin = std::chrono::steady_clock::now();
    MeasuredLimits limits{measure_case(study.name, study.stability, one), 0};
    limits.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    cache.save(study.stability.content(one), encode_limits(limits));
    return;
  }
  const PlannedRun& plan = study.runs[job.run];
  reports::keep_file(out / "scenes" / (plan.run + ".toml"), plan.scene_text());
  if (plan.solver)
    static_cast<void>(run_foreign(study, plan, out, cache.deliveries()));
  else
    cache.save(study, run_simulation(study, plan));
}

}  // namespace

Shard shard_named(const std::string& text) {
  Shard shard;
  const char *begin = text.data(), *end = begin + text.size();
  const auto [slash, error] = std::from_chars(begin, end, shard.index);
  if (error == std::errc() && slash != end && *slash == '/') {
    const auto [stop, second] = std::from_chars(slash + 1, end, shard.count);
    if (second == std::errc() && stop == end && shard.index >= 1 && shard.index <= shard.count &&
        shard.count <= 100000)
      return shard;
  }
  throw ConfigError("--shard '" + text + "': give K/N, part K of N, e.g. 3/7 (1 <= K <= N)");
}

double estimated_seconds(const Study& study, const Job& job) {
  if (job.kind == Job::Kind::Limit)
    return study.stability.cost(study.stability.cases[job.run]) / particle_steps_per_second;
  return cost_of(study.runs[job.run].scene).seconds * (study.repetitions + 1);
}

std::string name_of(const std::vector<Study>& studies, const Job& job) {
  const Study& study = studies[job.study];
  return job.kind == Job::Kind::Limit ? study.name + "." + study.stability.cases[job.run].name()
                                      : study.runs[job.run].run;
}

namespace {

std::vector<Job> all_jobs(const std::vector<Study>& studies) {
  std::vector<Job> jobs;
  for (std::size_t s = 0; s < studies.size(); ++s) {
    for (std::size_t r = 0; r < studies[s].runs.size(); ++r) jobs.push_back({s, r, 0});
    for (std::size_t c = 0; c < studies[s].stability.cases.size(); ++c)
      jobs.push_back({s, c, 0, Job::Kind::Limit});
  }
  for (Job& job : jobs) job.cost = estimated_seconds(studies[job.study], job);
  return jobs;
}

}  // namespace

int automatic_shards(const std::vector<Study>& studies) {
  double seconds = 0;
  for (const Job& job : all_jobs(studies)) seconds += job.cost;
  return std::max(1, static_cast<int>(std::ceil(seconds / seconds_of_a_shard)));
}

std::vector<std::vector<Job>> partition(const std::vector<Study>& studies, int count) {
  std::vector<Job> jobs = all_jobs(studies);
  std::ranges::stable_sort(jobs, std::ranges::greater{}, &Job::cost);
  struct Part {
    double seconds = 0;
    std::size_t index = 0;
  };
  const auto has_more = [](const Part& a, const Part& b) {
    return a.seconds != b.seconds ? a.seconds > b.seconds : a.index > b.index;
  };
  std::vector<Part> heap;  // the part that has least is on top
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) heap.push_back({0, k});
  std::vector<std::vector<Job>> parts(heap.size());
  constexpr double least = 1e-3;  // [s]: a run that costs nothing still takes its start
  for (const Job& job : jobs) {
    std::ranges::pop_heap(heap, has_more);
    parts[heap.back().index].push_back(job);
    heap.back().seconds += std::max(job.cost, least);
    std::ranges::push_heap(heap, has_more);
  }
  return parts;
}

void require_keepable(const std::vector<Study>& studies) {
  for (const Study& study : studies)
    for (const PlannedRun& plan : study.runs)
      if (plan.solver && !plan.solver->is_there() && !plan.solver->remembered)
        throw ConfigError(fmt::format(
            "study '{}': what decides the results of '{}' is not known, so that no other machine could take "
            "them over: give solver.inputs or solver.version",
            study.name, plan.solver->name));
}

std::vector<std::string> run_shard(const std::vector<Study>& studies, const std::vector<Job>& jobs,
                                   RunCache& cache, const std::filesystem::path& out, int threads,
                                   const std::function<void(const std::string& run)>& ended) {
  for (const char* folder : {"scenes", "external"}) reports::ensure_directory(out / folder);
  std::vector<std::string> failures;
  std::mutex mutex;
  Slots slots;
  slots.set(threads);
  const auto perform = [&](const Job& job) {
    throw_if_interrupted();
    const Study& study = studies[job.study];
    const std::string run = name_of(studies, job);
    const bool is_run = job.kind == Job::Kind::Run;
    try {
      const Slots::Hold hold(slots,
                             is_run && study.runs[job.run].solver ? study.runs[job.run].solver->cores : 1);
      if (!holds(study, job, cache)) run_job(study, job, cache, out);
    } catch (const reports::IoError&) {
      throw;
    } catch (const Interrupted&) {
      throw;
    } catch (const std::exception& error) {
      if (is_run) cache.save_failure(study, study.runs[job.run], error.what());
      const std::scoped_lock lock(mutex);
      failures.push_back(run + ": " + error.what());
    }
    const std::scoped_lock lock(mutex);
    if (ended) ended(run);
  };
  std::vector<Job> shared, alone;
  for (const Job& job : jobs) (studies[job.study].repetitions > 0 ? alone : shared).push_back(job);
  std::exception_ptr stopped = perform_all(shared, threads, perform);
  if (!stopped) stopped = perform_all(alone, 1, perform);
  if (stopped) std::rethrow_exception(stopped);
  std::ranges::sort(failures);
  return failures;
}

std::vector<std::string> missing_runs(const std::vector<Study>& studies, RunCache& cache) {
  std::vector<std::string> missing;
  for (const Job& job : all_jobs(studies)) {
    const Study& study = studies[job.study];
    if (holds(study, job, cache)) continue;
    if (job.kind == Job::Kind::Run && cache.failure(study, study.runs[job.run])) continue;
    missing.push_back(name_of(studies, job));
  }
  return missing;
}

}  // namespace verification
