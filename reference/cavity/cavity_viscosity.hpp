#pragma once

#include <cmath>

#include "reference/fluids/flow_curve.hpp"

namespace reference {

/// Kinematic viscosity against q = 2 D:D, the square of the shear rate, for a flow in units of the lid's
/// velocity U and the side L: viscosity in U L, q in (U/L)^2.
class CavityViscosity {
 public:
  /// `curve` in those units. `floor`: shear rate [U/L] that is added in quadrature, q + floor^2, so that a
  /// power law has a viscosity, and a slope of it, where the fluid does not deform.
  explicit CavityViscosity(const FlowCurve& curve, double floor = 1e-5)
      : curve_(curve), least_(floor * floor) {}

  struct Value {
    double nu;    ///< viscosity [U L]
    double by_q;  ///< its derivative by q [L^3/U]
  };
  [[nodiscard]] Value at(double q) const {
    const double w = std::sqrt(q + least_), nu = curve_.viscosity(w);
    return {nu, 0.5 * (curve_.slope(w) - nu) / (w * w)};  // slope: d(nu w)/dw
  }

 private:
  FlowCurve curve_;
  double least_;
};

}  // namespace reference
