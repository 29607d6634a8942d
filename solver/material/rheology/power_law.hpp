#pragma once

#include <algorithm>

#include "solver/material/rheology/power.hpp"

namespace mpm {

/// mu = mu_0 gdot^(n-1), gdot in 1/s (paper Eq. 25), with gdot not below a floor: without one the viscosity
/// of a fluid at rest is infinite for n < 1. Below the floor the fluid is Newtonian, with an error of the
/// stress of at most mu_0 floor^n. (The paper sets mu_0 at gdot = 0, which is neither limit.)
struct PowerLaw {
  static constexpr bool needs_shear_rate = true;
  double mu_0 = 0;                ///< at gdot = 1/s [Pa s]
  double n = 1;                   ///< index [-]
  double floor = 0;               ///< shear-rate floor [1/s], > 0
  double largest_shear_rate = 0;  ///< expected in the scene [1/s]; bounds the viscosity of n > 1

  template <class Real>
  Real viscosity(const Real& gdot_squared) const {
    return mu_0 * RealPower{0.5 * (n - 1)}(Real(at_least(gdot_squared, floor * floor)));
  }
  /// Of the tangent d tau/d gdot where that is larger (n > 1): what an explicit step must resolve.
  [[nodiscard]] double largest_viscosity() const {
    const RealPower power{n - 1};
    return n < 1 ? mu_0 * power(floor) : n * mu_0 * power(std::max(floor, largest_shear_rate));
  }
};

}  // namespace mpm
