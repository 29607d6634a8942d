#pragma once

#include <string>

#include "verification/runs/run_data.hpp"

namespace verification {

/// A scalar that a run is reduced to, for checks that compare fluids, drives and times.
struct Quantity {
  std::string name;  ///< one of quantity_names()
  double time = 0;   ///< [s], where the quantity is one at a time
  double place = 0;  ///< distance from the resting plate as a fraction of the gap, for local quantities
};

/// Known names, one a line, with their units:
///
/// - settling-time [s]: first time after which the probe stays within 1 % of its steady velocity (t99)
/// - final-velocity [m/s]: at the probe at the end of the run
/// - particle-steps [1]: particles times steps, what a run costs on any machine
/// - velocity [m/s]: at the probe at a time
/// - shear-rate [1/s], viscosity-ratio [1]: at a time, in the cell at a place
/// - shear-rate-rise [1]: smallest increase from cell to cell, resting plate to moving plate, over the
/// largest
/// - shear-rate-spread [1]: the same from the middle to either plate
/// - shear-rate-asymmetry [1]: largest |rate(y) - rate(H - y)| over the largest rate
/// - period-error, decay-error [1]: of a free oscillation at the probe, fitted to its history, over the exact
///   one minus 1
/// - amplitude-error [1]: of a driven oscillation at the probe over its last period, over the exact one
///   minus 1
/// - phase-error [rad]: of the same, minus the exact one; positive when early
/// - pressure-error [1]: root mean square over the particles at a time, relative to the flow's pressure scale
/// - density-error [1]: largest |rho - exact|/exact over the particles at a time
/// - path-error [cells]: largest distance of a particle from its exact place at a time
/// - grid-error, particle-error [1]: relative L2 error of velocity at a time
/// - front [m]: largest x that the fluid reaches at a time; column-height [m]: largest y in the first column
///   of cells at a time
/// - front-slope [1]: slope of the front over the output times, relative to the velocity scale
/// - front-error [1]: the front over that of theory at a time, minus 1; front-exponent-error [1]: the same of
///   the exponent p in front ~ (age + t)^p over the output times
/// - energy-growth [1]: of a fluid with a free surface, largest growth of its kinetic, potential and elastic
///   energy over the one at the start; energy-change [1]: that at the end of the run
/// - largest-speed [1]: largest root mean square velocity of the particles over the history, relative to the
///   velocity scale
/// - speed-growth [1]: the same in the second half of the history over that in the first
/// - energy-error [1]: largest |E/E_exact - 1| of the kinetic energy over the history
/// - energy-drift [1]: largest relative change of the kinetic energy over the second half of the history
const std::vector<std::string>& quantity_names();
bool needs_time(const std::string& quantity);
bool needs_place(const std::string& quantity);
std::string unit_of(const std::string& quantity);
bool is_quantity(const std::string& name);
/// What of a run it is taken from.
Record record_of(const std::string& quantity);

/// The quantity of a run; NaN when the run did not get there, or has no such thing.
double evaluate(const Quantity& quantity, const RunData& run);

/// First time [s] at which the probe histories of two runs change order; NaN if they do not.
double crossing_time(const RunData& a, const RunData& b);

}  // namespace verification
