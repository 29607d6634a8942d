#pragma once

#include <algorithm>

#include "solver/material/rheology/power.hpp"

namespace mpm {

/// (1 - exp(-x))/x for x >= 0, from x^2, within a few units in the last place: below x = 1 as
/// exp(-x/2) sinh(x/2)/(x/2), whose series has positive terms only, so that nothing cancels.
template <class Real>
Real mean_of_decay(const Real& x_squared) {
  using std::exp;
  using std::sqrt;
  // Terms beyond (x/2)^14/15! are below 1e-18 of the sum for x < 1.
  const Real s = 0.25 * x_squared;
  const Real series =
      1 + s * (1.0 / 6 +
               s * (1.0 / 120 +
                    s * (1.0 / 5040 +
                         s * (1.0 / 362880 + s * (1.0 / 39916800 +
                                                  s * (1.0 / 6227020800.0 + s * (1.0 / 1307674368000.0)))))));
  const Real x = sqrt(x_squared), half = exp(Real(-0.5 * x));
  return choose_below(x_squared, 1.0, Real(half * series), Real((1 - half * half) / at_least(x, 1e-300)));
}

/// mu = K gdot^(n-1) + tau_y (1 - exp(-m gdot))/gdot: a Herschel-Bulkley fluid, n = 1 a Bingham fluid, whose
/// yield stress is approached over shear rates of 1/m (Papanastasiou 1987, J. Rheol. 31, 385). In the power
/// gdot counts as the floor where it is smaller, as in PowerLaw. Below the yield stress the fluid creeps with
/// a viscosity of m tau_y, which is what an explicit step must resolve.
struct HerschelBulkley {
  static constexpr bool needs_shear_rate = true;
  double consistency = 0;         ///< K: viscosity of the power law at gdot = 1/s [Pa s]
  double n = 1;                   ///< index [-]
  double yield_stress = 0;        ///< tau_y [Pa]
  double regularisation = 0;      ///< m [s]
  double floor = 0;               ///< shear-rate floor of the power [1/s], > 0
  double largest_shear_rate = 0;  ///< expected in the scene [1/s]; bounds the viscosity of n > 1

  template <class Real>
  Real viscosity(const Real& gdot_squared) const {
    const Real power = RealPower{0.5 * (n - 1)}(Real(at_least(gdot_squared, floor * floor)));
    return consistency * power + yield_stress * regularisation *
                                     mean_of_decay(Real(regularisation * regularisation * gdot_squared));
  }
  /// A bound of the tangent d tau/d gdot: each part's largest.
  [[nodiscard]] double largest_viscosity() const {
    const RealPower power{n - 1};
    return yield_stress * regularisation +
           consistency * (n < 1 ? power(floor) : n * power(std::max(floor, largest_shear_rate)));
  }
};

}  // namespace mpm
