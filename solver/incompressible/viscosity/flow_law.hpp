#pragma once

#include <algorithm>

#include "solver/incompressible/space/spline_axis.hpp"
#include "solver/kernel/isa.hpp"
#include "solver/material/rheology.hpp"

namespace mpm::incompressible {

/// Kinematic viscosity nu [m2/s] and d nu/d q [m2 s] of a fluid at many q = gdot^2 = 2 D:D [1/s2]. Shear
/// rates below a billionth of the largest count as that: a power law below one has an infinite viscosity at
/// rest.
class FlowLaw {
 public:
  /// `density` [kg/m3].
  FlowLaw(const Rheology& fluid, double density) : fluid_(fluid), curve_(flow_curve()), density_(density) {}

  [[nodiscard]] static VectorXd bounded_below(const VectorXd& q) {
    return q.cwiseMax(std::max(1e-18 * q.maxCoeff(), 1e-200));
  }

  /// Of q that are bounded_below().
  [[nodiscard]] VectorXd viscosity(const VectorXd& q) const {
    VectorXd nu(q.size());
    curve_(fluid_, static_cast<int>(q.size()), q.data(), nu.data());
    return nu / density_;
  }
  /// d nu/d q, given nu there: by central differences, not below the slope at which shear stress would fall
  /// with shear rate.
  [[nodiscard]] VectorXd slope(const VectorXd& q, const VectorXd& nu) const {
    constexpr double e = 1e-4;  // relative: truncation e^2 and round-off 1e-16/e are below 1e-8
    const VectorXd rise = viscosity((1 + e) * q) - viscosity((1 - e) * q);
    return (rise.array() / (2 * e * q.array())).max(-0.4995 * nu.array() / q.array());
  }

 private:
  Rheology fluid_;
  FlowCurve curve_;
  double density_;
};

}  // namespace mpm::incompressible
