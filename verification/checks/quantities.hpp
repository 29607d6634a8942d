#pragma once

#include <string>

#include "verification/study/run_data.hpp"

namespace verification {

/// A scalar that a run is reduced to, for checks that compare fluids, drives and times.
struct Quantity {
  std::string name;  ///< one of quantity_names()
  double time = 0;   ///< [s], where the quantity is one at a time
  double place = 0;  ///< distance from the resting plate as a fraction of the gap, for local quantities
};

/// Known names:
///   settling-time    first time after which the probe stays within 1 % of its steady velocity (t99) [s]
///   final-velocity   at the probe at the end of the run [m/s]
///   velocity         at the probe at a time [m/s]
///   shear-rate, viscosity-ratio   at a time and place, in the cell there [1/s, 1]
///   shear-rate-rise  smallest increase from cell to cell, resting plate to moving plate, over the largest
///   rate [1] shear-rate-spread   the same from the middle to either plate [1] shear-rate-asymmetry   largest
///   |rate(y) - rate(H - y)| over the largest rate [1]
///   period-error, decay-error   of a free oscillation at the probe, fitted to its history: period over the
///   exact one minus 1, decay rate over the exact one minus 1 [1]
///   amplitude-error, phase-error   of a driven oscillation at the probe over its last period: amplitude over
///   the exact one minus 1 [1], phase minus the exact one, positive when early [rad]
///   pressure-error   root mean square over the particles at a time, relative to the flow's pressure scale
///   [1] density-error    largest |rho - exact|/exact over the particles at a time [1] path-error largest
///   distance of a particle from its exact place at a time [cells] grid-error, particle-error   relative L2
///   error of velocity at a time [1] largest-speed    largest root mean square velocity of the particles over
///   the history, relative to the velocity scale [1] speed-growth     the same in the second half of the
///   history over that in the first [1]
///   energy-drift     largest relative change of kinetic energy over the second half of the run [1]
const std::vector<std::string>& quantity_names();
bool needs_time(const std::string& quantity);
bool needs_place(const std::string& quantity);
std::string unit_of(const std::string& quantity);

/// The quantity of a run; NaN when the run did not get there, or has no such thing.
double evaluate(const Quantity& quantity, const RunData& run);

/// First time [s] at which the probe histories of two runs change order; NaN if they do not.
double crossing_time(const RunData& a, const RunData& b);

}  // namespace verification
