#include "solver/step/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/step/stable_step.hpp"

namespace mpm {
namespace {

// A remainder below this fraction of dt is rounding in (end - begin)/dt, not a step.
constexpr double sliver = 1e-6;

}  // namespace

TimeStepRule automatic_time_step(const Scheme& scheme, const Scene& scene) {
  const StableStep limit = stable_step(scheme, fewest_particles_per_cell(scene));
  if (!(limit.viscous > 0 && limit.acoustic > 0))
    throw SceneError(
        "full mass with one particle a cell is stable at no explicit step: seed two or more a cell along "
        "every "
        "axis");
  TimeStepRule rule;
  rule.cfl_viscous = std::min(rule.cfl_viscous, 0.5 * limit.viscous);
  rule.cfl_acoustic = std::min(rule.cfl_acoustic, 0.5 * limit.acoustic);
  return rule;
}

double nominal_time_step(const TimeStepRule& rule, const Scene& scene) {
  if (!std::isfinite(rule.dt) || rule.dt < 0) throw SceneError("dt must be positive and finite");
  if (rule.dt > 0) return rule.dt;
  if (!(rule.cfl_acoustic > 0 && rule.cfl_viscous > 0 && std::isfinite(rule.cfl_acoustic + rule.cfl_viscous)))
    throw SceneError("cfl_acoustic and cfl_viscous must be positive and finite");
  const double h = scene.smallest_cell_size();
  const double c = scene.fluid.sound_speed();
  const double nu = scene.fluid.largest_kinematic_viscosity();
  double dt = std::numeric_limits<double>::infinity();
  if (c > 0) dt = std::min(dt, rule.cfl_acoustic * h / c);
  if (nu > 0) dt = std::min(dt, rule.cfl_viscous * h * h / nu);
  if (!std::isfinite(dt)) throw SceneError("neither sound nor viscosity limits the time step: give dt");
  return dt;
}

std::vector<Segment> plan_segments(const TimeStepRule& rule, const Scene& scene,
                                   const std::vector<double>& outputs, double begin) {
  const double dt = nominal_time_step(rule, scene);
  std::vector<Segment> segments;

  for (const double end : outputs) {
    if (!(end > begin) || !std::isfinite(end))
      throw SceneError("output times must lie beyond the start and increase");
    const double ratio = (end - begin) / dt;
    if (ratio > 1e12) throw SceneError("dt is too small for the end time: over 1e12 steps");
    const long steps = std::max(1L, static_cast<long>(std::ceil(ratio - sliver)));
    // One step that is shorter than asked for is as long as it is.
    const bool equal = rule.dt == 0 || steps == 1 || std::abs(ratio - static_cast<double>(steps)) < sliver;
    segments.push_back({begin, end, equal ? (end - begin) / static_cast<double>(steps) : dt, steps});
    begin = end;
  }
  return segments;
}

Outcome run(Simulation& simulation, const std::vector<Segment>& segments,
            const std::function<void(double)>& after_step, const std::function<void(double)>& at_output) {
  Outcome outcome;
  for (const Segment& segment : segments) {
    for (long k = 0; k < segment.steps; ++k) {
      simulation.advance(segment.time(k), segment.length(k));
      ++outcome.steps;
      outcome.time = segment.time(k + 1);
      outcome.breakdown = simulation.breakdown();
      if (outcome.breakdown) return outcome;
      after_step(outcome.time);
    }
    at_output(outcome.time);
  }
  return outcome;
}

}  // namespace mpm
