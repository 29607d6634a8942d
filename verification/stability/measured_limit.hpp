#pragma once

#include "verification/stability/predicted_limit.hpp"

namespace verification {

/// How a limit is measured: the solver itself runs on a periodic box of `cells`, from a random perturbation
/// of the velocity (and of the density where there is pressure) so small that the equations are linear.
struct MeasuringPlan {
  StabilityProblem problem;
  std::array<int, 2> cells{1, 16};
  std::array<double, 2> offset{0, 0};  ///< where the particles start, from their seats [cells]
  /// How far a uniform stream carries them, along each axis, during the run [cells]; 0: at rest.
  std::array<double, 2> travel{0, 0};
  int steps = 1000;
};

/// Whether the perturbation grows when dt is `multiple` times that of the problem's ray: its energy (kinetic,
/// and elastic of the density) exceeds 1e4 times what it was at any earlier time, or the run breaks down.
/// Neutral waves keep their energy; beating and non-normal growth this close to a limit stays below that.
bool perturbation_grows(const MeasuringPlan& plan, double multiple);

/// Factor a step by which the perturbation's amplitude grows once its fastest waves have outgrown the others:
/// the spectral radius, seen on the solver. NaN when it does not grow to that within the plan's steps.
double measured_growth(const MeasuringPlan& plan, double multiple);

/// Largest stable multiple of the ray, by bisection to 0.2 %, and nothing when `largest` is stable. It is
/// looked for around `expected` first, and below `largest` where it is not there.
std::optional<double> measure_limit(const MeasuringPlan& plan, double largest,
                                    std::optional<double> expected = std::nullopt);

/// Steps that make an overshoot of 1 % unmistakable: the least stable wave grows by exp(12) meanwhile, as far
/// as that takes at most 8000 steps.
int steps_to_tell(const StabilityProblem& problem, const PredictedLimit& predicted);

/// A box of cells that holds a wave as near as possible to the given wavenumber [rad a cell]: beside every
/// other wave of the box, the least stable one is there to grow.
std::array<int, 2> box_for(const std::array<double, 2>& theta, Waves waves);

}  // namespace verification
