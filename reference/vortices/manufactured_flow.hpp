#pragma once

#include <array>

#include "reference/fluids/flow_curve.hpp"

namespace reference {

/// A wave in the gap between a plate at rest and one that moves. SI units.
struct ManufacturedParameters {
  double height = 0.0;             ///< H of the gap [m] > 0
  double length = 0.0;             ///< L, wavelength along the plates [m] > 0
  double plate_velocity = 0.0;     ///< V0 of the plate at y = H [m/s] > 0
  double amplitude = 0.0;          ///< a of the wave's velocity along the plates [m/s] >= 0
  double angular_frequency = 0.0;  ///< omega [rad/s]
  FlowCurve curve{NewtonianCurve{1.0}};
};

/// A manufactured solution (Roache, J. Fluids Eng. 124 (2002) 4) of the momentum equation of a generalised
/// Newtonian fluid: a divergence-free field with all components of the shear-rate tensor, from the stream
/// function V0 y^2/(2 H) + a (H/pi) sin^2(pi y/H) sin(theta), theta = k x - omega t, k = 2 pi/L,
///   u = V0 y/H + a sin(2 pi y/H) sin(theta),   v = -a (k H/pi) sin^2(pi y/H) cos(theta),
/// with no slip on both plates. Density and pressure are uniform, so it solves the equations of a
/// compressible fluid as well, at any speed of sound. What drives it is the acceleration
///   b = v_t + (v.grad) v - div(2 nu(gdot) D),   gdot = sqrt(2 D:D).
/// The mean shear keeps gdot above zero, where a thinning power law has no finite viscosity.
class ManufacturedFlow {
 public:
  /// Throws std::invalid_argument for parameters out of their ranges, not finite, or a wave so strong that
  /// the shear rate could vanish.
  explicit ManufacturedFlow(const ManufacturedParameters& parameters);

  /// Velocity vector [m/s] at (x, y) [m], 0 <= y <= H, and t [s].
  [[nodiscard]] std::array<double, 2> velocity(double x, double y, double t) const;
  /// b [m/s2], by analytic derivatives.
  [[nodiscard]] std::array<double, 2> acceleration(double x, double y, double t) const;
  /// A lower bound of the shear rate everywhere [1/s] > 0.
  [[nodiscard]] double least_shear_rate() const;

 private:
  ManufacturedParameters parameters_;
  double k_, q_;  // 2 pi/L, 2 pi/H [rad/m]
};

}  // namespace reference
