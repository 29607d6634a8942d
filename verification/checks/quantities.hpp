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
///   energy-error     largest |E/E_exact - 1| of the kinetic energy over the history; NaN for a run that
///   ended early [1] velocity         at the probe at a time [m/s] shear-rate, viscosity-ratio   at a time
///   and place, in the cell there [1/s, 1] shear-rate-rise  smallest increase from cell to cell, resting
///   plate to moving plate, over the largest rate [1] shear-rate-spread   the same from the middle to either
///   plate [1] shear-rate-asymmetry   largest |rate(y) - rate(H - y)| over the largest rate [1]
const std::vector<std::string>& quantity_names();
bool needs_time(const std::string& quantity);
bool needs_place(const std::string& quantity);
std::string unit_of(const std::string& quantity);

/// The quantity of a run; NaN when the run did not get there, or has no such thing.
double evaluate(const Quantity& quantity, const RunData& run);

/// First time [s] at which the probe histories of two runs change order; NaN if they do not.
double crossing_time(const RunData& a, const RunData& b);

}  // namespace verification
