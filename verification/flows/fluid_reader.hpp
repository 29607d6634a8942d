#pragma once

#include <string>

#include "solver/scene.hpp"
#include "verification/config/toml_table.hpp"

namespace verification {

/// A fluid as the user states it.
struct FluidConfig {
  std::string label;               ///< for tables: "newtonian"
  double kinematic_viscosity = 0;  ///< nu [m2/s]
  mpm::Fluid solver;               ///< the same for the solver
};

/// Reads [fluid]: model, kinematic_viscosity, density, pressure, bulk_modulus. Throws ConfigError.
FluidConfig read_fluid(TomlTable table);

}  // namespace verification
