#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"
#include "solver/simulation.hpp"

namespace mpm {

/// How the time step is chosen: a fixed dt, or fractions of the explicit limits
///   acoustic  dt <= cfl_acoustic h/c,   viscous  dt <= cfl_viscous h^2/nu_max
/// with h the smallest cell side. automatic_time_step() gives fractions that every scheme bears.
struct TimeStepRule {
  double dt = 0;  ///< [s]; 0: from the limits
  double cfl_acoustic = 0.5;
  double cfl_viscous = 0.2;
};

/// Half of each limit in solver/step/stable_step.hpp, but not above cfl_viscous 0.2 and cfl_acoustic 0.5,
/// which keep the time error small. Viscosity and sound together are stable wherever r/r_max +
/// (CFL/CFL_max)^2 <= 1 (so it is for stress first, others bear more): halves use three quarters of that, and
/// dt may grow by 1.23 before anything does. Implicit viscosity has no viscous limit; give it a dt to make
/// use of that. Throws SceneError where no explicit step is stable (full mass with one particle a cell).
TimeStepRule automatic_time_step(const Scheme& scheme, const Scene& scene);

/// Largest step that the rule allows [s]. Throws SceneError for a negative or non-finite dt, or when neither
/// viscosity nor sound bounds the step.
double nominal_time_step(const TimeStepRule& rule, const Scene& scene);

/// Steps from one output time to the next: all of length dt but the last, which is shortened to land on it;
/// with dt from the limits, equal steps not above it.
struct Segment {
  double begin, end;  ///< [s]
  double dt;          ///< [s]
  long steps;

  /// Start of step k, and its length.
  [[nodiscard]] double time(long k) const { return k == steps ? end : begin + static_cast<double>(k) * dt; }
  [[nodiscard]] double length(long k) const { return time(k + 1) - time(k); }
};

/// Cuts [begin, last output] into segments that end exactly on the output times (increasing, beyond `begin`
/// [s]).
std::vector<Segment> plan_segments(const TimeStepRule& rule, const Scene& scene,
                                   const std::vector<double>& outputs, double begin = 0);

/// What became of a run.
struct Outcome {
  long steps = 0;
  double time = 0;                       ///< reached [s]
  std::optional<std::string> breakdown;  ///< why it ended early
};

/// Runs the simulation through the segments. `after_step(t)` is called after every step, `at_output(t)` at
/// the end of every segment; a run that breaks down ends there and says when and why.
Outcome run(Simulation& simulation, const std::vector<Segment>& segments,
            const std::function<void(double)>& after_step, const std::function<void(double)>& at_output);

}  // namespace mpm
