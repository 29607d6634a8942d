#pragma once

#include <string>
#include <vector>

#include "reports/records/records.hpp"
#include "reports/records/surface.hpp"

namespace verification {

/// What a run left behind, as its files hold it: all that a comparison with measurements looks at.
struct RunFiles {
  const std::vector<reports::ProfileRow>* profile = nullptr;
  const std::vector<reports::HistoryRow>* history = nullptr;
  const std::vector<reports::SurfaceRow>* surface = nullptr;
};

/// Where and when a quantity is wanted: t [s], x and y [m], NaN where they do not apply.
struct Whereabouts {
  double t, x, y;
};

/// A quantity that runs deliver and experiments measure.
struct ValidatedQuantity {
  const char *name, *unit;
  bool at_a_place;
  bool between_outputs;              ///< taken from a record by sample: known at any time of the run
  int velocity_power, length_power;  ///< in scaled tables the unit is V^velocity_power L^length_power
  /// Throws std::invalid_argument, with a remedy, for a time or a place that the run has nothing at.
  double (*of)(const RunFiles& run, const Whereabouts& where);
};

/// Known ones; a new one is a line in validated_quantity.cpp:
///
/// - u, v [m/s]: velocity of the grid field at a place: the sample there, or else by cubic interpolation
///   between samples along x and y;
///   x may be left out of a field that is uniform along it (the first column of samples is taken)
/// - flow-rate [m2/s]: u integrated over y along the first column of samples, per unit depth
/// - mean-velocity [m/s]: that over the height
/// - wall-shear-rate [1/s]: |du/dy| at the lowest samples, from a cubic through four of them
/// - probe [m/s]: velocity at the probe, from the history
/// - front, column-height [m]: how far a fluid with a free surface reaches, from the record of its surface
const ValidatedQuantity* find_validated_quantity(const std::string& name);
std::string validated_quantity_names();

}  // namespace verification
