#include "verification/suite/steps/settle_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "reports/files/io_error.hpp"
#include "verification/config/config_error.hpp"
#include "verification/not_a_number.hpp"
#include "verification/runs/interruption.hpp"
#include "verification/runs/pilot/pilot.hpp"
#include "verification/runs/run_simulation.hpp"
#include "verification/scene/time_step_reader.hpp"
#include "verification/suite/schedule.hpp"

namespace verification {
namespace {

/// A variant whose steps are to be chosen.
struct Open {
  std::size_t study;
  std::string variant;
  PilotOutcome outcome = {};
};

RunData run_pilot(const Study& study, const PlannedRun& plan, RunCache& cache) {
  throw_if_interrupted();
  if (auto kept = cache.load(study, plan)) return std::move(*kept);
  if (!cache.may_run()) {
    if (const auto why = cache.failure(study, plan)) return failed_run(study, plan, *why);
    throw ConfigError(
        "pilot run " + plan.run +
        " is in none of the shards: the studies have changed since, or no shard ran to its end. "
        "Run the shards again; nothing is simulated here");
  }
  try {
    RunData data = run_simulation(study, plan);
    cache.save(study, data);
    return data;
  } catch (const reports::IoError&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    cache.save_failure(study, plan, error.what());
    return failed_run(study, plan, error.what());
  }
}

std::string line_of(const Study& study, const Open& open) {
  std::string steps;
  for (const reports::TimeStepRecord& step : open.outcome.steps)
    steps += fmt::format("{}{:.4g}{}", steps.empty() ? "" : ", ", step.dt,
                         step.bound == std::string("error") ? "" : " (" + step.bound + ")");
  // The level that has no step says why.
  const auto unsettled =
      std::ranges::find(open.outcome.steps, reports::no_step, &reports::TimeStepRecord::bound);
  const auto& first = unsettled == open.outcome.steps.end() ? open.outcome.steps.front() : *unsettled;
  const std::string who = study.name + (open.variant.empty() ? "" : ", " + open.variant);
  if (first.bound == reports::no_step) return fmt::format("{}: {}", who, first.remark);
  double work = 0;
  for (const reports::PilotRecord& run : open.outcome.runs)
    work += static_cast<double>(run.particles) * static_cast<double>(run.steps);
  return fmt::format("{}: dt = {} s by {} pilot runs ({:.2g} particle-steps); {}", who, steps,
                     open.outcome.runs.size(), work, first.remark);
}

void take(Study& study, const Open& open) {
  std::size_t level = 0;
  for (PlannedRun& run : study.runs) {
    if (run.variant != open.variant) continue;
    run.scene = with_step(run.scene, open.outcome.steps[level++].dt);
  }
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(study.time_steps, open.outcome.steps);
  append(study.pilots, open.outcome.runs);
  append(study.pilot_timings, open.outcome.timings);
}

}  // namespace

void settle_steps(std::vector<Study>& studies, RunCache& cache, int threads,
                  const std::function<void(const std::string& line)>& say) {
  std::vector<Open> open;
  std::vector<Job> jobs;
  for (std::size_t s = 0; s < studies.size(); ++s)
    for (const std::string& variant : studies[s].variants) {
      const auto levels = studies[s].runs_of(variant);
      if (levels.empty() || !levels.front()->scene.auto_step) continue;
      jobs.push_back({s, open.size(), levels.front()->scene.particle_steps()});
      open.push_back({s, variant});
    }
  std::ranges::stable_sort(jobs, std::ranges::greater{}, &Job::cost);
  const auto stopped = perform_all(jobs, threads, [&](const Job& job) {
    Open& one = open[job.run];
    one.outcome = choose_steps(
        studies[one.study], one.variant,
        [&](const Study& study, const PlannedRun& plan) { return run_pilot(study, plan, cache); });
  });
  if (stopped) std::rethrow_exception(stopped);
  for (const Open& one : open) {
    take(studies[one.study], one);
    say(line_of(studies[one.study], one));
  }
}

std::vector<reports::CheckRecord> unsettled_steps(const Study& study) {
  std::vector<reports::CheckRecord> checks;
  for (const reports::TimeStepRecord& step : study.time_steps) {
    const std::string name = (step.variant.empty() ? "" : step.variant + ": ") + "time step by its error";
    if (step.bound == reports::no_step && std::ranges::count(checks, name, &reports::CheckRecord::check) == 0)
      checks.push_back({study.name, name, nan, 0, 1, "1", "fail", step.remark});
  }
  return checks;
}

}  // namespace verification
