#pragma once

#include <cmath>
#include <type_traits>

namespace mpm {

// A pressure policy works on one particle, or on an array of them.

/// Tait equation of state P = K[(rho/rho0)^7 - 1] (paper Eq. 23) with density following the dilatation.
struct TaitPressure {
  static constexpr bool varies = true, is_of_cell = false;
  double bulk_modulus;               ///< K [Pa]
  double inverse_reference_density;  ///< 1/rho0 [m3/kg]

  /// rho_new = rho/(1 + dt tr D) (below the paper's Eq. 23, misprint corrected) [kg/m3]
  [[nodiscard]] double advance_density(double density, double dilatation_rate, double dt) const {
    return density / (1 + dt * dilatation_rate);
  }
  template <class Real>
  requires(!std::is_integral_v<Real>) [[nodiscard]] Real pressure(const Real& density) const {
    const Real r = density * inverse_reference_density;
    const Real r2 = r * r;  // r^7 as two factors, neither of which waits for the other
    return (bulk_modulus * r * r2) * (r2 * r2) - bulk_modulus;
  }
  /// The density at which the pressure is P [kg/m3]; P > -K.
  [[nodiscard]] double density(double pressure) const {
    return std::pow(1 + pressure / bulk_modulus, 1.0 / 7) / inverse_reference_density;
  }
};

/// The same with one dilatation and one density a cell (solver/material/cell_dilatation.hpp), which need not
/// fall below a bound: fluid that can be torn bears no tension.
struct CellTaitPressure : TaitPressure {
  static constexpr bool is_of_cell = true;
  double least_density = 0;  ///< [kg/m3]
};

/// For scenes declared divergence-free: no pressure, constant density.
struct NoPressure {
  static constexpr bool varies = false, is_of_cell = false;
  [[nodiscard]] double advance_density(double density, double, double) const { return density; }
  [[nodiscard]] double pressure(double) const { return 0; }
};

}  // namespace mpm
