#pragma once

#include <vector>

#include "verification/checks/quantities/quantities.hpp"
#include "verification/study/foreign_solver.hpp"

namespace verification {

/// A quantity by name, and how it is taken of a run.
struct QuantityEntry {
  const char *name, *unit;
  Record record;     ///< what of a run it is taken from
  bool time, place;  ///< whether it is one at a time, in one cell
  double (*evaluate)(const Quantity&, const RunData&);
};

// One topic each; all of them together are what quantities.hpp lists.

void add_probe_quantities(std::vector<QuantityEntry>& entries);
void add_energy_quantities(std::vector<QuantityEntry>& entries);
void add_shear_quantities(std::vector<QuantityEntry>& entries);
void add_oscillation_quantities(std::vector<QuantityEntry>& entries);
void add_particle_quantities(std::vector<QuantityEntry>& entries);
void add_yield_quantities(std::vector<QuantityEntry>& entries);
void add_surface_quantities(std::vector<QuantityEntry>& entries);

}  // namespace verification
