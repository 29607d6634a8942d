#pragma once

#include <variant>

namespace mpm {

// Rheology policies. A policy says whether it needs the shear rate at all, and gives the dynamic viscosity
// [Pa s] from gdot^2 = 2 D:D [1/s2]; the stress update is compiled once for each, so that a Newtonian scene
// computes neither shear rate nor viscosity.

/// Constant viscosity.
struct Newtonian {
  static constexpr bool needs_shear_rate = false;
  double mu = 0;  ///< dynamic viscosity [Pa s]

  [[nodiscard]] double viscosity() const { return mu; }
  /// Largest viscosity that the fluid can show [Pa s]: what an explicit step must resolve.
  [[nodiscard]] double largest_viscosity() const { return mu; }
};

/// Every fluid that the solver knows. Adding one: a policy above, its name here.
using Rheology = std::variant<Newtonian>;

}  // namespace mpm
