#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/scene.hpp"
#include "solver/simulation.hpp"

namespace mpm {

/// How the time step is chosen: a fixed dt, or fractions of the explicit limits
///   acoustic  dt <= cfl_acoustic h/c,   viscous  dt <= cfl_viscous h^2/nu_max
/// with h the smallest cell side. DESIGN: linear USF is stable to cfl_acoustic sqrt(2), cfl_viscous 0.745 at
/// the worst particle offset. Full mass is stiffer: cfl_viscous 0.170 (linear), 0.167 (quadratic), 0.134
/// (cubic), measured in shear between walls with Gauss rows; implicit viscosity has no such limit, so give it
/// a dt.
struct TimeStepRule {
  double dt = 0;  ///< [s]; 0: from the limits
  double cfl_acoustic = 0.5;
  double cfl_viscous = 0.2;
};

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
