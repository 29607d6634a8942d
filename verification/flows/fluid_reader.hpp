#pragma once

#include <string>

#include "reference/fluids/flow_curve.hpp"
#include "solver/scene/scene.hpp"
#include "verification/config/toml_table.hpp"

namespace verification {

/// A fluid as the user states it.
struct FluidConfig {
  std::string label;               ///< for tables: "newtonian", "cross a=0.25", "power-law n=0.6"
  double kinematic_viscosity = 0;  ///< nu_0 [m2/s]: of the Newtonian limit, or at 1/s for a power law
  reference::FlowCurve curve{reference::NewtonianCurve{1}};  ///< for the reference
  mpm::Fluid solver;                                         ///< the same for the solver
  bool without_modulus = false;  ///< no bulk_modulus was given: for somebody else's solver alone
  bool incompressible =
      false;  ///< pressure = "incompressible": no sound, no density; solver.pressure is false

  /// mu/mu_0 at a shear rate [1/s], by the reference's flow curve.
  [[nodiscard]] double viscosity_ratio(double shear_rate) const {
    return curve.viscosity(shear_rate) / kinematic_viscosity;
  }
};

/// Reads [fluid]: model, kinematic_viscosity, density, pressure, bulk_modulus and the keys of the model.
/// pressure is true (an equation of state), false (left out of the model) or "incompressible". `cells` is the
/// number of cells across the flow, from which a regularisation may follow. Without a bulk_modulus, where
/// that is allowed, the fluid's speed of sound is one that no flow here comes near. Throws ConfigError.
FluidConfig read_fluid(TomlTable table, int cells, bool needs_no_modulus = false);

/// [m/s]
inline constexpr double unreached_sound_speed = 1e6;

/// Whether a [fluid] says pressure = "incompressible". Throws ConfigError for another text.
bool is_incompressible(TomlTable& fluid);

}  // namespace verification
