#pragma once

namespace mpm {

/// Constant viscosity.
struct Newtonian {
  static constexpr bool needs_shear_rate = false;
  double mu = 0;  ///< dynamic viscosity [Pa s]

  [[nodiscard]] double viscosity() const { return mu; }
  [[nodiscard]] double largest_viscosity() const { return mu; }
};

}  // namespace mpm
