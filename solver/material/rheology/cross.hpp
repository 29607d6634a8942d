#pragma once

#include <algorithm>

#include "solver/material/rheology/power.hpp"

namespace mpm {

/// mu = mu_inf + (mu_0 - mu_inf)/(1 + (K gdot)^M) (paper Eq. 24). `Power` takes (K gdot)^2 to (K gdot)^M:
/// SquareRoot for M = 1, RealPower{M/2} in general.
template <class Power>
struct Cross {
  static constexpr bool needs_shear_rate = true;
  double mu_0 = 0;    ///< at zero shear rate [Pa s]
  double mu_inf = 0;  ///< at high shear rate [Pa s]
  double K = 0;       ///< time constant [s]
  Power power;

  template <class Real>
  Real viscosity(const Real& gdot_squared) const {
    return mu_inf + (mu_0 - mu_inf) / (1 + power(Real(K * K * gdot_squared)));
  }
  [[nodiscard]] double largest_viscosity() const { return std::max(mu_0, mu_inf); }
};

}  // namespace mpm
