#include "verification/runs/pilot/pilot_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "verification/convergence/step_by_error.hpp"
#include "verification/not_a_number.hpp"
#include "verification/runs/measures.hpp"
#include "verification/scene/time_step_reader.hpp"

namespace verification {
namespace {

constexpr double no_bound = std::numeric_limits<double>::infinity();

template <class NormAt>
double largest(const SceneConfig& scene, NormAt&& norm_at) {
  double worst = 0;
  for (const double t : scene.outputs) {
    const double value = norm_at(t);
    if (!std::isfinite(value)) return no_bound;
    worst = std::max(worst, value);
  }
  return worst;
}

}  // namespace

PilotRuns::PilotRuns(const Study& study, const std::vector<const PlannedRun*>& levels, const PilotRunner& run)
    : study_(study),
      levels_(levels),
      run_(run),
      interval_(common_interval(levels.front()->scene.start, levels.front()->scene.outputs)) {
  study_.repetitions = 0;
  study_.runs.clear();
}

const RunData& PilotRuns::at(std::size_t level, long parts) {
  const auto [found, added] = trials_.try_emplace({level, parts});
  Trial& trial = found->second;
  if (!added) return trial.data;
  PlannedRun plan = *levels_[level];
  plan.scene = with_step(plan.scene, dt_of(parts));
  plan.run += fmt::format(".pilot{}", parts);
  trial.plan = std::make_unique<const PlannedRun>(std::move(plan));
  trial.data = run_(study_, *trial.plan);
  trial.data.plan = trial.plan.get();
  const reports::RunRecord& run = trial.data.record;
  const double error = trial.data.completed() ? largest_error(trial.data) : nan;
  records_.push_back({trial.plan->run, study_.name, trial.plan->variant, run.cells, run.particles,
                      dt_of(parts), run.steps, run.status, std::isfinite(error) ? error : nan});
  timings_.push_back(trial.data.timing);
  timings_.back().run = trial.plan->run;
  return trial.data;
}

std::vector<long> PilotRuns::completed(std::size_t level) const {
  std::vector<long> parts;
  for (const auto& [key, trial] : trials_)
    if (key.first == level && trial.data.completed()) parts.push_back(key.second);
  return parts;
}

double largest_error(const RunData& run) {
  const auto errors = measure_errors(run);
  return largest(run.plan->scene, [&](double t) {
    for (const reports::ErrorRecord& error : errors)
      if (error.t == t && error.location == name(Location::Grid)) return error.l2;
    return nan;
  });
}

double difference(const RunData& a, const RunData& b) {
  return largest(a.plan->scene, [&](double t) { return difference_norms(a, b, t, Location::Grid).l2; });
}

double difference_to_finer(const RunData& run, const RunData& finer) {
  return largest(run.plan->scene, [&](double t) { return norms_against(run, finer, t, Location::Grid).l2; });
}

RunData at_zero_step(const RunData& step, const RunData& half, double order) {
  RunData limit = half;
  const double weight = 1 / (std::pow(2.0, order) - 1);
  const std::string grid = name(Location::Grid);
  std::erase_if(limit.profile, [&](const reports::ProfileRow& row) { return row.location != grid; });
  std::size_t i = 0;
  for (const reports::ProfileRow& row : step.profile) {
    if (row.location != grid || i >= limit.profile.size()) continue;
    reports::ProfileRow& value = limit.profile[i++];
    value.u += weight * (value.u - row.u);
    value.v += weight * (value.v - row.v);
  }
  return limit;
}

}  // namespace verification
