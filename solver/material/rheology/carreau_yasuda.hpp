#pragma once

#include <algorithm>

#include "solver/material/rheology/power.hpp"

namespace mpm {

/// mu = mu_inf + (mu_0 - mu_inf)(1 + (lambda gdot)^a)^((n-1)/a) (Bird, Armstrong & Hassager 1987; a = 2:
/// Carreau).
struct CarreauYasuda {
  static constexpr bool needs_shear_rate = true;
  double mu_0 = 0;                ///< at zero shear rate [Pa s]
  double mu_inf = 0;              ///< at high shear rate [Pa s]
  double lambda = 0;              ///< time constant [s]
  double a = 2;                   ///< width of the transition [-]
  double n = 1;                   ///< power-law index [-]
  double largest_shear_rate = 0;  ///< expected in the scene [1/s]; bounds the viscosity of n > 1

  template <class Real>
  Real viscosity(const Real& gdot_squared) const {
    const Real base = 1 + RealPower{0.5 * a}(Real(lambda * lambda * gdot_squared));
    return mu_inf + (mu_0 - mu_inf) * RealPower{(n - 1) / a}(base);
  }
  /// For n > 1 the tangent viscosity exceeds the viscosity by a factor of n at most.
  [[nodiscard]] double largest_viscosity() const {
    if (n <= 1) return std::max(mu_0, mu_inf);
    return std::max({mu_0, mu_inf, n * viscosity(largest_shear_rate * largest_shear_rate)});
  }
};

}  // namespace mpm
